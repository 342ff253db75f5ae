#include "scene.hpp"

#include <algorithm>
#include <unordered_map>

#include "faults.hpp"
#include "reading.hpp"
#include "simple.hpp"
#include "units.hpp"

namespace proof {

namespace {

// Whether the quotient of two polynomials is constant.
bool is_constant(const Poly<Integer>& f, const Poly<Integer>& g) {
  if (f.empty()) return true;
  if (f.size() != g.size()) return false;
  for (std::size_t i = 0; i < f.size(); ++i)
    if (f[i] * g.back() != g[i] * f.back()) return false;
  return true;
}

Poly<Integer> square(const Poly<Integer>& f) { return f * f; }

// Whether the squared length of ab, and the dot and cross products of ab and bc, are constant;
// without c, the first alone.
bool keeps_corner(const Path& a, const Path& b, const Path* c) {
  const Poly<Integer> weight = square(b.w);
  if (!is_constant(dot_product(a, b, a), square(a.w) * weight)) return false;
  return !c || (is_constant(dot_product(a, b, *c), a.w * c->w * weight) &&
                is_constant(orientation(a, b, *c), a.w * b.w * c->w));
}

// Whether ab is a constant vector, of polynomial paths.
bool keeps_vector(const Path& a, const Path& b) {
  return a.is_polynomial && b.is_polynomial && (a.x * b.w - b.x * a.w).size() <= 1 &&
         (a.y * b.w - b.y * a.w).size() <= 1;
}

bool is_rigid(const Body& body, const std::vector<Path>& paths) {
  const auto path = [&](int i) -> const Path& {
    return paths[static_cast<std::size_t>(i % body.size)];
  };
  bool is_translated = true;
  for (int i = 0; i < body.edges() && is_translated; ++i)
    is_translated = keeps_vector(path(i), path(i + 1));
  if (is_translated) return true;
  for (int i = 0; i < body.edges(); ++i) {
    const bool has_next = body.is_polygon || i + 2 < body.size;
    if (!keeps_corner(path(i), path(i + 1), has_next ? &path(i + 2) : nullptr)) return false;
  }
  return true;
}

bool is_rigid(const Body& body, const Rational& start, const Rational& end) {
  for (std::size_t i = 0; i < body.pieces.size(); ++i) {
    const bool is_over = i < body.breaks.size() && body.breaks[i] <= start;
    const bool is_later = i > 0 && body.breaks[i - 1] >= end;
    if (!is_over && !is_later && !is_rigid(body, body.pieces[i])) return false;
  }
  return true;
}

int sign_of_area(const std::vector<Place>& polygon) {
  Rational sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place& p = polygon[i];
    const Place& q = polygon[(i + 1) % polygon.size()];
    sum += p.first * q.second - p.second * q.first;
  }
  return sign(sum);
}

}  // namespace

std::vector<Polygon> polygons(const Body& body, const Rational& t) {
  std::vector<Polygon> result;
  const std::vector<Path>& paths = body.pieces[Scene::piece(body, Time(t))];
  for (const Ring& ring : body.rings) {
    result.emplace_back();
    for (int v = ring.first; v < ring.first + ring.size; ++v)
      result.back().push_back(place(paths[static_cast<std::size_t>(v - body.first)], t));
  }
  return result;
}

const Ring& Body::ring(int v) const {
  const auto after = std::upper_bound(rings.begin(), rings.end(), v,
                                      [](int u, const Ring& ring) { return u < ring.first; });
  return *(after - 1);
}

int Body::around(int v, int step) const {
  const Ring& r = ring(v);
  return r.first + (v - r.first + step + r.size) % r.size;
}

Place place(const Path& path, const Rational& t) {
  const auto at = [&](const Poly<Integer>& f) {
    const double n = static_cast<double>(f.size());
    const double most = n * static_cast<double>(mpz_size(t.get_num_mpz_t()) + mpz_size(t.get_den_mpz_t())) +
                        (f.empty() ? 0 : static_cast<double>(mpz_size(longest(f)->get_mpz_t())));
    spend(n * (100 + most * most / 4));
    Rational sum = 0;
    for (std::size_t i = f.size(); i-- > 0;) sum = sum * t + Rational(f[i]);
    return sum;
  };
  const Rational w = at(path.w);
  return {at(path.x) / w, at(path.y) / w};
}

