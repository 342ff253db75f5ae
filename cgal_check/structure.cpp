// What can be said of a tiling without its coordinates.
#include <algorithm>
#include <set>

#include "tiling.hpp"

namespace {

using Pair = std::pair<int, int>;

Pair unordered(int u, int v) { return std::minmax(u, v); }

void check_bodies(const Tiling& tiling) {
  constexpr int none = -1;
  std::vector<int> owner(tiling.vertices.size(), none);
  const auto take = [&](int v, int b) {
    if (owner[v] != none)
      throw Bad("vertex " + std::to_string(v) + " belongs to body " + std::to_string(owner[v]) +
                " and again to body " + std::to_string(b));
    owner[v] = b;
  };
  for (std::size_t b = 0; b < tiling.bodies.size(); ++b)
    for (const auto& part : tiling.bodies[b].parts)
      for (const Cycle& cycle : part)
        for (int v : cycle) take(v, static_cast<int>(b));
  const auto orphan = std::find(owner.begin(), owner.end(), none);
  if (orphan != owner.end())
    throw Bad("vertex " + std::to_string(orphan - owner.begin()) + " belongs to no body");
}

std::set<Pair> edges_of_bodies(const Tiling& tiling) {
  std::set<Pair> edges;
  const auto add = [&](const Cycle& cycle, bool is_closed) {
    for (std::size_t i = 1; i < cycle.size(); ++i) edges.insert(unordered(cycle[i - 1], cycle[i]));
    if (is_closed) edges.insert(unordered(cycle.back(), cycle.front()));
  };
  for (const Body& body : tiling.bodies)
    for (const auto& part : body.parts)
      for (const Cycle& cycle : part) add(cycle, body.is_closed());
  return edges;
}

void check_edges(const Tiling& tiling) {
  const std::set<Pair> of_bodies = edges_of_bodies(tiling);
  std::set<Pair> seen;
  for (const Edge& e : tiling.edges) {
    const std::string name = "edge " + shown_edge(e.u, e.v);
    if (e.u == e.v) throw Bad(name + " has one end");
    if (!seen.insert(unordered(e.u, e.v)).second) throw Bad(name + " is there twice");
    const bool is_boundary = of_bodies.count(unordered(e.u, e.v)) > 0;
    if (e.boundary && !is_boundary)
      throw Bad(name + " is called a boundary edge but no body has it");
    if (!e.boundary && is_boundary)
      throw Bad(name + " is called a diagonal but is an edge of a body");
  }
  for (const auto& [u, v] : of_bodies)
    if (seen.count({u, v}) == 0)
      throw Bad("edge " + shown_edge(u, v) + " of a body is missing");
}

void check_no_isolated_vertex(const Tiling& tiling) {
  if (tiling.vertices.size() == 1) return;  // a scene of one point has no edge
  std::vector<bool> has_edge(tiling.vertices.size(), false);
  for (const Edge& e : tiling.edges) has_edge[e.u] = has_edge[e.v] = true;
  const auto isolated = std::find(has_edge.begin(), has_edge.end(), false);
  if (isolated != has_edge.end())
    throw Bad("vertex " + std::to_string(isolated - has_edge.begin()) + " is isolated");
}

void check_faces(const Tiling& tiling) {
  for (std::size_t i = 0; i < tiling.faces.size(); ++i) {
    const std::string name = "face " + std::to_string(i);
    const Face& face = tiling.faces[i];
    const std::set<int> on_face(face.vertices.begin(), face.vertices.end());
    if (on_face.size() < 3) throw Bad(name + " has fewer than three vertices");
    if (on_face.size() < face.vertices.size()) throw Bad(name + " has a vertex twice");
    const std::set<int> corners(face.corners.begin(), face.corners.end());
    if (corners.size() < 3) throw Bad(name + " has a corner twice");
    for (int c : corners)
      if (on_face.count(c) == 0)
        throw Bad(name + " has corner " + std::to_string(c) + ", which is no vertex of it");
  }
}

}  // namespace

void check_structure(const Tiling& tiling) {
  check_bodies(tiling);
  check_edges(tiling);
  check_no_isolated_vertex(tiling);
  check_faces(tiling);
}
