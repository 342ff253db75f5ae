// What the numbers of a scene mean to people: read and checked, and not used.
#pragma once

#include "json.hpp"

namespace proof {

// The values of the keys "units" and "epoch", each null if it is not there. Throws NoProof.
void check_units(const Json* units, const Json* epoch);

}  // namespace proof
