// A tiling at one instant, as it is claimed, and what a witness found to be there.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "reader.hpp"

#if defined(NDEBUG) || defined(CGAL_NDEBUG) || defined(CGAL_NO_ASSERTIONS)
#error "cgal_check is a witness: build it with CGAL's assertions on"
#endif

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_2;
using Rational = Kernel::Exact_kernel::FT;

// The exact rational, in lowest terms (GMP's arithmetic is wrong on others).
Rational rational_from(const Fraction& written);

struct Vertex {
  Rational x, y;
  Point point;

  Vertex(Rational x_, Rational y_)
      : x(std::move(x_)), y(std::move(y_)), point(Kernel::FT(x), Kernel::FT(y)) {}
};

Vertex read_vertex(Reader& in);

// Reads the word "vertices", a count, and the coordinates.
std::vector<Vertex> read_vertices(Reader& in);

using Cycle = std::vector<int>;  // vertices in the order of a walk, each followed by the next

struct Body {
  enum class Kind { polygon, ring, parts, chain, segment, point };
  Kind kind;
  // Of each part its outline, counter-clockwise, and then its holes, clockwise: so what is
  // solid is on the left. All but `parts` are one outline; a ring is a polygon given in either
  // orientation, and the vertices of a chain are no cycle.
  std::vector<std::vector<Cycle>> parts;

  bool is_closed() const {
    return kind == Kind::polygon || kind == Kind::ring || kind == Kind::parts;
  }
};

// Reads the word "bodies", a count, and the bodies: of so many vertices.
std::vector<Body> read_bodies(Reader& in, std::size_t vertices);

struct Edge {
  int u, v;
  bool boundary;  // of a body; otherwise a diagonal
  bool hull;
};

struct Face {
  Cycle vertices;
  std::array<int, 3> corners;
};

// A claim: faces are listed unless they are said to be all triangles.
struct Tiling {
  bool triangles;
  std::vector<Vertex> vertices;
  std::vector<Body> bodies;
  std::vector<Edge> edges;
  std::vector<Face> faces;
};

// Reads what follows the word "tiling" or "triangulation", "end" included.
Tiling read_tiling(Reader& in, bool triangles);

// What the edges make of the plane, found by CGAL from the coordinates.
struct Subdivision {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  // Of each bounded region the cycles around it, with the region on the left of each.
  std::vector<std::vector<Cycle>> regions;
  std::vector<std::pair<int, int>> outside;  // directed edges with the unbounded region beside them
};

// The claim is false: why, in words, with the culprit indices.
struct Bad : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Without coordinates: bodies and edges fit together. Throws Bad.
void check_structure(const Tiling& tiling);

// Polygons have area and are counter-clockwise, holes clockwise; rings are turned so. Throws Bad.
void orient_bodies(Tiling& tiling);

// Two independent ways from coordinates to regions. Both throw Bad for duplicate
// vertices, crossings, vertices inside an edge, missing hull edges, and regions whose
// boundary meets itself.
Subdivision by_triangulation(const Tiling& tiling);
Subdivision by_arrangement(const Tiling& tiling);

// How many components the edges have; a vertex without an edge is one.
std::size_t components(const Tiling& tiling);

// The regions are the polygons' insides and the claimed faces, all pseudo-triangles;
// flags, areas and counts are right. Throws Bad.
void judge(const Tiling& tiling, const Subdivision& found);

// The corners of the convex hull, counter-clockwise from the lexicographically smallest
// point; of equal points, the first. Points inside a hull edge are left out.
Cycle convex_hull(const std::vector<Vertex>& vertices);

std::string shown_edge(int u, int v);
std::string shown_cycle(const Cycle& cycle);
