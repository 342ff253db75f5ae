#include "roots.hpp"

#include <iterator>
#include <utility>

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/CORE_BigInt.h>

namespace proof {

namespace {

using Kernel1 = CGAL::Algebraic_kernel_d_1<CORE::BigInt>;
using Bound = Kernel1::Bound;
using Polynomial1 = Kernel1::Polynomial_1;

const Kernel1 kernel1{};

CORE::BigInt big(const Integer& n) { return CORE::BigInt(n.get_mpz_t()); }

Bound bound(const Rational& q) { return Bound(big(q.get_num()), big(q.get_den())); }

Polynomial1 polynomial(const Poly<Integer>& f) {
  std::vector<CORE::BigInt> coefficients;
  for (const Integer& c : f) coefficients.push_back(big(c));
  if (coefficients.empty()) return Polynomial1(0);
  return Polynomial1(coefficients.begin(), coefficients.end());
}

using Solutions = std::vector<std::pair<Kernel1::Algebraic_real_1, int>>;

Solutions roots_of(const Poly<Integer>& f, const Rational& low, const Rational& high) {
  Solutions found;
  if (f.size() > 1)
    kernel1.solve_1_object()(polynomial(f), bound(low), bound(high), std::back_inserter(found));
  return found;
}

int number(CGAL::Sign sign) { return static_cast<int>(sign); }

}  // namespace

struct Root::Real {
  Kernel1::Algebraic_real_1 value;
};

Root::Root(const Poly<Integer>& f, const Rational& low, const Rational& high)
    : real_(std::make_shared<Real>(Real{kernel1.construct_algebraic_real_1_object()(
          polynomial(f), bound(low), bound(high))})) {}

int Root::sign_of(const Poly<Integer>& g) const {
  return g.empty() ? 0 : number(kernel1.sign_at_1_object()(polynomial(g), real_->value));
}

Poly<Integer> square_free(const Poly<Integer>& f) {
  const Polynomial1 g = kernel1.make_square_free_1_object()(polynomial(f));
  Poly<Integer> result;
  for (int i = 0; i <= g.degree(); ++i) result.emplace_back(g[i].get_mp());
  return primitive(result);
}

bool has_root(const Poly<Integer>& f, const Rational& low, const Rational& high,
              const Root* after, const Root* before) {
  const auto compare = kernel1.compare_1_object();
  for (const auto& [root, multiplicity] : roots_of(f, low, high)) {
    const bool is_late = !after || compare(root, after->real_->value) == CGAL::LARGER;
    const bool is_early = !before || compare(root, before->real_->value) == CGAL::SMALLER;
    if (is_late && is_early) return true;
  }
  return false;
}

}  // namespace proof
