// Polygons and chains at one instant, by CGAL.
#pragma once

#include <utility>
#include <vector>

#include "numbers.hpp"

namespace proof {

// Whether edges, by the indices of their ends, have length, and meet where one ends and another
// one begins alone.
bool is_simple(const std::vector<std::pair<Rational, Rational>>& places,
               const std::vector<std::pair<int, int>>& edges);

// Whether a point is in a polygon or on its boundary; on its boundary.
bool is_in(const std::vector<std::pair<Rational, Rational>>& polygon,
           const std::pair<Rational, Rational>& p);
bool is_on_boundary(const std::vector<std::pair<Rational, Rational>>& polygon,
                    const std::pair<Rational, Rational>& p);

// Whether two closed segments have a point in common.
bool do_meet(const std::pair<Rational, Rational>& a, const std::pair<Rational, Rational>& b,
             const std::pair<Rational, Rational>& c, const std::pair<Rational, Rational>& d);

}  // namespace proof
