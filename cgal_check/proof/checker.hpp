// The steps of docs/proofs.md, on a proof as it was parsed.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "clusters.hpp"
#include "map.hpp"
#include "predicates.hpp"
#include "scene.hpp"
#include "text.hpp"

namespace proof {

// A line that does not hold. Of all shares, the one with the least number counts.
struct Failure {
  std::size_t number;
  std::size_t line;
  std::string why;
};

class Checker {
 public:
  // With others, makes only each `shares`-th of the checks that take long, from the number
  // `share` on; all of the others.
  Checker(Scene& scene, const ProofText& text, std::size_t share, std::size_t shares);

  // The failure, if there is one.
  std::optional<Failure> run();

  // What has been proved, after a run without failure, in words (statement.cpp).
  std::string conclusion() const;

  // How an answer of exactpt collide --json differs from it; nothing if it does not. Throws
  // NoProof if it is none.
  std::string difference(const std::string& answer) const;

 private:
  // An angle, by the half-edge at its clockwise end.
  struct Angle {
    bool is_alive = false, is_solid = false;
    int end = -1;  // the half-edge at its other end, next counter-clockwise
    const Time* since = nullptr;
    Kind kind = Kind::convex;
  };

  void check_all();
  void check_span();
  void check_vertices(const std::vector<int>& vertices) const;
  template <class Check>
  void in_share(Check check);

  // The map at the start (beginning.cpp).
  void begin();
  std::vector<FaceText> solid_faces() const;
  void begin_angles(const std::vector<FaceText>& solid);
  void check_body_edges() const;
  void check_components();

  // An event.
  void check_items(const EventText& event) const;
  std::vector<int> ending(const EventText& event) const;
  void change(const EventText& event);
  void renew(std::vector<int> changed, const std::vector<Edge>& renewed);
  void begin_life(int h);
  void end_life(int h);
  void renew_faces(const std::vector<int>& ended, const std::vector<int>& begun);
  void check_connected(const EventText& event) const;
  void check_insides(const std::vector<int>& halves) const;

  // The map between two times (interval.cpp).
  void go_on_to(Time next);
  void settle(const Time& sample);
  Kind kind_of(int h, const Time& sample);
  void count_corners(int h, const Time& sample);
  void check_star(int v, const Time& sample);
  bool is_upward(int h, const Time& sample);
  std::vector<int> vanishing(const std::vector<int>& halves, const Time& t);
  void check_contacts(const std::vector<int>& halves, const Time& t);
  std::vector<int> living() const;
  void finish();

  // Times and contacts as they are written (claims.cpp).
  Poly<Integer> polynomial_of(const TimeText& text) const;
  Time time_of(const TimeText& text) const;
  void check_contact(const ContactText& contact, const Time& t);
  void check_contact_at_start(const ContactText& contact);

  Angle& angle(int h) { return angles_[static_cast<std::size_t>(h)]; }
  const Angle& angle(int h) const { return angles_[static_cast<std::size_t>(h)]; }
  int component(int v) const { return component_[static_cast<std::size_t>(v)]; }
  int& face(int h) { return face_[static_cast<std::size_t>(h)]; }

  Scene& scene_;
  const ProofText& text_;
  const std::size_t share_, shares_;
  std::size_t checks_ = 0;
  bool is_in_share_ = false;
  std::size_t line_ = 0;        // the line in hand
  std::size_t fresh_line_ = 0;  // on which the new angles came
  Predicates predicates_;
  std::deque<Time> times_;      // t0, then those of events; references last
  std::optional<Map> map_;      // none for less than two vertices
  std::vector<int> component_;  // of each vertex; it never changes
  std::size_t components_ = 1;
  int outermost_ = 0;           // the component that has the outer face
  std::vector<Angle> angles_;
  std::vector<int> fresh_;      // half-edges of the angles that came with the last line
  std::vector<int> face_;       // of each half-edge
  std::vector<bool> is_outer_;  // of each face that there has ever been
  std::size_t faces_ = 0, outer_faces_ = 0;
  std::set<Incidence> found_;   // at the time of the contact, if that is not the start
  bool is_at_start_ = false;    // the contact
};

template <class Check>
void Checker::in_share(Check check) {
  if (++checks_ % shares_ != share_) return;
  is_in_share_ = true;
  check();
  is_in_share_ = false;
}

}  // namespace proof
