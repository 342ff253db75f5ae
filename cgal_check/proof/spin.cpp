#include "spin.hpp"

#include <algorithm>

#include "faults.hpp"

namespace proof {

namespace {

using Bounds = std::pair<Rational, Rational>;
using Rationals = Poly<Rational>;

constexpr int samples = 8;  // equal parts of a piece
constexpr long most_bits = 512;

Integer floor(const Rational& q) {
  Integer result;
  mpz_fdiv_q(result.get_mpz_t(), q.get_num_mpz_t(), q.get_den_mpz_t());
  return result;
}

Rational over_power_of_two(const Integer& n, long bits) {
  Rational q(n);
  mpq_div_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(bits));
  return q;
}

// Of the arc tangent of x, 0 <= x <= 1/2, by its series. In units of 2^-n, a computed power is
// too small by less than 2, a term by less than 3, and what is left out is less than 3.
Bounds series(const Rational& x, long bits) {
  const long n = bits + 16;
  spend(100 * static_cast<double>(n));
  Rational scaled(x);
  mpq_mul_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), static_cast<mp_bitcnt_t>(n));
  Integer power = floor(scaled), total = 0;
  const Integer square = (power * power) >> static_cast<mp_bitcnt_t>(n);
  long terms = 0;
  for (; power != 0; ++terms) {
    const Integer term = power / (2 * terms + 1);
    total += terms % 2 == 0 ? term : Integer(-term);
    power = (power * square) >> static_cast<mp_bitcnt_t>(n);
  }
  const Integer off = 3 * terms + 4;
  return {over_power_of_two(total - off, n), over_power_of_two(total + off, n)};
}

// Of pi, by Machin's formula.
Bounds pi(long bits) {
  const Bounds a = series(Rational(1, 5), bits + 6), b = series(Rational(1, 239), bits + 6);
  return {16 * a.first - 4 * b.second, 16 * a.second - 4 * b.first};
}

// Of the arc tangent of x, |x| <= 1.
Bounds arc_tangent(const Rational& x, long bits) {
  if (x < 0) {
    const Bounds b = arc_tangent(-x, bits);
    return {-b.second, -b.first};
  }
  if (2 * x <= 1) return series(x, bits);
  const Bounds rest = series((1 - x) / (1 + x), bits + 1), whole = pi(bits + 1);
  return {whole.first / 4 - rest.second, whole.second / 4 - rest.first};
}

Bounds angle(Rational c, Rational s, long bits) {
  int quarters = 0;
  for (; c <= 0 || abs(s) > c; ++quarters) {
    const Rational before = c;
    c = s;
    s = -before;
  }
  const Bounds b = arc_tangent(s / (1 + c), bits), whole = pi(bits);
  return {2 * b.first + quarters * whole.first / 2, 2 * b.second + quarters * whole.second / 2};
}

double words(const Rational& q) {
  const auto bits = [](mpz_srcptr n) { return static_cast<double>(mpz_sizeinbase(n, 2)); };
  return (bits(q.get_num_mpz_t()) + bits(q.get_den_mpz_t())) / 64;
}

// Counts operations on all pairs of coefficients that get longer by some words with the degree.
void spend_on(const Rationals& f, double longer) {
  const double n = static_cast<double>(f.size());
  double most = n * longer;
  for (const Rational& c : f) most = std::max(most, words(c) + n * longer);
  spend(n * n * (500 + most * most));
}

// The polynomial of s that is f at the time a + (b - a) s.
Rationals along(const Rationals& f, const Rational& a, const Rational& b) {
  spend_on(f, std::max(words(a), words(b)));
  Rationals line{a, b - a}, g;
  trim(line);
  for (std::size_t i = f.size(); i-- > 0;) {
    Rationals term{f[i]};
    trim(term);
    g = g * line + term;
  }
  return g;
}

Rationals derivative(const Rationals& f) {
  Rationals slope;
  for (std::size_t i = 1; i < f.size(); ++i) slope.push_back(static_cast<long>(i) * f[i]);
  return slope;
}

// A bound of |f| between two times: the largest of its Bernstein coefficients.
Rational bound(const Rationals& f, const Rational& a, const Rational& b) {
  const Rationals g = along(f, a, b);
  spend_on(g, 0);
  Rational most = 0;
  for (std::size_t j = 0; j < g.size(); ++j) {
    Rational sum = 0;
    for (std::size_t i = 0; i <= j; ++i) {
      Integer over, under;
      mpz_bin_uiui(over.get_mpz_t(), j, i);
      mpz_bin_uiui(under.get_mpz_t(), g.size() - 1, i);
      Rational part(over, under);
      part.canonicalize();
      sum += part * g[i];
    }
    most = std::max(most, Rational(abs(sum)));
  }
  return most;
}

