// Polygons at one instant, by CGAL.
#pragma once

#include <utility>
#include <vector>

#include "numbers.hpp"

namespace proof {

// Whether edges meet where they are joined and nowhere else, and vertices are apart.
bool is_simple(const std::vector<std::pair<Rational, Rational>>& polygon);

// Whether a point is inside a simple polygon or on its edges.
bool is_in(const std::vector<std::pair<Rational, Rational>>& polygon,
           const std::pair<Rational, Rational>& point);

// Whether an edge of one polygon meets one of another.
bool do_edges_meet(const std::vector<std::pair<Rational, Rational>>& one,
                   const std::vector<std::pair<Rational, Rational>>& other);

// Whether two segments, or points, have a point in common.
bool do_meet(const std::pair<Rational, Rational>& a, const std::pair<Rational, Rational>& b,
             const std::pair<Rational, Rational>& c, const std::pair<Rational, Rational>& d);

}  // namespace proof
