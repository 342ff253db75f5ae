// Real roots, for what the signs of coefficients leave open: isolated by halving, compared by
// CGAL's univariate algebraic kernel.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "polynomial.hpp"

namespace proof {

class Root {
 public:
  // The only root in (low, high) of a square-free polynomial that has signs there.
  Root(const Poly<Integer>& f, const Rational& low, const Rational& high);

  int sign_of(const Poly<Integer>& g) const;

 private:
  struct Real;
  std::shared_ptr<const Real> real_;
  friend bool has_root(const Poly<Integer>&, const Rational&, const Rational&, const Root*,
                       const Root*);
};

Poly<Integer> square_free(const Poly<Integer>& f);

Poly<Integer> common_divisor(const Poly<Integer>& f, const Poly<Integer>& g);

using Roots = std::vector<std::pair<Rational, Rational>>;

// The roots of a square-free f in [low, high], by intervals with clear ends in which Descartes'
// rule counts one, or equal ends; nothing if so many halvings do not separate them (-1: no limit).
std::optional<Roots> isolated(const Poly<Integer>& f, const Rational& low, const Rational& high,
                              int most_halvings);

// Whether f, not 0, has a root r with low <= r <= high that is more than `after` and less
// than `before`, if these are given.
bool has_root(const Poly<Integer>& f, const Rational& low, const Rational& high,
              const Root* after, const Root* before);

}  // namespace proof
