#include "tiling.hpp"

#include <gmp.h>

namespace {

Cycle read_cycle(Reader& in, std::size_t size, std::size_t of) {
  Cycle cycle;
  for (std::size_t i = 0; i < size; ++i) cycle.push_back(in.index(of, "vertex"));
  return cycle;
}

Cycle read_counted(Reader& in, const std::string& kind, std::size_t vertices) {
  const std::size_t size = in.count();
  if (size < 3) throw BadInput("a " + kind + " has three vertices or more, not " +
                               std::to_string(size));
  return read_cycle(in, size, vertices);
}

std::vector<std::vector<Cycle>> read_parts(Reader& in, std::size_t vertices) {
  std::vector<std::vector<Cycle>> parts(in.count());
  if (parts.empty()) throw BadInput("a body has one part or more");
  for (std::vector<Cycle>& part : parts) {
    part.push_back(read_counted(in, "part", vertices));
    in.expect("holes");
    for (std::size_t n = in.count(); n > 0; --n) part.push_back(read_counted(in, "hole", vertices));
  }
  return parts;
}

Body read_body(Reader& in, std::size_t vertices) {
  const std::string kind = in.word();
  if (kind == "point") return {Body::Kind::point, {{read_cycle(in, 1, vertices)}}};
  if (kind == "segment") return {Body::Kind::segment, {{read_cycle(in, 2, vertices)}}};
  if (kind == "parts") return {Body::Kind::parts, read_parts(in, vertices)};
  if (kind != "polygon" && kind != "ring" && kind != "chain")
    throw BadInput("unknown kind of body: '" + shown(kind) + "'");
  const auto which = kind == "polygon" ? Body::Kind::polygon
                     : kind == "ring"  ? Body::Kind::ring
                                       : Body::Kind::chain;
  return {which, {{read_counted(in, kind, vertices)}}};
}

bool read_either(Reader& in, std::string_view yes, std::string_view no) {
  if (in.accept(yes)) return true;
  if (in.accept(no)) return false;
  throw BadInput("expected '" + std::string(yes) + "' or '" + std::string(no) + "', found '" +
                 shown(in.word()) + "'");
}

Edge read_edge(Reader& in, std::size_t vertices) {
  const int u = in.index(vertices, "vertex");
  const int v = in.index(vertices, "vertex");
  const bool boundary = read_either(in, "boundary", "diagonal");
  const bool hull = read_either(in, "hull", "inner");
  return {u, v, boundary, hull};
}

Face read_face(Reader& in, std::size_t vertices) {
  const std::size_t size = in.count();
  Face face{read_cycle(in, size, vertices), {}};
  in.expect("corners");
  for (int& corner : face.corners) corner = in.index(vertices, "vertex");
  return face;
}

}  // namespace

Rational rational_from(const Fraction& written) {
  mpq_t q;
  mpq_init(q);
  // The reader has seen to the digits and to the denominator.
  mpz_set_str(mpq_numref(q), written.numerator.c_str(), 10);
  mpz_set_str(mpq_denref(q), written.denominator.c_str(), 10);
  mpq_canonicalize(q);
  Rational result(q);
  mpq_clear(q);
  return result;
}

Vertex read_vertex(Reader& in) {
  Rational x = rational_from(in.fraction());
  Rational y = rational_from(in.fraction());
  return {std::move(x), std::move(y)};
}

std::vector<Vertex> read_vertices(Reader& in) {
  std::vector<Vertex> vertices;
  in.expect("vertices");
  for (std::size_t n = in.count(); n > 0; --n) vertices.push_back(read_vertex(in));
  return vertices;
}

std::vector<Body> read_bodies(Reader& in, std::size_t vertices) {
  std::vector<Body> bodies;
  in.expect("bodies");
  for (std::size_t n = in.count(); n > 0; --n) bodies.push_back(read_body(in, vertices));
  return bodies;
}

Tiling read_tiling(Reader& in, bool triangles) {
  Tiling tiling{triangles, read_vertices(in), {}, {}, {}};
  const std::size_t size = tiling.vertices.size();
  tiling.bodies = read_bodies(in, size);
  in.expect("edges");
  for (std::size_t n = in.count(); n > 0; --n) tiling.edges.push_back(read_edge(in, size));
  if (!triangles) {
    in.expect("faces");
    for (std::size_t n = in.count(); n > 0; --n) tiling.faces.push_back(read_face(in, size));
  }
  in.expect("end");
  return tiling;
}

std::string shown_edge(int u, int v) { return std::to_string(u) + "-" + std::to_string(v); }

std::string shown_cycle(const Cycle& cycle) {
  constexpr std::size_t limit = 12;
  std::string text;
  for (std::size_t i = 0; i < cycle.size() && i < limit; ++i)
    text += (i == 0 ? "" : "-") + std::to_string(cycle[i]);
  if (cycle.size() > limit) text += "-... (" + std::to_string(cycle.size()) + " vertices)";
  return text;
}
