#include "time.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace proof {

namespace {

constexpr int most_halvings = 64;

long next_number = 0;

// Numbers in proportion to these, at most 1 in size; only to steer by.
std::vector<double> doubles(const Poly<Integer>& f) {
  long most = 0;
  std::vector<std::pair<double, long>> parts;
  for (const Integer& c : f) {
    long exponent = 0;
    const double part = mpz_get_d_2exp(&exponent, c.get_mpz_t());
    parts.emplace_back(part, exponent);
    most = std::max(most, exponent);
  }
  std::vector<double> result;
  for (const auto& [part, exponent] : parts)
    result.push_back(std::ldexp(part, static_cast<int>(std::max(exponent - most, -2000L))));
  return result;
}

double bisected(const std::vector<double>& f) {
  double low = 0, high = 1;
  const bool rises = value(f, 0.0) < value(f, 1.0);
  for (int i = 0; i < 52; ++i) {
    const double middle = (low + high) / 2;
    ((value(f, middle) < 0) == rises ? low : high) = middle;
  }
  return low;
}

// f(low + (high - low) u), times a positive number, as a polynomial in u.
Poly<Integer> in_unit_interval(const Poly<Integer>& f, const Rational& low, const Rational& high) {
  const Rational width = high - low;
  const Poly<Rational> line{low, width};
  Poly<Rational> result;
  for (std::size_t i = f.size(); i-- > 0;) result = result * line + Poly<Rational>{Rational(f[i])};
  return integral(result);
}

}  // namespace

Time::Time(const Rational& t) : low_(t), high_(t), number_(next_number++) { set_interval(); }

Time::Time(Poly<Integer> f, const Rational& low, const Rational& high)
    : low_(low),
      high_(high),
      f_(std::move(f)),
      low_sign_(sign_at(f_, low)),
      number_(next_number++) {
  sharpen();
  set_interval();
}

std::optional<Time> Time::root(const Poly<Integer>& f, const Rational& low, const Rational& high) {
  if (low == high) return sign_at(f, low) == 0 ? std::optional(Time(low)) : std::nullopt;
  Poly<Integer> g = primitive(f);
  Poly<Integer> signs = between(g, low, high);
  const auto is_clear = [&] { return sign(signs.front()) != 0 && sign(signs.back()) != 0; };
  if (!is_clear() || variations(signs) != 1) {  // a single variation is a single simple root
    g = square_free(g);
    const auto found = isolated(g, low, high, most_halvings);
    if (!found || found->size() != 1) return std::nullopt;
    const auto& [from, to] = found->front();
    return from == to ? Time(from) : Time(g, from, to);
  }
  return Time(g, low, high);
}

void Time::set_interval() {
  const Interval low = enclosure(low_);
  interval_ = is_rational() ? low : Interval(low.inf(), enclosure(high_).sup());
}

void Time::sharpen() {
  const Poly<Integer> f = in_unit_interval(f_, low_, high_);
  constexpr int bits = 50;
  const Integer guess(std::floor(std::ldexp(bisected(doubles(f)), bits)));
  for (const long wide : {4L, 4096L, 1L << 22})
    if (narrow(f, guess - wide, guess + wide, bits)) return;
  for (int i = 0; i < bits && !is_rational(); ++i) halve();
}

// Takes [left, right] / 2^bits of the interval, if the root is certainly in it; f is f_ in the
// unit interval.
bool Time::narrow(const Poly<Integer>& f, const Integer& left, const Integer& right, int bits) {
  const Integer unit = Integer(1) << bits;
  Rational from(std::max(left, Integer(0)), unit), to(std::min(right, unit), unit);
  from.canonicalize();
  to.canonicalize();
  const int first = from == 0 ? low_sign_ : sign_at(f, from);
  const int last = to == 1 ? -low_sign_ : sign_at(f, to);
  if (first * last > 0 || first == -low_sign_ || last == low_sign_) return false;
  const Rational low = low_, width = high_ - low_;
  if (to != 1 || first == 0) high_ = low + width * (first == 0 ? from : to);
  if (from != 0 || last == 0) low_ = low + width * (last == 0 ? to : from);
  return true;
}

void Time::halve() {
  const Rational middle = (low_ + high_) / 2;
  const int found = sign_at(f_, middle);
  if (found == 0) {
    low_ = high_ = middle;
  } else {
    (found == low_sign_ ? low_ : high_) = middle;
  }
}

int Time::compare(const Rational& q) const {
  if (is_rational()) return cmp(low_, q);
  if (q <= low_) return 1;
  if (q >= high_) return -1;
  const int found = sign_at(f_, q);
  return found == 0 ? 0 : found == low_sign_ ? 1 : -1;
}

// The first start + m unit that is more than t, whose interval is shorter than half a unit.
Rational Time::first_after(const Rational& start, const Rational& unit) const {
  const Rational ratio = (low_ - start) / unit;
  Integer m;
  mpz_fdiv_q(m.get_mpz_t(), ratio.get_num_mpz_t(), ratio.get_den_mpz_t());
  const Rational q = start + Rational(Integer(m + 1)) * unit;
  return compare(q) >= 0 ? Rational(q + unit) : q;
}

