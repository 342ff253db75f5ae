// Signs at a time, and throughout an interval of time: intervals of doubles first, exact
// arithmetic where these leave it open.
#pragma once

#include <vector>

#include "scene.hpp"

namespace proof {

class Predicates {
 public:
  explicit Predicates(const Scene& scene)
      : scene_(scene), boxes_(static_cast<std::size_t>(scene.size())) {}

  struct Box {
    long time = -1;  // the number of the time at which this is the place of a vertex
    Interval x, y;
  };

  // The place of a vertex; of a time that is not rational, during its interval.
  const Box& box(int v, const Time& t);

  int orientation(int a, int b, int c, const Time& t);
  int dot_product(int a, int v, int b, const Time& t);  // of a - v and b - v
  int difference_of_x(int a, int b, const Time& t);     // the sign of the abscissa of b - a
  int difference_of_y(int a, int b, const Time& t);
  bool coincide(int a, int b, const Time& t);

  // Whether v is on the segment ab.
  bool is_on(int v, int a, int b, const Time& t);

  // Whether the orientation of three vertices is the zero polynomial just after a time.
  bool is_flat(int a, int b, int c, const Time& t);

 private:
  const Scene& scene_;
  std::vector<Box> boxes_;
};

// What the angle between the edges from v to u and to w, u being before v and w after it, keeps
// in an open interval of time.
enum class Kind : unsigned char { convex, reflex, flat, full };

bool keeps_kind(const Scene& scene, int u, int v, int w, Kind kind, const Time& since,
                const Time& until);

}  // namespace proof
