// Whether an angle keeps its kind throughout its life: no polynomial that tells has a zero.
#include <algorithm>
#include <cmath>
#include <functional>

#include "predicates.hpp"

namespace proof {

namespace {

// How often an interval is halved before exact arithmetic, and before CGAL's roots.
constexpr int halvings = 6;

// An end of a piece of a life: a time that is not in it, or a breakpoint, which is.
struct End {
  const Time* time;  // or null
  Rational at;       // a breakpoint

  Interval interval() const { return time ? time->interval() : enclosure(at); }
};

using Near = Poly<Interval>;

// The coefficients of a polynomial on an interval, as `between` gives them.
using Coefficients = std::function<Near(double low, double high)>;

bool certainly_has_sign(const Coefficients& coefficients, int sign, double low, double high,
                        int depth) {
  const Near all = coefficients(low, high);
  if (certain_sign(all.front()) != sign || certain_sign(all.back()) != sign) return false;
  const auto has_sign = [&](const Interval& c) { return certain_sign(c) == sign; };
  if (std::all_of(all.begin(), all.end(), has_sign)) return true;
  const double middle = low + (high - low) / 2;
  return depth > 0 && low < middle && middle < high &&
         certainly_has_sign(coefficients, sign, low, middle, depth - 1) &&
         certainly_has_sign(coefficients, sign, middle, high, depth - 1);
}

std::size_t degree(const Near& f, const Near& g) {
  return std::max<std::size_t>({f.size(), g.size(), 1}) - 1;
}

// f g - h k on an interval, or f g + h k.
Coefficients combination(Near f, Near g, Near h, Near k, bool is_sum) {
  const std::size_t n = degree(f, h), m = degree(g, k);
  return [=](double low, double high) {
    const Interval a(low), b(high), one(1);
    const Near p = between(f, a, b, one, n) * between(g, a, b, one, m);
    const Near q = between(h, a, b, one, n) * between(k, a, b, one, m);
    return is_sum ? p + q : p - q;
  };
}

// Rational paths: with all three degrees raised to that of the highest.
struct Restricted {
  Near x, y, w;

  Restricted(const Path& path, double low, double high, std::size_t n) {
    const Interval a(low), b(high), one(1);
    x = between(path.near_x, a, b, one, n);
    y = between(path.near_y, a, b, one, n);
    w = between(path.near_w, a, b, one, n);
  }
};

std::size_t degree(const Path& path) {
  return std::max({path.near_x.size(), path.near_y.size(), path.near_w.size()}) - 1;
}

Coefficients near_orientation(const Path& p, const Path& q, const Path& r) {
  const Rounding rounding;
  if (p.is_polynomial && q.is_polynomial && r.is_polynomial)
    return combination(p.near_x - q.near_x, r.near_y - q.near_y, p.near_y - q.near_y,
                       r.near_x - q.near_x, false);
  return [&](double low, double high) {
    const Restricted a(p, low, high, degree(p)), b(q, low, high, degree(q)),
        c(r, low, high, degree(r));
    return a.w * (b.x * c.y - b.y * c.x) - b.w * (a.x * c.y - a.y * c.x) +
           c.w * (a.x * b.y - a.y * b.x);
  };
}

// Of polynomial paths; others are left to exact arithmetic.
Coefficients near_dot_product(const Path& p, const Path& q, const Path& r) {
  const Rounding rounding;
  return combination(p.near_x - q.near_x, r.near_x - q.near_x, p.near_y - q.near_y,
                     r.near_y - q.near_y, true);
}

bool is_certain(const Coefficients& coefficients, int sign, const End& from, const End& to) {
  const double low = from.interval().inf(), high = to.interval().sup();
  const Rounding rounding;
  return std::isfinite(low) && std::isfinite(high) && low < high &&
         certainly_has_sign(coefficients, sign, low, high, halvings);
}

bool has_no_root(const Poly<Integer>& f, const Rational& low, const Rational& high, int depth) {
  const Poly<Integer> signs = between(f, low, high);
  if (sign(signs.front()) == 0 || sign(signs.back()) == 0) return false;
  if (variations(signs) == 0) return true;
  if (variations(signs) % 2 == 1 || depth == 0) return false;
  const Rational middle = (low + high) / 2;
  return has_no_root(f, low, middle, depth - 1) && has_no_root(f, middle, high, depth - 1);
}

// Whether f, not 0, has no zero between two ends, breakpoints included.
bool has_no_zero(const Poly<Integer>& polynomial, const End& from, const End& to) {
  Poly<Integer> f = primitive(polynomial);
  const Rational low = from.time ? from.time->end_for(f, false) : from.at;
  const Rational high = to.time ? to.time->end_for(f, true) : to.at;
  if (has_no_root(f, low, high, halvings)) return true;
  return !has_root(f, low, high, from.time ? from.time->real() : nullptr,
                   to.time ? to.time->real() : nullptr);
}

bool keeps_in_piece(const Path& p, const Path& q, const Path& r, Kind kind, const End& from,
                    const End& to) {
  if (kind == Kind::convex || kind == Kind::reflex) {
    const int sign = kind == Kind::convex ? 1 : -1;
    if (is_certain(near_orientation(p, q, r), sign, from, to)) return true;
    const Poly<Integer> f = orientation(p, q, r);
    return !f.empty() && has_no_zero(f, from, to);
  }
  if (!orientation(p, q, r).empty()) return false;
  const bool is_polynomial = p.is_polynomial && q.is_polynomial && r.is_polynomial;
  const int sign = kind == Kind::flat ? -1 : 1;
  if (is_polynomial && is_certain(near_dot_product(p, q, r), sign, from, to)) return true;
  const Poly<Integer> f = dot_product(p, q, r);
  return !f.empty() && has_no_zero(f, from, to);
}

// The breakpoints of three vertices between two times, in order.
std::vector<Rational> breaks(const Scene& scene, int u, int v, int w, const Time& since,
                             const Time& until) {
  std::vector<Rational> found;
  for (const int vertex : {u, v, w}) {
    const std::vector<Rational>& all = scene.body(vertex).breaks;
    for (auto t = std::upper_bound(all.begin(), all.end(), since.low()); t != all.end(); ++t) {
      if (until.compare(*t) <= 0) break;
      if (since.compare(*t) < 0) found.push_back(*t);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

bool keeps_kind(const Scene& scene, int u, int v, int w, Kind kind, const Time& since,
                const Time& until) {
  if (scene.are_rigid(u, v, w)) return true;
  const std::vector<Rational> cuts = breaks(scene, u, v, w, since, until);
  for (std::size_t i = 0; i <= cuts.size(); ++i) {
    const End from = i == 0 ? End{&since, 0} : End{nullptr, cuts[i - 1]};
    const End to = i == cuts.size() ? End{&until, 0} : End{nullptr, cuts[i]};
    const auto path = [&](int vertex) -> const Path& {
      return from.time ? scene.path(vertex, since) : scene.path(vertex, Time(from.at));
    };
    if (!keeps_in_piece(path(u), path(v), path(w), kind, from, to)) return false;
  }
  return true;
}

}  // namespace proof