// Whether two times, which are roots, are one: then both polynomials vanish there.
bool Time::is_same(const Time& other) const {
  if (is_rational() || other.is_rational()) return false;
  const Rational low = std::max(low_, other.low_), high = std::min(high_, other.high_);
  const Poly<Integer> both = common_divisor(f_, other.f_);
  return low < high && sign_at(both, low) * sign_at(both, high) < 0;
}

std::optional<Rational> Time::sample(Time& from, Time& to, const Rational& start,
                                     const Rational& unit) {
  Rational near = unit;  // times that are nearer may be one
  mpq_mul_2exp(near.get_mpq_t(), near.get_mpq_t(), 1984);
  while (to.low_ - from.high_ < unit) {
    if (to.high_ <= from.low_) return std::nullopt;
    if (from.high_ - from.low_ < near && to.high_ - to.low_ < near) {
      near = 0;
      if (from.is_same(to)) return std::nullopt;
    }
    if ((from.high_ - from.low_) * 2 < unit && (to.high_ - to.low_) * 2 < unit) {
      const Rational q = from.first_after(start, unit);
      return to.compare(q) > 0 ? std::optional(q) : std::nullopt;
    }
    for (Time* time : {&from, &to})
      if (!time->is_rational()) time->halve();
  }
  from.set_interval();
  to.set_interval();
  return rational_between(from.high_, to.low_);
}

std::string Time::twelve_digits() const {
  const int side = compare(Rational(0));
  if (side == 0) return "0";
  Time t = *this;
  while (sign(t.low_) * sign(t.high_) <= 0 || abs(t.high_ - t.low_) * 10'000'000'000'000 > abs(t.low_))
    t.halve();
  const Rational size = abs(t.low_);
  const auto power = [](long k) {
    Integer p;
    mpz_ui_pow_ui(p.get_mpz_t(), 10, static_cast<unsigned long>(std::labs(k)));
    return k < 0 ? Rational(1, p) : Rational(p);
  };
  const auto reaches = [&](const Rational& q) { return t.compare(side * q) * side >= 0; };
  const long bits = static_cast<long>(mpz_sizeinbase(size.get_num_mpz_t(), 2)) -
                    static_cast<long>(mpz_sizeinbase(size.get_den_mpz_t(), 2));
  long k = bits * 30103 / 100000 - 3;
  while (reaches(power(k + 1))) ++k;
  const Rational unit = power(k - 11), ratio = size / unit;
  Integer n;
  mpz_fdiv_q(n.get_mpz_t(), ratio.get_num_mpz_t(), ratio.get_den_mpz_t());
  while (!reaches(Rational(n) * unit)) --n;
  while (reaches(Rational(Integer(n + 1)) * unit)) ++n;
  std::string digits = n.get_str(), end;
  if (k < 0 && k >= -5) {
    digits = "0." + std::string(static_cast<std::size_t>(-k - 1), '0') + digits;
  } else {
    const bool is_plain = k >= 0 && k < 11;
    digits.insert(is_plain ? static_cast<std::size_t>(k) + 1 : 1, ".");
    if (!is_plain) end = "e" + std::to_string(k);
  }
  return (side < 0 ? "-" : "") + digits + end;
}

int Time::sign_of(const Poly<Integer>& g) const {
  if (g.empty()) return 0;
  if (is_rational()) return sign_at(g, low_);
  const Poly<Integer> h = primitive(g);
  if (h == f_) return 0;
  const Poly<Integer> signs = between(h, low_, high_);
  if (sign(signs.front()) != 0 && sign(signs.back()) != 0 && variations(signs) == 0)
    return opposite(sign(signs.front()), sign(g.back()) < 0);
  return real()->sign_of(g);
}

Rational Time::end_for(Poly<Integer>& g, bool before) const {
  if (is_rational()) {
    g = without_root(std::move(g), low_);
    return low_;
  }
  // A polynomial that is f has no root here but this one.
  if (g == f_) return before ? low_ : high_;
  return before ? high_ : low_;
}

const Root* Time::real() const {
  if (is_rational()) return nullptr;
  if (!real_) real_ = std::make_shared<Root>(square_free(f_), low_, high_);
  return real_.get();
}

std::string Time::in_words() const {
  return is_rational() ? low_.get_str() : twelve_digits() + "...";
}

Rational rational_between(const Rational& low, const Rational& high) {
  // m / 2^k with the least k, by doubling from a unit of the size of the interval.
  const Rational width = high - low;
  const long size = static_cast<long>(mpz_sizeinbase(width.get_den_mpz_t(), 2)) -
                    static_cast<long>(mpz_sizeinbase(width.get_num_mpz_t(), 2));
  for (long k = size - 2;; ++k) {
    Rational unit(1);
    if (k >= 0)
      mpq_div_2exp(unit.get_mpq_t(), unit.get_mpq_t(), static_cast<mp_bitcnt_t>(k));
    else
      mpq_mul_2exp(unit.get_mpq_t(), unit.get_mpq_t(), static_cast<mp_bitcnt_t>(-k));
    const Rational ratio = low / unit;
    Integer m;
    mpz_fdiv_q(m.get_mpz_t(), ratio.get_num_mpz_t(), ratio.get_den_mpz_t());
    const Rational found = unit * Rational(Integer(m + 1));
    if (found < high) return found;
  }
}

}  // namespace proof
