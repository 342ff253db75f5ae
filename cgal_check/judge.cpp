// From the regions that are there to the verdict on those that are claimed.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "tiling.hpp"

namespace {

// The cycle read from its smallest vertex: equal for equal cycles, wherever they start.
Cycle from_smallest(Cycle cycle) {
  std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
  return cycle;
}

// Twice the signed area.
Rational area2(const Tiling& tiling, const Cycle& cycle) {
  Rational total = 0;
  int u = cycle.back();
  for (int v : cycle) {
    const Vertex &a = tiling.vertices[u], &b = tiling.vertices[v];
    total += a.x * b.y - b.x * a.y;
    u = v;
  }
  return total;
}

std::vector<int> convex_corners(const Tiling& tiling, const Cycle& cycle) {
  const auto at = [&](std::size_t i) -> const Point& {
    return tiling.vertices[cycle[i % cycle.size()]].point;
  };
  std::vector<int> corners;
  for (std::size_t i = 0; i < cycle.size(); ++i)
    if (CGAL::left_turn(at(i + cycle.size() - 1), at(i), at(i + 1))) corners.push_back(cycle[i]);
  std::sort(corners.begin(), corners.end());
  return corners;
}

using Boundary = std::vector<Cycle>;
using Regions = std::map<Cycle, bool>;  // whether it was accounted for

// Equal for equal regions, in whatever order their cycles are.
Boundary in_order(Boundary boundary) {
  for (Cycle& cycle : boundary) cycle = from_smallest(std::move(cycle));
  std::sort(boundary.begin(), boundary.end());
  return boundary;
}

void take_polygons(const Tiling& tiling, std::set<Boundary>& regions) {
  for (std::size_t b = 0; b < tiling.bodies.size(); ++b) {
    if (!tiling.bodies[b].is_closed()) continue;
    for (const Boundary& part : tiling.bodies[b].parts)
      if (regions.erase(in_order(part)) == 0)
        throw Bad("the inside of body " + std::to_string(b) + ", " + shown_cycle(part.front()) +
                  ", is not one region bounded by exactly its edges");
  }
}

// What no body has; each of it is bounded by one cycle.
Regions free_regions(const Tiling& tiling, const std::set<Boundary>& rest) {
  Regions free;
  for (const Boundary& boundary : rest) {
    if (boundary.size() > 1) {
      const auto outline = std::find_if(boundary.begin(), boundary.end(), [&](const Cycle& c) {
        return area2(tiling, c) > 0;
      });
      throw Bad("the region inside " + shown_cycle(*outline) + " has a second boundary");
    }
    free.emplace(boundary.front(), false);
  }
  return free;
}

void check_shapes(const Tiling& tiling, const Regions& free) {
  for (const auto& [cycle, claimed] : free) {
    if (tiling.triangles && cycle.size() != 3)
      throw Bad("the region " + shown_cycle(cycle) + " is not a triangle");
    const std::vector<int> corners = convex_corners(tiling, cycle);
    if (corners.size() != 3)
      throw Bad("the region " + shown_cycle(cycle) + " has " + std::to_string(corners.size()) +
                " convex corners: " + shown_cycle(corners));
  }
}

void check_faces(const Tiling& tiling, Regions& free) {
  for (std::size_t i = 0; i < tiling.faces.size(); ++i) {
    const Face& face = tiling.faces[i];
    const std::string name = "face " + std::to_string(i) + ", " + shown_cycle(face.vertices) + ",";
    const auto region = free.find(from_smallest(face.vertices));
    if (region == free.end()) {
      const Cycle reversed(face.vertices.rbegin(), face.vertices.rend());
      if (free.count(from_smallest(reversed)) > 0) throw Bad(name + " is clockwise");
      throw Bad(name + " is no free region of the edges");
    }
    if (region->second) throw Bad(name + " is there twice");
    region->second = true;
    std::vector<int> corners(face.corners.begin(), face.corners.end());
    std::sort(corners.begin(), corners.end());
    const std::vector<int> right = convex_corners(tiling, region->first);
    if (corners != right)
      throw Bad(name + " has corners " + shown_cycle(right) + ", not " + shown_cycle(corners));
  }
  if (tiling.triangles) return;
  for (const auto& [cycle, claimed] : free)
    if (!claimed) throw Bad("the free region " + shown_cycle(cycle) + " is not among the faces");
}

void check_hull_flags(const Tiling& tiling, const Subdivision& found) {
  std::set<std::pair<int, int>> outside;
  for (const auto& [u, v] : found.outside) outside.insert(std::minmax(u, v));
  for (const Edge& e : tiling.edges) {
    const bool is_hull = outside.count(std::minmax(e.u, e.v)) > 0;
    if (e.hull && !is_hull) throw Bad("edge " + shown_edge(e.u, e.v) + " is not on the hull");
    if (!e.hull && is_hull)
      throw Bad("edge " + shown_edge(e.u, e.v) + " is on the hull, but called inner");
  }
}

// The areas say again, from the claimed cycles and CGAL's convex hull, that nothing is
// missing and nothing covered twice. A sum of areas is a sum of cross products, one a
// directed edge, and u-v is minus v-u: what cancels need not be added up, so that rationals
// with many different denominators do not pile up.
void check_areas(const Tiling& tiling, const Regions& free) {
  std::map<std::pair<int, int>, int> times;
  const auto add = [&](const Cycle& cycle, int sign) {
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const int u = cycle[i], v = cycle[(i + 1) % cycle.size()];
      times[std::minmax(u, v)] += u < v ? sign : -sign;
    }
  };
  const auto add_face = [&](const Cycle& cycle) {
    if (area2(tiling, cycle) <= 0)
      throw Bad("the face " + shown_cycle(cycle) + " has no positive area");
    add(cycle, 1);
  };
  if (tiling.triangles)
    for (const auto& [cycle, claimed] : free) add_face(cycle);
  else
    for (const Face& face : tiling.faces) add_face(face.vertices);
  for (const Body& body : tiling.bodies)
    if (body.is_closed())
      for (const Boundary& part : body.parts)
        for (const Cycle& cycle : part) add(cycle, 1);
  add(convex_hull(tiling.vertices), -1);
  Rational missing = 0;
  for (const auto& [edge, factor] : times) {
    if (factor == 0) continue;
    const Vertex &a = tiling.vertices[edge.first], &b = tiling.vertices[edge.second];
    missing += factor * (a.x * b.y - b.x * a.y);
  }
  if (missing != 0) throw Bad("faces and polygons together have not the area of the hull");
}

