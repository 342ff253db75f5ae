#include "predicates.hpp"

#include <cmath>
#include <limits>

namespace proof {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

int exact_orientation(const Place& a, const Place& b, const Place& c) {
  return sign(Rational((b.first - a.first) * (c.second - a.second) -
                       (b.second - a.second) * (c.first - a.first)));
}

int exact_dot_product(const Place& a, const Place& v, const Place& b) {
  return sign(Rational((a.first - v.first) * (b.first - v.first) +
                       (a.second - v.second) * (b.second - v.second)));
}

}  // namespace

const Predicates::Box& Predicates::box(int v, const Time& t) {
  Box& box = boxes_[static_cast<std::size_t>(v)];
  if (box.time != t.number()) {
    const Path& path = scene_.path(v, t);
    const Rounding rounding;
    box.time = t.number();
    box.x = value(path.near_x, t.interval());
    box.y = value(path.near_y, t.interval());
    if (!path.is_polynomial) {
      const Interval w = value(path.near_w, t.interval());
      box.x /= w;
      box.y /= w;
    }
    for (Interval* i : {&box.x, &box.y})
      if (!std::isfinite(i->inf()) || !std::isfinite(i->sup())) *i = Interval(-infinite, infinite);
  }
  return box;
}

int Predicates::orientation(int a, int b, int c, const Time& t) {
  const Box &p = box(a, t), &q = box(b, t), &r = box(c, t);
  {
    const Rounding rounding;
    const int sign = certain_sign((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
    if (sign != 0) return sign;
  }
  const Path &f = scene_.path(a, t), &g = scene_.path(b, t), &h = scene_.path(c, t);
  if (!t.is_rational()) return t.sign_of(proof::orientation(f, g, h));
  return exact_orientation(place(f, t.low()), place(g, t.low()), place(h, t.low()));
}

int Predicates::dot_product(int a, int v, int b, const Time& t) {
  const Box &p = box(a, t), &q = box(v, t), &r = box(b, t);
  {
    const Rounding rounding;
    const int sign = certain_sign((p.x - q.x) * (r.x - q.x) + (p.y - q.y) * (r.y - q.y));
    if (sign != 0) return sign;
  }
  const Path &f = scene_.path(a, t), &g = scene_.path(v, t), &h = scene_.path(b, t);
  if (!t.is_rational()) return t.sign_of(proof::dot_product(f, g, h));
  return exact_dot_product(place(f, t.low()), place(g, t.low()), place(h, t.low()));
}

int Predicates::difference_of_x(int a, int b, const Time& t) {
  const Box &p = box(a, t), &q = box(b, t);
  {
    const Rounding rounding;
    const int sign = certain_sign(q.x - p.x);
    if (sign != 0) return sign;
  }
  const Path &f = scene_.path(a, t), &g = scene_.path(b, t);
  return t.sign_of(g.x * f.w - f.x * g.w);
}

int Predicates::difference_of_y(int a, int b, const Time& t) {
  const Box &p = box(a, t), &q = box(b, t);
  {
    const Rounding rounding;
    const int sign = certain_sign(q.y - p.y);
    if (sign != 0) return sign;
  }
  const Path &f = scene_.path(a, t), &g = scene_.path(b, t);
  return t.sign_of(g.y * f.w - f.y * g.w);
}

bool Predicates::coincide(int a, int b, const Time& t) {
  return difference_of_x(a, b, t) == 0 && difference_of_y(a, b, t) == 0;
}

bool Predicates::is_on(int v, int a, int b, const Time& t) {
  return orientation(a, b, v, t) == 0 && dot_product(a, v, b, t) <= 0;
}

bool Predicates::is_flat(int a, int b, int c, const Time& t) {
  return proof::orientation(scene_.path(a, t), scene_.path(b, t), scene_.path(c, t)).empty();
}

}  // namespace proof
