// Scenes, read from their files, and where their vertices are.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "groups.hpp"
#include "polynomial.hpp"
#include "time.hpp"

namespace proof {

// The path of a vertex in one piece of its motion: it is at (x / w, y / w), where w > 0.
struct Path {
  Poly<Integer> x, y, w;
  Poly<Interval> near_x, near_y, near_w;  // the same, all three times one positive number
  bool is_polynomial = false;             // w is constant, and near_w is 1
};

using Place = std::pair<Rational, Rational>;
using Polygon = std::vector<Place>;

Place place(const Path& path, const Rational& t);

// Polynomials in time, with the sign of the orientation of three vertices, and of the dot
// product of a - v and b - v.
Poly<Integer> orientation(const Path& a, const Path& b, const Path& c);
Poly<Integer> dot_product(const Path& a, const Path& v, const Path& b);

// A ring of vertices of a body; of a chain, a segment or a point, all of them.
struct Ring {
  int first = 0;  // the number of its first vertex in the scene
  int size = 0;
  bool is_hole = false;
  bool has_body_on_left = true;  // of a polygon, at the start
};

struct Body {
  std::string name;
  Rational radius = 0;
  int first = 0;  // the number of its first vertex in the scene
  int size = 0;
  bool is_polygon = false;
  bool is_rigid = false;            // during the time span of the proof
  bool is_modelled = false;         // the true body may differ from it, by a stated error
  std::vector<Ring> rings;
  std::vector<Rational> breaks;     // times at which the formulas change
  std::vector<std::vector<Path>> pieces;  // one more than breaks; each with all vertices

  int edges() const { return is_polygon ? size : size - 1; }
  const Ring& ring(int v) const;
  int next(int v) const { return around(v, 1); }  // on its ring, in the order of the file
  int around(int v, int step) const;
};

// The rings of a polygon at a time.
std::vector<Polygon> polygons(const Body& body, const Rational& t);

class Scene {
 public:
  // Of the text of a scene file, all of which is read. Throws NoProof.
  explicit Scene(const std::string& text, bool are_records_verified = true);

  const Rational& start() const { return start_; }
  const Rational& end() const { return end_; }
  const std::vector<Body>& bodies() const { return bodies_; }
  int size() const { return static_cast<int>(body_of_.size()); }
  const Groups& groups() const { return groups_; }
  bool is_modelled() const;  // some body is

  // Which of its bodies are rigid up to a time. Throws Rejected.
  void examine(const Rational& end);

  int body_of(int v) const { return body_of_[static_cast<std::size_t>(v)]; }
  const Body& body(int v) const { return bodies_[static_cast<std::size_t>(body_of(v))]; }
  bool is_body_edge(int u, int v) const;
  bool are_rigid(int u, int v, int w) const;  // all of one rigid body
  std::string in_short(int v) const;          // "b2.1": vertex 1 of the body 2
  int first_of_edge(int u, int v) const;      // of a body's edge, in the order of its ring

  // The vertices before and after a vertex on its ring, with the polygon on the left.
  int before(int v) const { return after(v, -1); }
  int after(int v) const { return after(v, 1); }

  // Which piece holds just after a time, or at it.
  static std::size_t piece(const Body& body, const Time& t);
  const Path& path(int v, std::size_t piece) const;
  const Path& path(int v, const Time& t) const { return path(v, piece(body(v), t)); }

 private:
  int after(int v, int step) const;

  Rational start_, end_;
  std::vector<Body> bodies_;
  std::vector<int> body_of_;
  Groups groups_;
};

}  // namespace proof