void check_counts(const Tiling& tiling, const Subdivision& found) {
  if (found.vertices != tiling.vertices.size())
    throw Bad(std::to_string(tiling.vertices.size()) + " vertices are claimed, " +
              std::to_string(found.vertices) + " found");
  if (found.edges != tiling.edges.size())
    throw Bad(std::to_string(tiling.edges.size()) + " edges are claimed, " +
              std::to_string(found.edges) + " found");
  std::size_t sides = found.outside.size();
  for (const Boundary& boundary : found.regions)
    for (const Cycle& cycle : boundary) sides += cycle.size();
  if (sides != 2 * found.edges) throw Bad("the regions do not use every edge on both sides");
  // Euler: V - E + F = 1 + C, F with the unbounded region.
  if (found.vertices + found.regions.size() != found.edges + components(tiling))
    throw Bad("V - E + F is not 1 + C for " + std::to_string(found.vertices) + " vertices, " +
              std::to_string(found.edges) + " edges, " + std::to_string(found.regions.size() + 1) +
              " faces, " + std::to_string(components(tiling)) + " components");
}

}  // namespace

std::size_t components(const Tiling& tiling) {
  std::vector<int> parent(tiling.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::size_t count = parent.size();
  for (const Edge& e : tiling.edges) {
    const int u = root(e.u), v = root(e.v);
    if (u == v) continue;
    parent[u] = v;
    --count;
  }
  return count;
}

void orient_bodies(Tiling& tiling) {
  for (std::size_t b = 0; b < tiling.bodies.size(); ++b) {
    Body& body = tiling.bodies[b];
    if (!body.is_closed()) continue;
    const std::string name = "body " + std::to_string(b);
    for (Boundary& part : body.parts) {
      for (std::size_t k = 0; k < part.size(); ++k) {
        const bool is_hole = k > 0;
        const Rational area = area2(tiling, part[k]);
        if (area == 0) throw Bad((is_hole ? "a hole of " + name : name) + " has no area");
        if ((area > 0) != is_hole) continue;
        if (is_hole) throw Bad("a hole of " + name + " is counter-clockwise");
        if (body.kind != Body::Kind::ring) throw Bad(name + " is clockwise");
        std::reverse(part[k].begin(), part[k].end());
      }
    }
  }
}

void judge(const Tiling& tiling, const Subdivision& found) {
  std::set<Boundary> regions;
  for (const Boundary& boundary : found.regions) regions.insert(in_order(boundary));
  take_polygons(tiling, regions);
  Regions free = free_regions(tiling, regions);
  check_shapes(tiling, free);
  check_faces(tiling, free);
  check_hull_flags(tiling, found);
  check_areas(tiling, free);
  check_counts(tiling, found);
}
