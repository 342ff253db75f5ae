#include "roots.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/CORE_BigInt.h>

#include "faults.hpp"

namespace proof {

namespace {

using Kernel1 = CGAL::Algebraic_kernel_d_1<CORE::BigInt>;
using Bound = Kernel1::Bound;
using Polynomial1 = Kernel1::Polynomial_1;

const Kernel1 kernel1{};

CORE::BigInt big(const Integer& n) { return CORE::BigInt(n.get_mpz_t()); }

// The GMP integer inside of CORE::BigInt: a class of its own in CGAL 5, one of Boost in CGAL 6.
template <class BigInt>
auto mpz_of(const BigInt& n, int) -> decltype(n.get_mp()) {
  return n.get_mp();
}
template <class BigInt>
auto mpz_of(const BigInt& n, long) -> decltype(n.backend().data()) {
  return n.backend().data();
}

Bound bound(const Rational& q) { return Bound(big(q.get_num()), big(q.get_den())); }

Polynomial1 polynomial(const Poly<Integer>& f) {
  std::vector<CORE::BigInt> coefficients;
  for (const Integer& c : f) coefficients.push_back(big(c));
  if (coefficients.empty()) return Polynomial1(0);
  return Polynomial1(coefficients.begin(), coefficients.end());
}

Poly<Integer> integers(const Polynomial1& f) {
  Poly<Integer> result;
  for (int i = 0; i <= f.degree(); ++i) result.emplace_back(mpz_of(f[i], 0));
  return primitive(result);
}

double words(const Poly<Integer>& f) {
  return f.empty() ? 1 : static_cast<double>(mpz_size(longest(f)->get_mpz_t()));
}

// What CGAL does with one polynomial, or with two of them: greatest common divisors, and
// evaluations until two roots are apart, by which the intervals get shorter quadratically.
void spend_on(const Poly<Integer>& f, const Poly<Integer>& g) {
  const double n = static_cast<double>(f.size() + g.size());
  spend(n * n * (words(f) + words(g)) * 16);
}

int number(CGAL::Sign sign) { return static_cast<int>(sign); }

}  // namespace

struct Root::Real {
  Poly<Integer> f;
  Kernel1::Algebraic_real_1 value;
};

Root::Root(const Poly<Integer>& f, const Rational& low, const Rational& high)
    : real_(std::make_shared<Real>(Real{f, kernel1.construct_algebraic_real_1_object()(
          polynomial(f), bound(low), bound(high))})) {}

int Root::sign_of(const Poly<Integer>& g) const {
  spend_on(real_->f, g);
  return g.empty() ? 0 : number(kernel1.sign_at_1_object()(polynomial(g), real_->value));
}

Poly<Integer> square_free(const Poly<Integer>& f) {
  spend_on(f, {});
  return integers(kernel1.make_square_free_1_object()(polynomial(f)));
}

Poly<Integer> common_divisor(const Poly<Integer>& f, const Poly<Integer>& g) {
  spend_on(f, g);
  using Gcd = CGAL::Polynomial_traits_d<Polynomial1>::Gcd_up_to_constant_factor;
  return integers(Gcd()(polynomial(f), polynomial(g)));
}

std::optional<Roots> isolated(const Poly<Integer>& f, const Rational& low, const Rational& high,
                              int most_halvings) {
  struct Piece {
    Rational low, high;
    int depth;
  };
  Roots found;
  for (const Rational& q : {low, high})
    if (sign_at(f, q) == 0) found.emplace_back(q, q);
  std::vector<Piece> open{{low, high, 0}};
  while (!open.empty()) {
    const Piece piece = open.back();
    open.pop_back();
    const Poly<Integer> signs = between(f, piece.low, piece.high);
    const int count = variations(signs);
    if (count == 1 && sign(signs.front()) != 0 && sign(signs.back()) != 0) {
      found.emplace_back(piece.low, piece.high);
    } else if (count > 0) {
      if (piece.depth == most_halvings) return {};
      const Rational middle = (piece.low + piece.high) / 2;
      if (sign_at(f, middle) == 0) found.emplace_back(middle, middle);
      open.push_back({piece.low, middle, piece.depth + 1});
      open.push_back({middle, piece.high, piece.depth + 1});
    }
  }
  return found;
}

bool has_root(const Poly<Integer>& f, const Rational& low, const Rational& high,
              const Root* after, const Root* before) {
  // Halving, which is counted, and not CGAL's isolation, whose time no count would bound.
  if (f.size() < 2) return false;
  const Poly<Integer> g = square_free(f);
  const std::optional<Roots> roots = isolated(g, low, high, -1);
  const auto order = [&](const Rational& from, const Rational& to, const Root& other) {
    spend_on(g, other.real_->f);
    const auto root = from == to ? kernel1.construct_algebraic_real_1_object()(bound(from))
                                 : Root(g, from, to).real_->value;
    return kernel1.compare_1_object()(root, other.real_->value);
  };
  return std::any_of(roots->begin(), roots->end(), [&](const auto& root) {
    return (!after || order(root.first, root.second, *after) == CGAL::LARGER) &&
           (!before || order(root.first, root.second, *before) == CGAL::SMALLER);
  });
}

}  // namespace proof
