// cgal_check: an independent witness for exactpt. Reads requests from standard input and
// writes one line of answer each; the protocol is in README.md. Or verifies a proof.
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <string>

#include <CGAL/version.h>

#include "algebra.hpp"
#include "bodies.hpp"
#include "proof/verify.hpp"
#include "reader.hpp"
#include "tiling.hpp"

namespace {

// A client may have several tilings under way without reading the answers, as long as
// these fit into the pipe.
constexpr std::size_t longest_reason = 900;

void answer(const std::string& line) {
  std::puts(line.c_str());
  std::fflush(stdout);
}

using Witness = Subdivision (*)(const Tiling&);

// What this witness has against the tiling; empty if nothing.
std::string objection(Witness witness, const Tiling& tiling) {
  try {
    judge(tiling, witness(tiling));
    return "";
  } catch (const Bad& bad) {
    return bad.what();
  }
}

std::string statistics(const Tiling& tiling, int witnesses) {
  std::size_t polygons = 0, hull = 0;
  for (const Body& body : tiling.bodies) polygons += body.is_closed() ? body.parts.size() : 0;
  for (const Edge& e : tiling.edges) hull += e.hull ? 1 : 0;
  // By Euler's formula, which was verified; a triangulation lists no faces.
  const std::size_t regions = tiling.edges.size() + components(tiling) - tiling.vertices.size();
  const auto item = [](const char* name, std::size_t n) {
    return std::string(" ") + name + " " + std::to_string(n);
  };
  return "ok" + item("vertices", tiling.vertices.size()) + item("edges", tiling.edges.size()) +
         item("faces", regions - polygons) + item("polygons", polygons) + item("hull", hull) +
         item("witnesses", witnesses);
}

std::string reply_to_tiling(Reader& in, bool triangles) {
  const bool deep = in.accept("deep");
  Tiling tiling = read_tiling(in, triangles);
  check_structure(tiling);
  orient_bodies(tiling);
  const std::string first = objection(by_triangulation, tiling);
  if (!deep) {
    if (!first.empty()) throw Bad(first);
    return statistics(tiling, 1);
  }
  const std::string second = objection(by_arrangement, tiling);
  if (first.empty() && second.empty()) return statistics(tiling, 2);
  const auto words = [](const std::string& text) { return text.empty() ? "no objection" : text; };
  throw Bad("triangulation: " + words(first) + "; arrangement: " + words(second));
}

std::string reply_to_hull(Reader& in) {
  std::vector<Vertex> points;
  for (std::size_t n = in.count(); n > 0; --n) points.push_back(read_vertex(in));
  in.expect("end");
  std::string line = "ok";
  for (int v : convex_hull(points)) line += " " + std::to_string(v);
  return line;
}

std::string reply_to_orientations(Reader& in) {
  std::string line = "ok";
  for (std::size_t n = in.count(); n > 0; --n) {
    const Vertex a = read_vertex(in), b = read_vertex(in), c = read_vertex(in);
    const auto turn = CGAL::orientation(a.point, b.point, c.point);
    line += turn == CGAL::LEFT_TURN ? " +" : turn == CGAL::RIGHT_TURN ? " -" : " 0";
  }
  in.expect("end");
  return line;
}

const std::map<std::string, std::function<std::string(Reader&)>> replies{
    {"tiling", [](Reader& in) { return reply_to_tiling(in, false); }},
    {"triangulation", [](Reader& in) { return reply_to_tiling(in, true); }},
    {"root", reply_to_root},
    {"compare", reply_to_compare},
    {"sign", reply_to_sign},
    {"hull", reply_to_hull},
    {"orientations", reply_to_orientations},
    {"pair", reply_to_pair},
    {"union", reply_to_union},
};

std::string reply(Reader& in) {
  const std::string name = in.word();
  const auto found = replies.find(name);
  if (found == replies.end()) throw BadInput("unknown request: '" + shown(name) + "'");
  try {
    return found->second(in);
  } catch (const Bad& bad) {
    return "bad " + std::string(bad.what()).substr(0, longest_reason);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 1) {
    if (std::string(arguments[1]) == "proof") return proof::verify(count - 2, arguments + 2);
    if (std::string(arguments[1]) == "proofs" && count == 2) return proof::verify_each(std::cin);
    answer("error: usage: cgal_check [proof SCENE PROOF | proof FOLDER | proofs]");
    return 2;
  }
  Reader in(STDIN_FILENO);
  try {
    in.expect("exactpt-check");
    in.expect("1");
    answer("exactpt-check 1 cgal " CGAL_STR(CGAL_VERSION));
    while (!in.at_end()) answer(reply(in));
    return 0;
  } catch (const BadInput& fault) {
    answer("error line " + std::to_string(in.line()) + ": " + fault.what());
    return 2;
  } catch (const std::exception& fault) {
    answer("error internal: " + shown(fault.what()));
    std::fprintf(stderr, "%s\n", fault.what());
    return 3;
  }
}
