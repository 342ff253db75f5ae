// Convex hulls, by CGAL's convex_hull_2.
#include <algorithm>
#include <numeric>

#include <CGAL/Convex_hull_traits_adapter_2.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/property_map.h>

#include "tiling.hpp"

namespace {

// Lets CGAL speak of points by their index.
struct PointOf {
  using key_type = int;
  using value_type = Point;
  using reference = const Point&;
  using category = boost::readable_property_map_tag;

  const std::vector<Vertex>* vertices;

  friend reference get(const PointOf& map, int v) { return (*map.vertices)[v].point; }
};

}  // namespace

Cycle convex_hull(const std::vector<Vertex>& vertices) {
  const auto at = [&](int v) -> const Point& { return vertices[v].point; };
  Cycle order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  // Of equal points CGAL may keep any; leave it the first.
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return CGAL::compare_xy(at(a), at(b)) == CGAL::SMALLER;
  });
  order.erase(std::unique(order.begin(), order.end(), [&](int a, int b) { return at(a) == at(b); }),
              order.end());
  Cycle hull;
  const CGAL::Convex_hull_traits_adapter_2<Kernel, PointOf> traits(PointOf{&vertices});
  CGAL::convex_hull_2(order.begin(), order.end(), std::back_inserter(hull), traits);
  if (hull.empty()) return hull;
  std::rotate(hull.begin(), std::find(hull.begin(), hull.end(), order.front()), hull.end());
  return hull;
}
