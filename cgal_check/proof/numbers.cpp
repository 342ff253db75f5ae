#include "numbers.hpp"

#include <cstdlib>
#include <utility>

#include <CGAL/mpq_class.h>

namespace proof {

namespace {

constexpr long highest_exponent = 100'000;
constexpr std::size_t most_bits = 33'220;  // of 10,000 digits

}  // namespace

Interval enclosure(const Rational& q) {
  const std::pair<double, double> ends = CGAL::to_interval(q);
  return Interval(ends.first, ends.second);
}

bool is_integer(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_fraction(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return is_integer(text);
  const std::string_view under = text.substr(slash + 1);
  return is_integer(text.substr(0, slash)) && is_integer(under) && under.front() != '-' &&
         under.find_first_not_of('0') != std::string_view::npos;
}

Rational fraction(std::string_view text) {
  Rational q(std::string(text), 10);
  q.canonicalize();
  return q;
}

std::size_t leading_digits(std::string_view text) {
  const std::size_t end = text.find_first_not_of("0123456789");
  return end == std::string_view::npos ? text.size() : end;
}

std::optional<Rational> decimal(std::string_view text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (negative || text.front() == '+')) text.remove_prefix(1);
  const std::size_t whole = leading_digits(text);
  std::string figures(text.substr(0, whole));
  text.remove_prefix(whole);
  long exponent = 0;
  if (!text.empty() && text.front() == '.') {
    const std::size_t part = leading_digits(text.substr(1));
    figures += text.substr(1, part);
    exponent = -static_cast<long>(part);
    text.remove_prefix(part + 1);
  }
  if (figures.empty()) return std::nullopt;
  if (!text.empty()) {
    if (text.front() != 'e' && text.front() != 'E') return std::nullopt;
    text.remove_prefix(1);
    const bool small = !text.empty() && text.front() == '-';
    if (!text.empty() && (small || text.front() == '+')) text.remove_prefix(1);
    if (text.empty() || text.size() > 18 || leading_digits(text) != text.size())
      return std::nullopt;
    const long written = std::stol(std::string(text));
    if (written > highest_exponent) return std::nullopt;
    exponent += small ? -written : written;
  }
  const Integer n(figures, 10);
  if (n == 0) return Rational(0);
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::labs(exponent)));
  Rational q = exponent < 0 ? Rational(n, power) : Rational(Integer(n * power));
  q.canonicalize();
  return negative ? Rational(-q) : q;
}

bool is_long(const Rational& q) {
  return mpz_sizeinbase(q.get_num_mpz_t(), 2) > most_bits ||
         mpz_sizeinbase(q.get_den_mpz_t(), 2) > most_bits;
}

}  // namespace proof
