// By CGAL: what two bodies have in common at one instant, and unions.
#include "bodies.hpp"

#include <algorithm>
#include <sstream>
#include <variant>
#include <vector>

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/Rational_traits.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_2.h>

#include "tiling.hpp"

namespace {

// Plain rationals without a filter, as in arrangement.cpp, and for the reason given there.
using Exact = CGAL::Simple_cartesian<Rational>;
using Place = Exact::Point_2;
using Segment = Exact::Segment_2;
using Polygon = CGAL::Polygon_2<Exact>;
using Region = CGAL::Polygon_set_2<Exact>;

// An edge; or a vertex, of a body without edges, or where the ends of an edge are at one place.
using Feature = std::variant<Place, Segment>;

struct Part {
  Polygon outline;
  std::vector<Polygon> holes;
};

// A body at its place. Its features cover its boundary, or all of it if it has no inside.
struct Shape {
  std::vector<Feature> features;
  std::vector<Part> parts;     // of a closed body
  std::vector<Place> corners;  // one for each connected piece of the boundary
};

Feature feature_between(const Place& a, const Place& b) {
  if (a == b) return a;
  return Segment(a, b);
}

// The features of a chain of places; those of a single place are itself.
void add_features(const std::vector<Place>& places, bool is_closed, Shape& shape) {
  if (places.size() == 1) shape.features.push_back(places.front());
  for (std::size_t i = 1; i < places.size(); ++i)
    shape.features.push_back(feature_between(places[i - 1], places[i]));
  if (is_closed) shape.features.push_back(feature_between(places.back(), places.front()));
  shape.corners.push_back(places.front());
}

// CGAL's predicates of polygons and its regions demand that rings are simple.
Polygon simple_polygon(const std::vector<Place>& places, const std::string& name) {
  Polygon polygon(places.begin(), places.end());
  if (!polygon.is_simple()) throw Bad(name + " is not simple");
  if (polygon.is_clockwise_oriented()) polygon.reverse_orientation();
  return polygon;
}

Shape shape_of(const Body& body, const std::vector<Vertex>& vertices, const std::string& name) {
  Shape shape;
  for (std::size_t p = 0; p < body.parts.size(); ++p) {
    Part part;
    for (std::size_t k = 0; k < body.parts[p].size(); ++k) {
      std::vector<Place> places;
      for (int v : body.parts[p][k]) places.emplace_back(vertices[v].x, vertices[v].y);
      add_features(places, body.is_closed(), shape);
      if (!body.is_closed()) continue;
      const bool is_hole = k > 0;
      const std::string ring =
          (is_hole ? "hole " + std::to_string(k - 1) : "the outline") + " of part ";
      Polygon polygon = simple_polygon(places, ring + std::to_string(p) + " of " + name);
      if (is_hole)
        part.holes.push_back(std::move(polygon));
      else
        part.outline = std::move(polygon);
    }
    if (body.is_closed()) shape.parts.push_back(std::move(part));
  }
  return shape;
}

std::vector<Shape> read_shapes(Reader& in) {
  const std::vector<Vertex> vertices = read_vertices(in);
  const std::vector<Body> bodies = read_bodies(in, vertices.size());
  in.expect("end");
  std::vector<Shape> shapes;
  for (const Body& body : bodies)
    shapes.push_back(shape_of(body, vertices, "body " + std::to_string(shapes.size())));
  return shapes;
}

bool do_intersect(const Feature& a, const Feature& b) {
  return std::visit([](const auto& p, const auto& q) { return CGAL::do_intersect(p, q); }, a, b);
}

Rational squared_distance(const Feature& a, const Feature& b) {
  return std::visit(
      [](const auto& p, const auto& q) -> Rational { return CGAL::squared_distance(p, q); }, a, b);
}

bool is_in(const Place& place, const Part& part) {
  if (part.outline.bounded_side(place) == CGAL::ON_UNBOUNDED_SIDE) return false;
  return std::none_of(part.holes.begin(), part.holes.end(), [&](const Polygon& hole) {
    return hole.bounded_side(place) == CGAL::ON_BOUNDED_SIDE;
  });
}

bool has_a_corner_in(const Shape& a, const Shape& b) {
  for (const Place& corner : a.corners)
    for (const Part& part : b.parts)
      if (is_in(corner, part)) return true;
  return false;
}

// Closed sets: where no features meet, each ring of one body is inside or outside of each part of
// the other, and all of a ring is where a corner of it is.
bool share_a_point(const Shape& a, const Shape& b) {
  for (const Feature& f : a.features)
    for (const Feature& g : b.features)
      if (do_intersect(f, g)) return true;
  return has_a_corner_in(a, b) || has_a_corner_in(b, a);
}

// The square of the distance of two bodies that share no point.
Rational squared_distance(const Shape& a, const Shape& b) {
  Rational least = squared_distance(a.features.front(), b.features.front());
  for (const Feature& f : a.features)
    for (const Feature& g : b.features) least = std::min(least, squared_distance(f, g));
  return least;
}

// The inside of a body, which is empty if the body is not closed.
Region region_of(const Shape& shape) {
  Region region;
  for (const Part& part : shape.parts) {
    Region inside(part.outline);
    for (const Polygon& hole : part.holes) inside.difference(hole);
    region.join(inside);
  }
  return region;
}

// In lowest terms, in the same way for each number type that CGAL may have chosen.
std::string shown_rational(const Rational& value) {
  const CGAL::Rational_traits<Rational> traits;
  std::ostringstream text;
  text << traits.numerator(value);
  if (traits.denominator(value) != 1) text << '/' << traits.denominator(value);
  return text.str();
}

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

std::vector<CGAL::Polygon_with_holes_2<Exact>> parts_of(const Region& region) {
  std::vector<CGAL::Polygon_with_holes_2<Exact>> parts;
  region.polygons_with_holes(std::back_inserter(parts));
  return parts;
}

Rational area_of(const Region& region) {
  Rational area = 0;
  for (const auto& part : parts_of(region)) {
    area += part.outer_boundary().area();
    for (const Polygon& hole : part.holes()) area += hole.area();
  }
  return area;  // a hole is clockwise: its area is negative
}

}  // namespace

