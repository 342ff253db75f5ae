// Exact numbers, and the intervals of doubles of the filter.
#pragma once

#include <gmpxx.h>

#include <optional>
#include <string>
#include <string_view>

#include <CGAL/Interval_nt.h>

namespace proof {

using Integer = mpz_class;
using Rational = mpq_class;
using Interval = CGAL::Interval_nt<false>;

// Directed rounding for intervals, as long as it lives.
using Rounding = CGAL::Protect_FPU_rounding<true>;

// The tightest interval of doubles; infinite where there is none.
Interval enclosure(const Rational& q);

// "p" or "p/q", with q > 0.
bool is_fraction(std::string_view text);
bool is_integer(std::string_view text);
Rational fraction(std::string_view text);  // of a text that is one

// The length of the digits at the front.
std::size_t leading_digits(std::string_view text);

// "1.25", "-3e-2"; nothing if it is not, or the exponent is huge.
std::optional<Rational> decimal(std::string_view text);

// Whether the numerator or the denominator has more than 10,000 digits.
bool is_long(const Rational& q);

inline int sign(const Integer& n) { return mpz_sgn(n.get_mpz_t()); }
inline int sign(const Rational& q) { return mpq_sgn(q.get_mpq_t()); }
inline int opposite(int sign, bool turned) { return turned ? -sign : sign; }

// The sign of all numbers of an interval, or 0 if it is not certain.
inline int certain_sign(const Interval& i) { return i.inf() > 0 ? 1 : i.sup() < 0 ? -1 : 0; }

}  // namespace proof
