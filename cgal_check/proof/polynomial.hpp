// Polynomials in time as lists of coefficients, constant term first: over integers,
// rationals, or intervals. Integer and rational ones end with a coefficient that is not 0.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "numbers.hpp"

namespace proof {

template <class T>
using Poly = std::vector<T>;

template <class T>
void trim(Poly<T>& f) {
  if constexpr (!std::is_same_v<T, Interval>)
    while (!f.empty() && f.back() == 0) f.pop_back();
}

template <class T>
Poly<T> operator+(const Poly<T>& f, const Poly<T>& g) {
  Poly<T> sum = f.size() < g.size() ? g : f;
  const Poly<T>& shorter = f.size() < g.size() ? f : g;
  for (std::size_t i = 0; i < shorter.size(); ++i) sum[i] += shorter[i];
  trim(sum);
  return sum;
}

template <class T>
Poly<T> operator-(const Poly<T>& f, const Poly<T>& g) {
  Poly<T> difference = f;
  if (f.size() < g.size()) difference.resize(g.size(), T(0));
  for (std::size_t i = 0; i < g.size(); ++i) difference[i] -= g[i];
  trim(difference);
  return difference;
}

template <class T>
Poly<T> operator*(const Poly<T>& f, const Poly<T>& g) {
  if (f.empty() || g.empty()) return {};
  Poly<T> product(f.size() + g.size() - 1, T(0));
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t k = 0; k < g.size(); ++k) product[i + k] += f[i] * g[k];
  return product;
}

template <class T, class Time>
Time value(const Poly<T>& f, const Time& t) {
  Time sum(0);
  for (std::size_t i = f.size(); i-- > 0;) {
    sum *= t;
    sum += f[i];
  }
  return sum;
}

// q^n (1 + s)^n f((a + b s) / (q (1 + s))), with n at least the degree of f. As s runs from 0
// to infinity, the time runs from a/q to b/q: if all coefficients have one sign, f has this
// sign in all of [a/q, b/q] (they are its Bernstein coefficients there, up to binomials). The
// first and the last coefficient have the signs of f at the ends.
template <class T>
Poly<T> between(const Poly<T>& f, const T& a, const T& b, const T& q, std::size_t n) {
  const Poly<T> line{a, b}, unit{q, q};
  Poly<T> result, power{T(1)};
  for (std::size_t i = f.size(); i-- > 0;) {
    if (!result.empty()) result = result * line;
    Poly<T> term = power;
    for (T& c : term) c *= f[i];
    if (result.size() < term.size()) result.resize(term.size(), T(0));
    for (std::size_t k = 0; k < term.size(); ++k) result[k] += term[k];
    if (i > 0) power = power * unit;
  }
  if (result.empty()) result.push_back(T(0));
  while (result.size() < n + 1) result = result * unit;
  return result;
}

// Divided by the greatest common divisor of its coefficients, the last one positive.
Poly<Integer> primitive(Poly<Integer> f);

// An integer polynomial with the same zeros and signs.
Poly<Integer> integral(const Poly<Rational>& f);

// A coefficient of the most words.
std::vector<Integer>::const_iterator longest(const Poly<Integer>& f);

int sign_at(const Poly<Integer>& f, const Rational& t);

// Divided by (q t - p) as often as that is possible, where t = p/q.
Poly<Integer> without_root(Poly<Integer> f, const Rational& t);

// The coefficients of `between` in [low, high].
Poly<Integer> between(const Poly<Integer>& f, const Rational& low, const Rational& high);

// How often the signs of the coefficients change, zeros left out.
int variations(const Poly<Integer>& f);

}  // namespace proof
