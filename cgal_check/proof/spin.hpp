// Whether pieces of a motion follow a path of poses, such as a turn by omega t, but for an error.
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

// A piece of a path: x, y and an angle in radians, of the time since it begins.
struct Pose {
  Rational begin, end;
  Poly<Rational> x, y, angle;
};

// The record of a path: poses that turn about a pivot, and which turns follow within errors.
struct PathRecord {
  std::pair<Rational, Rational> pivot;
  std::vector<Pose> poses;
  Rational error, place_error;  // of the angle, without what is assumed of it; of the translation
  bool does_rest;  // before and after the path; otherwise the turns there do not turn
};

// True if turns about the pivot follow a path, at rest before and after it, with at most an
// error of the angle and one of the translation. With h and the angle polynomials of the part s of
// a piece, the error e of the angle has the derivative w N, w = 1 / (1 + h^2) and N = 2 h' - angle' (1
// + h^2). With E the primitive of N from 0 on, by parts, |e(s)| <= |e(0)| + max |E| (1 + 2 max
// |h| max |h'|), since |w'| <= 2 |h h'|.
bool is_path(const std::vector<Rational>& until, const std::vector<Turn>& turns,
             const PathRecord& path);

// True if turns, all with one translation, follow the path whose angle is omega t, from the first of
// the times to the last, and do not turn before and after it.
bool is_spin(const std::vector<Rational>& until, const std::vector<Turn>& turns,
             const Rational& omega, const Rational& error);

}  // namespace proof
