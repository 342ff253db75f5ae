#include "algebra.hpp"

#include <vector>

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/CORE_BigInt.h>
#include <gmpxx.h>

#include "tiling.hpp"

namespace {

using Kernel1 = CGAL::Algebraic_kernel_d_1<CORE::BigInt>;
using Polynomial = Kernel1::Polynomial_1;
using Real = Kernel1::Algebraic_real_1;
using Bound = Kernel1::Bound;

const Kernel1 kernel1{};

struct Claim {
  Polynomial f;
  Bound low, high;
};

struct Located {
  Real value;
  std::size_t roots;  // distinct real roots of the polynomial
  std::size_t rank;   // which one it is, from 1
  int multiplicity;
};

// Through GMP: CORE::BigInt is a class of its own or one of Boost, by the version of CGAL.
CORE::BigInt big_integer(const std::string& digits) {
  return CORE::BigInt(mpz_class(digits, 10).get_mpz_t());
}

Polynomial read_polynomial(Reader& in) {
  std::vector<CORE::BigInt> coefficients;
  for (std::size_t n = in.count(); n > 0; --n)
    coefficients.push_back(big_integer(in.integer()));
  if (coefficients.empty()) return Polynomial(0);
  if (CGAL::is_zero(coefficients.back()))
    throw BadInput("the leading coefficient of a polynomial is zero");
  return Polynomial(coefficients.begin(), coefficients.end());
}

Bound read_bound(Reader& in) {
  const Fraction f = in.fraction();
  return Bound(big_integer(f.numerator), big_integer(f.denominator));  // canonicalises
}

Claim read_claim(Reader& in) {
  in.expect("polynomial");
  Polynomial f = read_polynomial(in);
  if (CGAL::is_zero(f)) throw BadInput("every number is a root of the zero polynomial");
  in.expect("between");
  Bound low = read_bound(in);
  Bound high = read_bound(in);
  if (low > high) throw BadInput("the interval is reversed");
  return {f, low, high};
}

using Solutions = std::vector<std::pair<Real, int>>;

Solutions real_roots(const Polynomial& f) {
  Solutions roots;
  if (CGAL::degree(f) > 0) kernel1.solve_1_object()(f, std::back_inserter(roots));
  return roots;
}

Located locate(const Claim& claim, const std::string& which = "") {
  const auto compare = kernel1.compare_1_object();
  const Solutions roots = real_roots(claim.f);
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < roots.size(); ++i)
    if (compare(roots[i].first, claim.low) != CGAL::SMALLER &&
        compare(roots[i].first, claim.high) != CGAL::LARGER)
      inside.push_back(i);
  if (inside.size() != 1)
    throw Bad(which + std::to_string(inside.size()) + " of the " + std::to_string(roots.size()) +
              " distinct real roots are in the interval");
  const std::size_t i = inside.front();
  return {roots[i].first, roots.size(), i + 1, roots[i].second};
}

char symbol(CGAL::Sign sign) {
  return sign == CGAL::NEGATIVE ? '-' : sign == CGAL::ZERO ? '0' : '+';
}

CGAL::Sign sign_at_bound(const Polynomial& g, const Bound& q) {
  return kernel1.sign_at_1_object()(g, kernel1.construct_algebraic_real_1_object()(q));
}

// Rationals before and after `where`, with no root of g between them and `where`: found
// from the neighbouring roots of g, not from its derivatives.
std::pair<Bound, Bound> rationals_around(const Polynomial& g, const Real& where) {
  const auto compare = kernel1.compare_1_object();
  const auto between = kernel1.bound_between_1_object();
  const auto [low, high] = kernel1.approximate_absolute_1_object()(where, 1);
  Bound before = low - Bound(1);
  Bound after = high + Bound(1);
  const Solutions roots = real_roots(g);
  for (const auto& [root, multiplicity] : roots) {
    const auto order = compare(root, where);
    if (order == CGAL::SMALLER) before = between(root, where);  // the last one counts
    if (order == CGAL::LARGER) {
      after = between(where, root);
      break;
    }
  }
  return {before, after};
}

}  // namespace

std::string reply_to_root(Reader& in) {
  const Claim claim = read_claim(in);
  in.expect("end");
  const Located found = locate(claim);
  return "ok roots " + std::to_string(found.roots) + " rank " + std::to_string(found.rank) +
         " multiplicity " + std::to_string(found.multiplicity);
}

std::string reply_to_compare(Reader& in) {
  const Claim first = read_claim(in);
  const Claim second = read_claim(in);
  in.expect("end");
  const Located a = locate(first, "the first: "), b = locate(second, "the second: ");
  const auto order = kernel1.compare_1_object()(a.value, b.value);
  return order == CGAL::SMALLER ? "ok <" : order == CGAL::EQUAL ? "ok =" : "ok >";
}

std::string reply_to_sign(Reader& in) {
  const Claim claim = read_claim(in);
  in.expect("of");
  const Polynomial g = read_polynomial(in);
  in.expect("end");
  const Real where = locate(claim).value;
  if (CGAL::is_zero(g)) return "ok 0 0 0";
  const auto [before, after] = rationals_around(g, where);
  return std::string("ok ") + symbol(sign_at_bound(g, before)) + ' ' +
         symbol(kernel1.sign_at_1_object()(g, where)) + ' ' + symbol(sign_at_bound(g, after));
}
