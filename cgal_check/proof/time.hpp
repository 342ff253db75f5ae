// Times: rationals, and roots of integer polynomials.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "polynomial.hpp"
#include "roots.hpp"

namespace proof {

class Time {
 public:
  explicit Time(const Rational& t);

  // The only real root of f, not 0, in [low, high]; nothing if Descartes' rule does not show
  // that there is exactly one: of f, or of its square-free part in halves of halves, 64 deep.
  static std::optional<Time> root(const Poly<Integer>& f, const Rational& low,
                                  const Rational& high);

  bool is_rational() const { return low_ == high_; }
  const Rational& low() const { return low_; }
  const Rational& high() const { return high_; }
  const Interval& interval() const { return interval_; }
  long number() const { return number_; }  // another one for every time

  int compare(const Rational& q) const;

  // A rational between two times, which are refined; nothing unless the second one is later,
  // and a number start + m unit lies between them.
  static std::optional<Rational> sample(Time& from, Time& to, const Rational& start,
                                        const Rational& unit);

  int sign_of(const Poly<Integer>& g) const;

  // As far as g is divided by what vanishes here for a reason that is known, and as the
  // interval up to here (`before`) or from here on can be shortened, so that g still has the
  // same zeros in its inside: the new end.
  Rational end_for(Poly<Integer>& g, bool before) const;

  const Root* real() const;  // null if rational
  std::string in_words() const;
  std::string twelve_digits() const;  // the rest cut off

 private:
  Time(Poly<Integer> f, const Rational& low, const Rational& high);
  void sharpen();
  void halve();
  bool is_same(const Time& other) const;
  bool narrow(const Poly<Integer>& f, const Integer& left, const Integer& right, int bits);
  void set_interval();
  Rational first_after(const Rational& start, const Rational& unit) const;

  Rational low_, high_;
  Poly<Integer> f_;    // primitive; with one simple root in [low, high], not at the ends
  int low_sign_ = 0;   // that of f_ at low_
  Interval interval_;  // contains [low_, high_]
  long number_;
  mutable std::shared_ptr<const Root> real_;
};

// A rational with a small denominator, a power of two, in the open interval.
Rational rational_between(const Rational& low, const Rational& high);

}  // namespace proof