namespace {

// Counts the products of an orientation, or of a dot product.
void spend_on(const Path& a, const Path& b, const Path& c) {
  double terms = 1, words = 1;
  for (const Path* path : {&a, &b, &c})
    for (const Poly<Integer>* f : {&path->x, &path->y, &path->w}) {
      if (f->empty()) continue;
      terms = std::max(terms, static_cast<double>(f->size()));
      words = std::max(words, static_cast<double>(mpz_size(longest(*f)->get_mpz_t())));
    }
  spend(24 * terms * terms * (8 + words * words));
}

}  // namespace

Poly<Integer> orientation(const Path& a, const Path& b, const Path& c) {
  spend_on(a, b, c);
  return a.w * (b.x * c.y - b.y * c.x) - b.w * (a.x * c.y - a.y * c.x) +
         c.w * (a.x * b.y - a.y * b.x);
}

Poly<Integer> dot_product(const Path& a, const Path& v, const Path& b) {
  spend_on(a, v, b);
  return (a.x * v.w - v.x * a.w) * (b.x * v.w - v.x * b.w) +
         (a.y * v.w - v.y * a.w) * (b.y * v.w - v.y * b.w);
}

Scene::Scene(const std::string& text, bool are_records_verified) {
  const Json json = parse_json(text);
  allow_keys(json, {"exactpt", "time", "bodies", "ignoring", "units", "epoch"});
  const Json* version = json.find("exactpt");
  const Json* time = json.find("time");
  const Json* bodies = json.find("bodies");
  if (!version || !time || !bodies) throw NoProof("the scene lacks a key");
  if (version->kind != Json::Kind::number || version->text != "1")
    throw NoProof("the scene is of another version");
  if (list(time).size() != 2) throw NoProof("the scene has no time span");
  start_ = exact_number(&time->items[0]);
  end_ = exact_number(&time->items[1]);
  if (start_ >= end_) throw NoProof("the scene has an empty time span");
  std::unordered_map<std::string, int> number_of;
  for (const Json& body : list(bodies)) {
    bodies_.push_back(read_body(body, size(), start_, are_records_verified));
    const int number = static_cast<int>(bodies_.size()) - 1;
    if (!number_of.emplace(bodies_.back().name, number).second)
      throw NoProof("the scene has a name twice");
    body_of_.resize(body_of_.size() + static_cast<std::size_t>(bodies_.back().size), number);
  }
  const Json* ignoring = json.find("ignoring");
  groups_ = ignoring ? Groups(*ignoring, number_of) : Groups(bodies_.size());
  check_units(json.find("units"), json.find("epoch"));
}

bool Scene::is_modelled() const {
  return std::any_of(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.is_modelled; });
}

void Scene::examine(const Rational& end) {
  for (Body& body : bodies_) {
    body.is_rigid = proof::is_rigid(body, start_, end);
    if (!body.is_polygon) continue;
    const std::vector<Polygon> all = polygons(body, start_);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const int area = sign_of_area(all[i]);
      if (area == 0) throw Rejected("the body " + body.name + " has no area at the start");
      body.rings[i].has_body_on_left = (area > 0) != body.rings[i].is_hole;
    }
  }
}

bool Scene::is_body_edge(int u, int v) const {
  if (body_of(u) != body_of(v)) return false;
  if (body(u).rings.size() > 1) return body(u).next(u) == v || body(u).next(v) == u;
  const int apart = std::abs(u - v);
  return apart == 1 || (body(u).is_polygon && apart == body(u).size - 1);
}

bool Scene::are_rigid(int u, int v, int w) const {
  return body_of(u) == body_of(v) && body_of(v) == body_of(w) && body(v).is_rigid;
}

std::string Scene::in_short(int v) const {
  return "b" + std::to_string(body_of(v)) + "." + std::to_string(v - body(v).first);
}

int Scene::first_of_edge(int u, int v) const {
  const bool is_last = !body(u).is_polygon && u == body(u).first + body(u).size - 1;
  return !is_last && body(u).next(u) == v ? u : v;
}

int Scene::after(int v, int step) const {
  return body(v).around(v, body(v).ring(v).has_body_on_left ? step : -step);
}

std::size_t Scene::piece(const Body& body, const Time& t) {
  const auto is_over = [&](const Rational& at) { return t.compare(at) >= 0; };
  const auto found = std::partition_point(body.breaks.begin(), body.breaks.end(), is_over);
  return static_cast<std::size_t>(found - body.breaks.begin());
}

const Path& Scene::path(int v, std::size_t piece) const {
  const Body& b = body(v);
  return b.pieces[piece][static_cast<std::size_t>(v - b.first)];
}

}  // namespace proof
