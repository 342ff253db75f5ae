#include "simple.hpp"

#include <algorithm>

#include "faults.hpp"

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

bool is_simple(const std::vector<Place>& places, const std::vector<std::pair<int, int>>& edges) {
  struct Box {
    Rational left, right, bottom, top;
    int u, v;
  };
  const auto at = [&](int i) { return point(places[static_cast<std::size_t>(i)]); };
  std::vector<Box> boxes;
  for (const auto& [u, v] : edges) {
    const Place &p = places[static_cast<std::size_t>(u)], &q = places[static_cast<std::size_t>(v)];
    if (p == q) return false;
    boxes.push_back({std::min(p.first, q.first), std::max(p.first, q.first),
                     std::min(p.second, q.second), std::max(p.second, q.second), u, v});
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const Box& a, const Box& b) { return a.left < b.left; });
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].left <= boxes[i].right; ++j) {
      const Box &a = boxes[i], &b = boxes[j];
      spend(50);
      if (a.top < b.bottom || b.top < a.bottom) continue;
      spend(5000);
      if (a.v != b.u && b.v != a.u) {
        if (CGAL::do_intersect(Exact::Segment_2(at(a.u), at(a.v)),
                               Exact::Segment_2(at(b.u), at(b.v))))
          return false;
        continue;
      }
      // Edges that are joined: they have more in common if one goes back along the other.
      const int p = a.v == b.u ? a.u : b.u, q = a.v == b.u ? a.v : b.v,
                r = a.v == b.u ? b.v : a.v;
      if (CGAL::collinear(at(p), at(q), at(r)) &&
          CGAL::angle(at(p), at(q), at(r)) == CGAL::ACUTE)
        return false;
    }
  }
  return true;
}

bool is_in(const std::vector<Place>& polygon, const Place& p) {
  spend(400 * static_cast<double>(polygon.size()));
  const auto all = points(polygon);
  return CGAL::bounded_side_2(all.begin(), all.end(), point(p), Exact()) !=
         CGAL::ON_UNBOUNDED_SIDE;
}

bool is_on_boundary(const std::vector<Place>& polygon, const Place& p) {
  const auto all = points(polygon);
  return CGAL::bounded_side_2(all.begin(), all.end(), point(p), Exact()) ==
         CGAL::ON_BOUNDARY;
}

bool do_meet(const Place& a, const Place& b, const Place& c, const Place& d) {
  using Segment = Exact::Segment_2;
  return CGAL::do_intersect(Segment(point(a), point(b)), Segment(point(c), point(d)));
}

}  // namespace proof