std::string reply_to_pair(Reader& in) {
  const std::vector<Shape> shapes = read_shapes(in);
  if (shapes.size() != 2)
    throw BadInput("a pair has two bodies, not " + std::to_string(shapes.size()));
  const Shape &a = shapes.front(), &b = shapes.back();
  const bool has_common = share_a_point(a, b);
  const bool do_overlap = region_of(a).do_intersect(region_of(b));
  const Rational squared = has_common ? Rational(0) : squared_distance(a, b);
  return "ok intersect " + yes_or_no(has_common) + " overlap " + yes_or_no(do_overlap) +
         " squared " + shown_rational(squared);
}

std::string reply_to_union(Reader& in) {
  const std::vector<Shape> shapes = read_shapes(in);
  if (shapes.empty()) throw BadInput("a union has one body or more");
  const Region claimed = region_of(shapes.back());
  Region joined;
  for (std::size_t i = 0; i + 1 < shapes.size(); ++i) joined.join(region_of(shapes[i]));
  Region missing = joined, added = claimed;
  missing.difference(claimed);
  added.difference(joined);
  if (!missing.is_empty() || !added.is_empty())
    throw Bad("an area of " + shown_rational(area_of(missing)) + " is missing, of " +
              shown_rational(area_of(added)) + " is too much");
  const auto parts = parts_of(joined);
  std::size_t holes = 0;
  for (const auto& part : parts) holes += part.number_of_holes();
  return "ok parts " + std::to_string(parts.size()) + " holes " + std::to_string(holes);
}
