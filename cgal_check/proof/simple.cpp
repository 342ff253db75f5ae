#include "simple.hpp"

#include <algorithm>

#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>
#include <CGAL/mpq_class.h>

namespace proof {

namespace {

using Exact = CGAL::Simple_cartesian<Rational>;
using Place = std::pair<Rational, Rational>;

Exact::Point_2 point(const Place& p) { return {p.first, p.second}; }

std::vector<Exact::Point_2> points(const std::vector<Place>& places) {
  std::vector<Exact::Point_2> result;
  for (const Place& p : places) result.push_back(point(p));
  return result;
}

// Whether two intervals, each by its ends in any order, have nothing in common.
bool are_apart(const Rational& a, const Rational& b, const Rational& c, const Rational& d) {
  return std::max(a, b) < std::min(c, d) || std::max(c, d) < std::min(a, b);
}

}  // namespace

bool is_simple(const std::vector<Place>& polygon) {
  const auto all = points(polygon);
  return CGAL::is_simple_2(all.begin(), all.end(), Exact());
}

bool is_in(const std::vector<Place>& polygon, const Place& p) {
  const auto all = points(polygon);
  return CGAL::bounded_side_2(all.begin(), all.end(), point(p), Exact()) !=
         CGAL::ON_UNBOUNDED_SIDE;
}

bool do_edges_meet(const std::vector<Place>& one, const std::vector<Place>& other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Place &a = one[i], &b = one[(i + 1) % one.size()];
    for (std::size_t j = 0; j < other.size(); ++j) {
      const Place &c = other[j], &d = other[(j + 1) % other.size()];
      if (are_apart(a.first, b.first, c.first, d.first)) continue;
      if (are_apart(a.second, b.second, c.second, d.second)) continue;
      if (do_meet(a, b, c, d)) return true;
    }
  }
  return false;
}

bool do_meet(const Place& a, const Place& b, const Place& c, const Place& d) {
  using Segment = Exact::Segment_2;
  return CGAL::do_intersect(Segment(point(a), point(b)), Segment(point(c), point(d)));
}

}  // namespace proof
