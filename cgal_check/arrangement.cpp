// The second witness: the arrangement of the edges, by CGAL's sweep, over plain rationals.
// It shares no geometry with the first, not even the filters: and it must not, for the
// lazy kernel takes two lines for parallel where their coefficients are beyond the
// doubles (it constructs no intersection there; only its predicates are safe).
#include <algorithm>
#include <map>
#include <set>

#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_naive_point_location.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Simple_cartesian.h>

#include "tiling.hpp"

namespace {

using Rationals = CGAL::Simple_cartesian<Rational>;
using Point2 = Rationals::Point_2;
using Traits = CGAL::Arr_segment_traits_2<Rationals>;
using Dcel = CGAL::Arr_extended_dcel<Traits, int, char, char>;  // vertices know their index
using Arrangement = CGAL::Arrangement_2<Traits, Dcel>;
using Circulator = Arrangement::Ccb_halfedge_const_circulator;

struct LessXY {
  bool operator()(const Point2& a, const Point2& b) const {
    return CGAL::compare_xy(a, b) == CGAL::SMALLER;
  }
};

using Index = std::map<Point2, int, LessXY>;

std::vector<Point2> points_of(const Tiling& tiling) {
  std::vector<Point2> points;
  for (const Vertex& v : tiling.vertices) points.emplace_back(v.x, v.y);
  return points;
}

Index index_of(const std::vector<Point2>& points) {
  Index index;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto [other, is_new] = index.insert({points[v], static_cast<int>(v)});
    if (!is_new)
      throw Bad("vertices " + std::to_string(other->second) + " and " + std::to_string(v) +
                " coincide");
  }
  return index;
}

void insert_edges(const Tiling& tiling, const std::vector<Point2>& points,
                  Arrangement& arrangement) {
  std::vector<Traits::X_monotone_curve_2> segments;
  std::vector<bool> has_edge(points.size(), false);
  for (const Edge& e : tiling.edges) {
    segments.emplace_back(points[e.u], points[e.v]);
    has_edge[e.u] = has_edge[e.v] = true;
  }
  CGAL::insert(arrangement, segments.begin(), segments.end());
  // Only a scene of one point has a vertex without an edge (see check_structure).
  CGAL::Arr_naive_point_location<Arrangement> location(arrangement);
  for (std::size_t v = 0; v < has_edge.size(); ++v)
    if (!has_edge[v]) CGAL::insert_point(arrangement, points[v], location);
}

// The vertices of the arrangement are those of the tiling, and the edges too.
void name_vertices(const Tiling& tiling, const Index& index, Arrangement& arrangement) {
  for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end(); ++v) {
    const auto found = index.find(v->point());
    if (found == index.end())
      throw Bad("edges cross near (" + std::to_string(CGAL::to_double(v->point().x())) + ", " +
                std::to_string(CGAL::to_double(v->point().y())) + "), where no vertex is");
    v->set_data(found->second);
  }
  // Where edges overlap or pass through a vertex, they are cut into other edges.
  std::set<std::pair<int, int>> claimed;
  for (const Edge& e : tiling.edges) claimed.insert(std::minmax(e.u, e.v));
  for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
    const int u = e->source()->data(), v = e->target()->data();
    if (claimed.count(std::minmax(u, v)) == 0)
      throw Bad("an edge passes through vertex " + std::to_string(u) + " or " +
                std::to_string(v) + ": " + shown_edge(u, v) + " is only a part of it");
  }
  if (arrangement.number_of_edges() != tiling.edges.size())
    throw Bad("an edge passes through a vertex and overlaps others");
}

// The hull is on the right of this walk, so it never turns left; where all edges lie on
// one line it only turns back.
void check_outside(Circulator edge, Subdivision& found) {
  const Circulator first = edge;
  do {
    const auto next = edge->next();
    if (CGAL::orientation(edge->source()->point(), edge->target()->point(),
                          next->target()->point()) == CGAL::LEFT_TURN)
      throw Bad("the outer boundary is not convex at vertex " +
                std::to_string(edge->target()->data()));
    found.outside.emplace_back(edge->source()->data(), edge->target()->data());
  } while (++edge != first);
}

Cycle cycle_of(const Circulator first, std::set<int>& met) {
  Cycle cycle;
  Circulator edge = first;
  bool is_simple = true;
  do {
    cycle.push_back(edge->source()->data());
    is_simple = met.insert(cycle.back()).second && is_simple;
  } while (++edge != first);
  if (!is_simple) throw Bad("the boundary " + shown_cycle(cycle) + " of a region meets itself");
  return cycle;
}

std::vector<Cycle> region_of(Arrangement::Face_const_handle face) {
  std::set<int> met;
  std::vector<Cycle> cycles{cycle_of(face->outer_ccb(), met)};
  for (auto ccb = face->inner_ccbs_begin(); ccb != face->inner_ccbs_end(); ++ccb)
    cycles.push_back(cycle_of(*ccb, met));
  return cycles;
}

}  // namespace

Subdivision by_arrangement(const Tiling& tiling) {
  const std::vector<Point2> points = points_of(tiling);
  const Index index = index_of(points);
  Arrangement arrangement;
  insert_edges(tiling, points, arrangement);
  name_vertices(tiling, index, arrangement);

  Subdivision found;
  const auto outside = arrangement.unbounded_face();
  if (outside->number_of_inner_ccbs() > 1) throw Bad("the edges are not connected");
  for (auto ccb = outside->inner_ccbs_begin(); ccb != outside->inner_ccbs_end(); ++ccb)
    check_outside(*ccb, found);
  for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face)
    if (!face->is_unbounded()) found.regions.push_back(region_of(face));
  found.vertices = arrangement.number_of_vertices();
  found.edges = arrangement.number_of_edges();
  return found;
}
