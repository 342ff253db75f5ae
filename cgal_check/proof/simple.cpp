#include "simple.hpp"

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

bool do_meet(const Place& a, const Place& b, const Place& c, const Place& d) {
  using Segment = Exact::Segment_2;
  return CGAL::do_intersect(Segment(point(a), point(b)), Segment(point(c), point(d)));
}

}  // namespace proof
