// Contacts at a time at which angles vanish: step 6 of the specification.
#pragma once

#include <set>
#include <tuple>
#include <vector>

#include "map.hpp"
#include "predicates.hpp"

namespace proof {

// Throws Rejected if, at a time, two vertices of a cluster coincide or a vertex is on a body edge
// of it that does not end there. Clusters are the faces of some half-edges, joined where they
// share an edge that no body has.
void check_clusters(const Scene& scene, const Map& map, Predicates& predicates,
                    const std::vector<int>& halves, const Time& t);

// All that touches at a time, by the faces of some half-edges, taken together: a vertex and
// another one, or a vertex and the first vertex of an edge.
struct Incidence {
  int vertex;
  bool is_on_edge;
  int other;

  bool operator<(const Incidence& i) const {
    return std::tie(vertex, is_on_edge, other) < std::tie(i.vertex, i.is_on_edge, i.other);
  }
  bool operator==(const Incidence& i) const { return !(*this < i) && !(i < *this); }
};

std::set<Incidence> incidences(const Scene& scene, const Map& map, Predicates& predicates,
                               const std::vector<int>& halves, const Time& t);

}  // namespace proof
