// The first witness: a constrained triangulation of the vertices with the edges as
// constraints; its triangles, joined across what is no edge, are the regions.
#include <algorithm>
#include <array>
#include <numeric>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "tiling.hpp"

namespace {

struct Mark {
  int region = -1;
  std::array<bool, 3> walked{};  // edge i was met by the walk around the region
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<
    Mark, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_tag>;
using FaceHandle = Triangulation::Face_handle;
using VertexHandle = Triangulation::Vertex_handle;

// Vertices by x, then y; throws Bad if two are equal.
std::vector<int> sorted_vertices(const Tiling& tiling) {
  std::vector<int> order(tiling.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int v) -> const Point& { return tiling.vertices[v].point; };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return CGAL::compare_xy(at(a), at(b)) == CGAL::SMALLER;
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (at(order[i - 1]) == at(order[i])) {
      const auto [u, v] = std::minmax(order[i - 1], order[i]);
      throw Bad("vertices " + std::to_string(u) + " and " + std::to_string(v) +
                " are at one point");
    }
  }
  return order;
}

bool all_on_one_line(const Tiling& tiling, const std::vector<int>& order) {
  const auto at = [&](int v) -> const Point& { return tiling.vertices[v].point; };
  return order.size() < 3 || std::all_of(order.begin(), order.end(), [&](int v) {
           return CGAL::collinear(at(order.front()), at(v), at(order.back()));
         });
}

// Vertices on one line have one right answer: each joined to the next.
Subdivision path(const Tiling& tiling, const std::vector<int>& order) {
  std::vector<std::size_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<bool> joined(order.size(), false);  // [i]: places i and i + 1
  Subdivision found;
  for (const Edge& e : tiling.edges) {
    const auto [low, high] = std::minmax(place[e.u], place[e.v]);
    if (high - low > 1)
      throw Bad("vertex " + std::to_string(order[low + 1]) + " lies inside edge " +
                shown_edge(e.u, e.v));
    joined[low] = true;
    found.outside.emplace_back(e.u, e.v);
    found.outside.emplace_back(e.v, e.u);
  }
  for (std::size_t i = 0; i + 1 < order.size(); ++i)
    if (!joined[i]) throw Bad("hull edge " + shown_edge(order[i], order[i + 1]) + " is missing");
  found.vertices = order.size();
  found.edges = tiling.edges.size();
  return found;
}

// A vertex inside edge e: throws Bad.
void check_free_of_vertices(const Tiling& tiling, const Edge& e) {
  const auto at = [&](int v) -> const Point& { return tiling.vertices[v].point; };
  const Kernel::Segment_2 segment(at(e.u), at(e.v));
  for (int w = 0; w < static_cast<int>(tiling.vertices.size()); ++w)
    if (w != e.u && w != e.v && segment.has_on(at(w)))
      throw Bad("vertex " + std::to_string(w) + " lies inside edge " + shown_edge(e.u, e.v));
}

// CGAL refused edge `refused`, or did not keep it whole: say why.
[[noreturn]] void blame(const Tiling& tiling, const Edge& refused) {
  check_free_of_vertices(tiling, refused);
  const auto at = [&](int v) -> const Point& { return tiling.vertices[v].point; };
  const Kernel::Segment_2 segment(at(refused.u), at(refused.v));
  for (const Edge& e : tiling.edges) {
    if (e.u == refused.u || e.u == refused.v || e.v == refused.u || e.v == refused.v) continue;
    if (CGAL::do_intersect(segment, Kernel::Segment_2(at(e.u), at(e.v))))
      throw Bad("edges " + shown_edge(refused.u, refused.v) + " and " + shown_edge(e.u, e.v) +
                " cross");
  }
  // It lies in another edge, and has an end inside that.
  for (const Edge& e : tiling.edges) check_free_of_vertices(tiling, e);
  throw std::logic_error("the triangulation refuses edge " + shown_edge(refused.u, refused.v) +
                         " but nothing meets it");
}

std::vector<VertexHandle> insert_vertices(const Tiling& tiling, const std::vector<int>& order,
                                          Triangulation& triangulation) {
  std::vector<VertexHandle> handles(order.size());
  FaceHandle hint;
  for (int v : order) {
    handles[v] = triangulation.insert(tiling.vertices[v].point, hint);
    handles[v]->info() = v;
    hint = handles[v]->face();
  }
  return handles;
}

void insert_edges(const Tiling& tiling, const std::vector<VertexHandle>& handles,
                  Triangulation& triangulation) {
  for (const Edge& e : tiling.edges) {
    try {
      triangulation.insert_constraint(handles[e.u], handles[e.v]);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      blame(tiling, e);
    }
  }
  // An edge through a vertex was split there: then it is no edge of the triangulation.
  for (const Edge& e : tiling.edges) {
    FaceHandle face;
    int i;
    if (!triangulation.is_edge(handles[e.u], handles[e.v], face, i)) blame(tiling, e);
  }
}

void find_outside(const Triangulation& triangulation, Subdivision& found) {
  const VertexHandle infinite = triangulation.infinite_vertex();
  auto face = triangulation.incident_faces(infinite);
  const auto first = face;
  do {
    const int i = face->index(infinite);
    const int u = face->vertex(Triangulation::ccw(i))->info();
    const int v = face->vertex(Triangulation::cw(i))->info();
    if (!face->is_constrained(i)) throw Bad("hull edge " + shown_edge(u, v) + " is missing");
    found.outside.emplace_back(u, v);
  } while (++face != first);
}

// Marks the triangles of the region of `start`; returns the edges that bound it
// (an edge with the region on both sides twice).
std::vector<std::pair<FaceHandle, int>> flood(FaceHandle start, int region) {
  std::vector<std::pair<FaceHandle, int>> bounds;
  std::vector<FaceHandle> todo{start};
  start->info().region = region;
  while (!todo.empty()) {
    const FaceHandle face = todo.back();
    todo.pop_back();
    for (int i = 0; i < 3; ++i) {
      const FaceHandle neighbour = face->neighbor(i);
      if (face->is_constrained(i)) {
        bounds.emplace_back(face, i);
      } else if (neighbour->info().region < 0) {
        neighbour->info().region = region;
        todo.push_back(neighbour);
      }
    }
  }
  return bounds;
}

// The boundary cycle that holds edge i of `face`, the region on its left.
Cycle walk(FaceHandle face, int i) {
  Cycle cycle;
  while (!face->info().walked[i]) {
    face->info().walked[i] = true;
    cycle.push_back(face->vertex(Triangulation::ccw(i))->info());
    // Edge i runs from vertex ccw(i) to vertex cw(i); turn around that one, within the
    // region, to the first edge that bounds it.
    i = Triangulation::ccw(i);
    while (!face->is_constrained(i)) {
      const FaceHandle neighbour = face->neighbor(i);
      i = Triangulation::ccw(neighbour->index(face));
      face = neighbour;
    }
  }
  return cycle;
}

void check_simple(const std::vector<Cycle>& cycles) {
  Cycle sorted;
  for (const Cycle& cycle : cycles) sorted.insert(sorted.end(), cycle.begin(), cycle.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice == sorted.end()) return;
  const auto cycle = std::find_if(cycles.begin(), cycles.end(), [&](const Cycle& c) {
    return std::find(c.begin(), c.end(), *twice) != c.end();
  });
  throw Bad("vertex " + std::to_string(*twice) + " is twice on the boundary " +
            shown_cycle(*cycle) + " of one region");
}

}  // namespace

Subdivision by_triangulation(const Tiling& tiling) {
  const std::vector<int> order = sorted_vertices(tiling);
  if (all_on_one_line(tiling, order)) return path(tiling, order);

  Triangulation triangulation;
  insert_edges(tiling, insert_vertices(tiling, order, triangulation), triangulation);
  Subdivision found;
  find_outside(triangulation, found);
  for (FaceHandle face : triangulation.finite_face_handles()) {
    if (face->info().region >= 0) continue;
    std::vector<Cycle> cycles;
    // The hull edges are constraints, so the flood stays inside and something bounds it.
    for (const auto& [bound, i] : flood(face, static_cast<int>(found.regions.size())))
      if (!bound->info().walked[i]) cycles.push_back(walk(bound, i));
    check_simple(cycles);
    found.regions.push_back(std::move(cycles));
  }
  found.vertices = triangulation.number_of_vertices();
  for (const auto& edge : triangulation.finite_edges())
    found.edges += triangulation.is_constrained(edge) ? 1 : 0;
  return found;
}
