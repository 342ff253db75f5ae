#include "numbers.hpp"

#include <utility>

#include <CGAL/mpq_class.h>

namespace proof {

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

}  // namespace proof
