// Whether pieces of a motion turn by the angle omega t, but for an error.
#pragma once

#include <utility>
#include <vector>

#include "polynomial.hpp"

namespace proof {

// A turn by the angle of the orientation and twice the arc tangent of the half turn.
struct Turn {
  Poly<Rational> half_turn;
  std::pair<Rational, Rational> orientation, pivot;
  Poly<Rational> x, y;  // a translation after it
};

// Of turns that follow one upon the other at some times: between the first one and the last
// one of these. True if nine samples of each piece, and a bound of the slope, show it.
bool is_spin(const std::vector<Rational>& until, const std::vector<Turn>& turns,
             const Rational& omega, const Rational& error);

}  // namespace proof