long bit_length(const Integer& n) {
  return n == 0 ? 0 : static_cast<long>(mpz_sizeinbase(n.get_mpz_t(), 2));
}

// Bits after the binary point of a small part of an error, next to an angle.
long bits_for(const Rational& error, const Rational& angle) {
  const long small = 5 - bit_length(error.get_num()) + bit_length(error.get_den());
  return std::max(8L, small) + bit_length(floor(abs(angle)));
}

// Whether one turn, from a to b, is near a pose.
bool is_near(const Turn& turn, const Rational& a, const Rational& b, const Pose& pose,
             const PathRecord& record) {
  const Rational &error = record.error, &place_error = record.place_error;
  if (turn.pivot != record.pivot) return false;  // else the translations cannot be compared
  if (a == b && turn.half_turn.size() > 1) return false;
  if (a == b && record.does_rest && std::max(turn.x.size(), turn.y.size()) > 1) return false;
  const auto there = [&](const Rationals& f) {
    return along(f, Rational(a - pose.begin), Rational(b - pose.begin));
  };
  const Rational dx = bound(along(turn.x, a, b) - there(pose.x), 0, 1);
  const Rational dy = bound(along(turn.y, a, b) - there(pose.y), 0, 1);
  const Rationals h = along(turn.half_turn, a, b), theta = there(pose.angle);
  const Rational at = value(theta, Rational(0)), u = value(h, Rational(0));
  const long bits = bits_for(error, at) + 8;
  if (bits > most_bits + 8 || dx * dx + dy * dy > place_error * place_error) return false;
  const Rationals slope = derivative(h);
  const Rationals rate = slope + slope - derivative(theta) * (Rationals{1} + h * h);
  Rationals change{0};
  for (std::size_t i = 0; i < rate.size(); ++i)
    change.push_back(rate[i] / static_cast<long>(i + 1));
  trim(change);
  Rational most = 0;
  for (int i = 0; i < samples; ++i)
    most = std::max(most, bound(change, Rational(i) / samples, Rational(i + 1) / samples));
  const Rational unit = 1 + u * u, cosine = (1 - u * u) / unit, sine = 2 * u / unit;
  const auto& [c, s] = turn.orientation;
  const Bounds turned = angle(c * cosine - s * sine, c * sine + s * cosine, bits), half = pi(bits);
  const Integer k = floor((turned.first - at) / (2 * half.first) + Rational(1, 2));
  Rational left = 2 * half.first * k, right = 2 * half.second * k;
  if (left > right) std::swap(left, right);
  const Rational at_start = std::max(Rational(abs(turned.first - at - right)),
                                     Rational(abs(turned.second - at - left)));
  return at_start + most * (1 + 2 * bound(h, 0, 1) * bound(slope, 0, 1)) <= error;
}

// Whether pieces of a path, one upon the other, make no jump.
bool is_continuous(const Pose& before, const Pose& after) {
  const Rational t = before.end - before.begin, zero = 0;
  return value(before.x, t) == value(after.x, zero) && value(before.y, t) == value(after.y, zero) &&
         value(before.angle, t) == value(after.angle, zero);
}

}  // namespace

bool is_path(const std::vector<Rational>& until, const std::vector<Turn>& turns,
             const PathRecord& record) {
  const std::vector<Pose>& path = record.poses;
  if (record.error <= 0 || record.place_error < 0 || path.empty() || until.size() < 2) return false;
  if (until.front() != path.front().begin || until.back() != path.back().end) return false;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (path[i].begin >= path[i].end || (i > 0 && !is_continuous(path[i - 1], path[i])))
      return false;
  std::size_t k = 0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const Rational& a = until[i == 0 ? 0 : i - 1];
    const Rational& b = until[std::min(i, until.size() - 1)];
    while (k + 1 < path.size() && a >= path[k].end) ++k;
    if (b > path[k].end || !is_near(turns[i], a, b, path[k], record)) return false;
  }
  return true;
}

bool is_spin(const std::vector<Rational>& until, const std::vector<Turn>& turns,
             const Rational& omega, const Rational& error) {
  if (turns.size() < 3) return false;
  for (const Turn& turn : turns)
    if (turn.pivot != turns[0].pivot || turn.x != turns[0].x || turn.y != turns[0].y) return false;
  const Rational &begin = until.front(), &end = until.back();
  const auto since = [&](const Rationals& f) { return along(f, begin, Rational(begin + 1)); };
  Rationals angle{0, omega};
  trim(angle);
  const Pose pose{begin, end, since(turns[0].x), since(turns[0].y), since(angle)};
  return is_path(until, turns, {turns[0].pivot, {pose}, error, 0, false});
}

}  // namespace proof
