// Contacts at a time at which angles vanish: step 6 of the specification.
#pragma once

#include <vector>

#include "map.hpp"
#include "predicates.hpp"

namespace proof {

// Throws Rejected if, at a time, two vertices of a cluster coincide or a vertex is on a body edge
// of it that does not end there. Clusters are the faces of some half-edges, joined where they
// share an edge that no body has.
void check_clusters(const Scene& scene, const Map& map, Predicates& predicates,
                    const std::vector<int>& halves, const Time& t);

}  // namespace proof
