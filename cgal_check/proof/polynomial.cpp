#include "polynomial.hpp"

#include <algorithm>

#include "faults.hpp"

namespace proof {

Poly<Integer> primitive(Poly<Integer> f) {
  if (f.empty()) return f;
  Integer divisor = 0;
  for (const Integer& c : f) divisor = gcd(divisor, c);
  if (sign(f.back()) < 0) divisor = -divisor;
  if (divisor != 1)
    for (Integer& c : f) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), divisor.get_mpz_t());
  return f;
}

Poly<Integer> integral(const Poly<Rational>& f) {
  Integer denominator = 1;
  for (const Rational& c : f) denominator = lcm(denominator, c.get_den());
  Poly<Integer> result;
  for (const Rational& c : f) result.push_back(c.get_num() * (denominator / c.get_den()));
  return result;
}

std::vector<Integer>::const_iterator longest(const Poly<Integer>& f) {
  return std::max_element(f.begin(), f.end(), [](const Integer& a, const Integer& b) {
    return mpz_size(a.get_mpz_t()) < mpz_size(b.get_mpz_t());
  });
}

int sign_at(const Poly<Integer>& f, const Rational& t) {
  const Integer& p = t.get_num();
  const Integer& q = t.get_den();
  Integer sum = 0, power = 1;
  const auto size = [](const Integer& n) { return static_cast<double>(mpz_size(n.get_mpz_t())); };
  const double n = static_cast<double>(f.size());
  spend(n * n * size(q) * (size(p) + size(q) + (f.empty() ? 0 : size(*longest(f)))));
  for (std::size_t i = f.size(); i-- > 0;) {
    sum *= p;
    sum += f[i] * power;
    power *= q;
  }
  return sign(sum);
}

Poly<Integer> without_root(Poly<Integer> f, const Rational& t) {
  while (f.size() > 1 && sign_at(f, t) == 0) {
    // f = (q t - p) g, hence g_(i-1) = (f_i + p g_i) / q, from the last one down.
    Poly<Integer> g(f.size() - 1);
    Integer above = 0;
    for (std::size_t i = f.size() - 1; i > 0; --i) {
      above = f[i] + t.get_num() * above;
      mpz_divexact(above.get_mpz_t(), above.get_mpz_t(), t.get_den().get_mpz_t());
      g[i - 1] = above;
    }
    f = g;
  }
  return f;
}

Poly<Integer> between(const Poly<Integer>& f, const Rational& low, const Rational& high) {
  const Integer q = lcm(low.get_den(), high.get_den());
  const Integer a = low.get_num() * (q / low.get_den());
  const Integer b = high.get_num() * (q / high.get_den());
  const double n = static_cast<double>(f.size()), long_q = static_cast<double>(mpz_size(q.get_mpz_t()));
  const double long_f = f.empty() ? 0 : static_cast<double>(mpz_size(longest(f)->get_mpz_t()));
  spend(n * n * long_q * (long_f + n * (long_q + long_f / 3)));
  return between(f, a, b, q, f.empty() ? 0 : f.size() - 1);
}

int variations(const Poly<Integer>& f) {
  int count = 0, last = 0;
  for (const Integer& c : f) {
    const int now = sign(c);
    if (now != 0 && last != 0 && now != last) ++count;
    if (now != 0) last = now;
  }
  return count;
}

}  // namespace proof
