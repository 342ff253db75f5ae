#include "reading.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "faults.hpp"
#include "simple.hpp"
#include "spin.hpp"

namespace proof {

namespace {

using Rationals = Poly<Rational>;
using Position = std::pair<Rationals, Rationals>;

constexpr std::size_t most_digits = 10'000;
constexpr std::size_t most_degree = 64;  // of a homogeneous coordinate of a vertex

Rationals polynomial(const Json* json) {
  if (!json) return {};
  Rationals f;
  for (const Json& c : list(json)) f.push_back(exact_number(&c));
  trim(f);
  return f;
}

Rationals constant(const Rational& c) {
  Rationals f{c};
  trim(f);
  return f;
}

Rationals linear(const Rational& from, const Rational& to, const Rational& a, const Rational& b) {
  const Rational slope = (b - a) / (to - from);
  Rationals f{a - slope * from, slope};
  trim(f);
  return f;
}

Path make_path(const Rationals& x, const Rationals& y, const Rationals& w) {
  Integer denominator = 1;
  for (const Rationals* f : {&x, &y, &w})
    for (const Rational& c : *f) denominator = lcm(denominator, c.get_den());
  Path path;
  const auto scaled = [&](const Rationals& f) {
    Poly<Integer> result;
    for (const Rational& c : f) result.push_back(c.get_num() * (denominator / c.get_den()));
    return result;
  };
  path.x = scaled(x), path.y = scaled(y), path.w = scaled(w);
  path.is_polynomial = w.size() == 1;
  const Rational unit = w.front();  // positive: w = 1, or 1 + h^2
  const auto near = [&](const Rationals& f) {
    Poly<Interval> result;
    for (const Rational& c : f) result.push_back(enclosure(Rational(c / unit)));
    return result;
  };
  path.near_x = near(x), path.near_y = near(y), path.near_w = near(w);
  return path;
}

std::size_t degree(const Rationals& f) { return std::max<std::size_t>(f.size(), 1) - 1; }

void check_degree(std::size_t degree) {
  if (degree > most_degree) throw NoProof("the scene has a coordinate of a degree above 64");
}

// The value at a time; counts as many products as its numbers get long.
Rational value_at(const Rationals& f, const Rational& t) {
  const auto words = [](const Rational& q) {
    return static_cast<double>(mpz_size(q.get_num_mpz_t()) + mpz_size(q.get_den_mpz_t()));
  };
  const double n = static_cast<double>(f.size());
  double most = n * words(t);
  for (const Rational& c : f) most = std::max(most, n * words(t) + words(c));
  spend(n * (100 + most * most / 4));
  return value(f, t);
}

// A motion by one formula: of a rest position, the path.
struct Motion {
  Rationals a, b, c, d;  // the matrix
  Rationals x, y;        // added then
  Rationals w;           // all is divided by it
  std::optional<Turn> turn;

  Path path(const Position& p) const {
    return make_path(a * p.first + b * p.second + x, c * p.first + d * p.second + y, w);
  }

  // The map at a time: a, b, c, d, x, y divided by w.
  std::vector<Rational> at(const Rational& t) const {
    std::vector<Rational> values;
    const Rational unit = value_at(w, t);
    for (const Rationals* f : {&a, &b, &c, &d, &x, &y}) values.push_back(value_at(*f, t) / unit);
    return values;
  }
};

Place moved(const std::vector<Rational>& map, const Place& p) {
  return {map[0] * p.first + map[1] * p.second + map[4],
          map[2] * p.first + map[3] * p.second + map[5]};
}

Motion translation(const Json* json, std::size_t shape) {
  const Rationals one = constant(1);
  check_degree(shape);
  if (!json) return {one, {}, {}, one, {}, {}, one, {}};
  allow_keys(*json, {"x", "y"});
  const Rationals x = polynomial(json->find("x")), y = polynomial(json->find("y"));
  check_degree(std::max(degree(x), degree(y)));
  return {one, {}, {}, one, x, y, one, {}};
}

// Two constants: a pivot, or an orientation.
Place pair(const Json* json, int x, int y) {
  if (!json) return {x, y};
  const std::vector<Json>& both = list(json);
  if (both.size() != 2) throw NoProof("the scene has a rotation with a pair that is none");
  return {exact_number(&both[0]), exact_number(&both[1])};
}

Motion rotation(const Json& json, std::size_t shape) {
  allow_keys(json, {"pivot", "half_turn", "x", "y", "orientation"});
  const Place pivot = pair(json.find("pivot"), 0, 0), o = pair(json.find("orientation"), 1, 0);
  const Rationals h = polynomial(member(json, "half_turn")), one = constant(1);
  const Rationals x = polynomial(json.find("x")), y = polynomial(json.find("y"));
  check_degree(2 * degree(h) + std::max({shape, degree(x), degree(y)}));
  const Rationals px = constant(pivot.first), py = constant(pivot.second);
  const Rationals c = constant(o.first), s = constant(o.second);
  if (c * c + s * s != one) throw NoProof("the scene has an orientation that is no unit vector");
  const Rationals w = one + h * h, cos_h = one - h * h, sin_h = h + h;
  const Rationals cosine = cos_h * c - sin_h * s, sine = sin_h * c + cos_h * s;
  const Rationals zero;
  return {cosine, zero - sine, sine, cosine,
          w * (px + x) - cosine * px + sine * py, w * (py + y) - sine * px - cosine * py, w,
          Turn{h, o, {pivot.first, pivot.second}, x, y}};
}

Motion affine(const Json& json, std::size_t shape) {
  allow_keys(json, {"matrix", "x", "y"});
  std::vector<Rationals> entries;
  std::size_t highest = 0;
  const std::vector<Json>& rows = list(member(json, "matrix"));
  for (const Json& row : rows) {
    if (list(&row).size() != 2) throw NoProof("the scene has a matrix that is not 2 by 2");
    for (const Json& entry : list(&row)) {
      entries.push_back(polynomial(&entry));
      highest = std::max(highest, degree(entries.back()));
    }
  }
  if (rows.size() != 2) throw NoProof("the scene has a matrix that is not 2 by 2");
  const Rationals x = polynomial(json.find("x")), y = polynomial(json.find("y"));
  check_degree(std::max({shape + highest, degree(x), degree(y)}));
  return {entries[0], entries[1], entries[2], entries[3], x, y, constant(1), {}};
}

Motion simple_motion(const Json* json, std::size_t shape) {
  if (json && json->kind == Json::Kind::object) {
    for (const auto& [name, make] : {std::pair("rigid", rotation), std::pair("affine", affine)}) {
      if (const Json* found = json->find(name)) {
        allow_keys(*json, {name});
        return make(*found, shape);
      }
    }
  }
  return translation(json, shape);
}

template <class T>
struct Pieces {
  std::vector<Rational> until;
  std::vector<T> all;  // one more

  const T& just_before(const Rational* end) const {  // or the last one
    const auto found = end ? std::lower_bound(until.begin(), until.end(), *end) : until.end();
    return all[static_cast<std::size_t>(found - until.begin())];
  }

  const T& after(const Rational& t) const {
    const auto found = std::upper_bound(until.begin(), until.end(), t);
    return all[static_cast<std::size_t>(found - until.begin())];
  }
};

bool are_in_order(const std::vector<Pose>& path) {
  return std::all_of(path.begin(), path.end(), [](const Pose& p) { return p.begin < p.end; });
}

std::vector<Turn> turns_of(const Pieces<Motion>& pieces) {
  std::vector<Turn> turns;
  for (const Motion& motion : pieces.all)
    if (motion.turn) turns.push_back(*motion.turn);
  return turns;
}

std::vector<Pose> poses(const Json& path) {
  const std::vector<Json>& times = list(member(path, "times"));
  const std::vector<Json>& rows = list(member(path, "poses"));
  if (times.size() != rows.size() + 1) throw NoProof("the scene has a path with a pose for no time");
  std::vector<Pose> result;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    allow_keys(rows[i], {"x", "y", "angle"});
    result.push_back({exact_number(&times[i]), exact_number(&times[i + 1]),
                      polynomial(member(rows[i], "x")), polynomial(member(rows[i], "y")),
                      polynomial(member(rows[i], "angle"))});
  }
  return result;
}

// An error: a number that is not negative.
Rational error_of(const Json* json) {
  const Rational error = exact_number(json);
  if (sign(error) < 0) throw NoProof("the scene has a negative error: " + json->text);
  return error;
}

PathRecord path_of(const Json& json) {
  allow_keys(json, {"error", "place_error", "assumed_angle_error", "times", "poses", "pivot"});
  // A part of the error of the angle is assumed; the pieces are to be within the rest.
  const Json* given = json.find("assumed_angle_error");
  const Rational assumed = given ? error_of(given) : Rational(0);
  const Rational error = exact_number(member(json, "error")) - assumed;
  const Rational off = error_of(member(json, "place_error"));
  PathRecord record{pair(json.find("pivot"), 0, 0), poses(json), error, off, true};
  if (sign(error) <= 0 || record.poses.empty() || !are_in_order(record.poses))
    throw NoProof("the scene has a path without errors, or whose times do not increase");
  return record;
}

// That a spin names a pivot which is not that of all its pieces is an error.
void check_pivot(const Json& spin, const Pieces<Motion>& pieces) {
  const Json* given = spin.find("pivot");
  if (!given) return;
  const Place pivot = pair(given, 0, 0);
  for (const Motion& motion : pieces.all)
    if (!motion.turn || motion.turn->pivot != pivot)
      throw NoProof("the scene has a spin with another pivot than that of its pieces");
}

// The motion of a body: a piece or several, and the pivot of the path that they follow.
struct BodyMotion {
  Pieces<Motion> pieces;
  std::optional<Place> path_pivot;
};

BodyMotion motion_of(const Json* json, std::size_t shape, bool are_records_verified) {
  if (!json || json->kind != Json::Kind::object || !json->find("pieces"))
    return {{{}, {simple_motion(json, shape)}}, {}};
  allow_keys(*json, {"pieces", "spin", "path", "spline"});
  int records = 0;
  for (const char* key : {"spin", "path", "spline"}) records += json->find(key) ? 1 : 0;
  if (records > 1) throw NoProof("the scene has a spin with a path, or a spline with one");
  Pieces<Motion> pieces;
  const std::vector<Json>& rows = list(json->find("pieces"));
  if (rows.empty()) throw NoProof("the scene has a motion of no pieces");
  for (const Json& row : rows) {
    allow_keys(row, {"until", "motion"});
    if ((row.find("until") == nullptr) != (&row == &rows.back()))
      throw NoProof("the scene has pieces that do not end where they should");
    if (const Json* until = row.find("until")) pieces.until.push_back(exact_number(until));
    if (pieces.until.size() > 1 && *(pieces.until.end() - 2) >= pieces.until.back())
      throw NoProof("the scene has pieces that go back in time");
    pieces.all.push_back(simple_motion(member(row, "motion"), shape));
  }
  if (const Json* spin = json->find("spin")) {
    allow_keys(*spin, {"omega", "error", "pivot"});
    check_pivot(*spin, pieces);
    const std::vector<Turn> turns = turns_of(pieces);
    const Rational omega = exact_number(member(*spin, "omega"));
    const Rational error = exact_number(member(*spin, "error"));
    if (sign(error) <= 0) throw NoProof("the scene has a spin without an error");
    if (are_records_verified &&
        (turns.size() < pieces.all.size() || !is_spin(pieces.until, turns, omega, error)))
      throw NoProof("the scene has a spin whose pieces do not turn so");
  }
  std::optional<Place> path_pivot;
  if (const Json* path = json->find("path")) {
    const PathRecord record = path_of(*path);
    const std::vector<Turn> turns = turns_of(pieces);
    if (are_records_verified &&
        (turns.size() < pieces.all.size() || !is_path(pieces.until, turns, record)))
      throw NoProof("the scene has a path that its pieces do not follow");
    path_pivot = record.pivot;
  }
  if (const Json* spline = json->find("spline")) {
    allow_keys(*spline, {"error"});
    error_of(member(*spline, "error"));
  }
  return {pieces, path_pivot};
}

using Shape = std::vector<Position>;

std::vector<Place> points(const Json* json) {
  std::vector<Place> result;
  for (const Json& point : list(json)) {
    if (list(&point).size() != 2) throw NoProof("the scene has a vertex without two coordinates");
    result.emplace_back(exact_number(&point.items[0]), exact_number(&point.items[1]));
  }
  return result;
}

Pieces<Shape> keyframes(const Json& json) {
  std::vector<Rational> times;
  std::vector<std::vector<Place>> frames;
  for (const Json& frame : list(&json)) {
    allow_keys(frame, {"t", "vertices"});
    times.push_back(exact_number(member(frame, "t")));
    frames.push_back(points(member(frame, "vertices")));
    if (frames.back().size() != frames.front().size())
      throw NoProof("the scene has keyframes of different sizes");
  }
  if (frames.empty() || frames.front().empty())
    throw NoProof("the scene has a body without keyframes, or with empty ones");
  Pieces<Shape> pieces;
  pieces.until = times;
  for (std::size_t i = 0; i <= frames.size(); ++i) {
    Shape shape;
    for (std::size_t k = 0; k < frames.front().size(); ++k) {
      const Place& to = frames[std::min(i, frames.size() - 1)][k];
      if (i == 0 || i == frames.size()) {
        shape.emplace_back(constant(to.first), constant(to.second));
        continue;
      }
      if (times[i - 1] >= times[i]) throw NoProof("the scene has keyframes that go back in time");
      const Place& from = frames[i - 1][k];
      shape.emplace_back(linear(times[i - 1], times[i], from.first, to.first),
                         linear(times[i - 1], times[i], from.second, to.second));
    }
    pieces.all.push_back(std::move(shape));
  }
  return pieces;
}

// A ring of vertices as it is in the file.
struct Outline {
  const Json* rows;
  bool is_hole;
};

std::vector<Outline> outlines(const Json& body) {
  std::vector<Outline> result;
  const auto add = [&](const Json& part) {
    result.push_back({member(part, "vertices"), false});
    if (const Json* holes = part.find("holes"))
      for (const Json& hole : list(holes)) result.push_back({&hole, true});
  };
  const Json* parts = body.find("parts");
  if (!parts) {
    add(body);
    return result;
  }
  for (const Json& part : list(parts)) {
    allow_keys(part, {"vertices", "holes"});
    add(part);
  }
  return result;
}

Pieces<Shape> shapes(const Json& json) {
  int ways = 0;
  for (const char* key : {"keyframes", "vertices", "parts"}) ways += json.find(key) != nullptr;
  if (ways != 1) throw NoProof("the scene has a body with no vertices, or with several sorts");
  if (const Json* frames = json.find("keyframes")) return keyframes(*frames);
  Shape shape;
  for (const Outline& outline : outlines(json)) {
    for (const Json& row : list(outline.rows)) {
      if (row.kind == Json::Kind::object) {
        allow_keys(row, {"x", "y"});
        shape.emplace_back(polynomial(row.find("x")), polynomial(row.find("y")));
      } else {
        if (list(&row).size() != 2) throw NoProof("the scene has a vertex without two coordinates");
        shape.emplace_back(constant(exact_number(&row.items[0])),
                           constant(exact_number(&row.items[1])));
      }
    }
  }
  return {{}, {shape}};
}

std::vector<Ring> rings(const Json& json, const Body& body, bool is_closed) {
  if (json.find("keyframes")) return {{body.first, body.size}};
  std::vector<Ring> result;
  int first = body.first;
  for (const Outline& outline : outlines(json)) {
    const int size = static_cast<int>(outline.rows->items.size());
    result.push_back({first, size, outline.is_hole});
    first += size;
  }
  const bool are_several = result.size() > 1 || json.find("parts");
  if (result.empty()) throw NoProof("the scene has a body of no parts");
  for (const Ring& ring : result)
    if (are_several && (ring.size < 3 || !is_closed))
      throw NoProof("the scene has a ring that bounds nothing");
  return result;
}

std::vector<Place> places(const Shape& shape, const Rational& t) {
  std::vector<Place> result;
  for (const auto& [x, y] : shape) result.emplace_back(value_at(x, t), value_at(y, t));
  return result;
}

// The points about which a motion turns its body.
std::set<Place> pivots_of(const BodyMotion& motion) {
  if (motion.path_pivot) return {*motion.path_pivot};
  std::set<Place> pivots;
  for (const Motion& piece : motion.pieces.all)
    if (piece.turn) pivots.insert(piece.turn->pivot);
  return pivots;
}

// Whether a stated error lets the true body differ from the one in the file. An error of the angle
// is a turn about a reference point: the one about which the motion turns, or else the body's pivot.
bool has_error(const Json& body, const BodyMotion& motion) {
  const auto given = [&](const char* key) {
    const Json* error = body.find(key);
    return error ? error_of(error) : Rational(0);
  };
  const Rational place = given("place_error"), angle = given("angle_error");
  bool has_shape_error = false;
  if (const Json* errors = body.find("shape_error")) {
    if (list(errors).size() != 2)
      throw NoProof("the scene has a shape_error that is not of two numbers");
    for (const Json& error : errors->items)
      if (error_of(&error) > 0) has_shape_error = true;
  }
  const Json* pivot = body.find("pivot");
  if (pivot) pair(pivot, 0, 0);
  if (angle == 0) {
    if (pivot) throw NoProof("the scene has a body with a pivot, and without an angle_error");
    return place > 0 || has_shape_error;
  }
  const std::size_t pivots = pivots_of(motion).size();
  if (pivots > 1) throw NoProof("the scene has an angle_error of a body that turns about two points");
  if (pivots == 0 && !pivot) throw NoProof("the scene has an angle_error without a pivot");
  if (pivots == 1 && pivot) throw NoProof("the scene has a pivot beside that of the motion");
  return true;
}

void check_jumps(const Body& body, const Pieces<Shape>& shape, const Pieces<Motion>& motion) {
  for (std::size_t i = 0; i < motion.until.size(); ++i) {
    const Rational& t = motion.until[i];
    const std::vector<Rational> one = motion.all[i].at(t), other = motion.all[i + 1].at(t);
    if (one == other) continue;
    for (const Place& p : places(shape.after(t), t))
      if (moved(one, p) != moved(other, p))
        throw NoProof("the body " + body.name + " jumps at t = " + t.get_str());
  }
}

// Rings are simple and apart; each hole is in its outline and in no other hole of it, each part
// in no other one, unless in a hole of that one.
void check_start(const Body& body, const std::vector<Place>& all) {
  std::vector<std::pair<int, int>> edges;
  for (const Ring& ring : body.rings) {
    for (int k = 0; k < ring.size; ++k) {
      const int i = ring.first - body.first;
      if (body.is_polygon || k + 1 < ring.size) edges.emplace_back(i + k, i + (k + 1) % ring.size);
    }
  }
  if (!is_simple(all, edges)) throw NoProof("the body " + body.name + " is not simple at the start");
  std::vector<std::vector<Polygon>> parts;  // outlines first
  for (const Ring& ring : body.rings) {
    if (!ring.is_hole) parts.emplace_back();
    const auto from = all.begin() + (ring.first - body.first);
    parts.back().emplace_back(from, from + ring.size);
  }
  if (body.rings.size() == 1) return;
  const auto within = [](const Polygon& p, const Polygon& q) { return is_in(q, p.front()); };
  const auto fault = [&] { throw NoProof("the body " + body.name + " has a hole or part amiss"); };
  for (const auto& part : parts) {
    for (std::size_t i = 1; i < part.size(); ++i) {
      if (!within(part[i], part[0])) fault();
      for (std::size_t j = 1; j < part.size(); ++j)
        if (i != j && within(part[i], part[j])) fault();
    }
    for (const auto& other : parts) {
      if (&other == &part || !within(part[0], other[0])) continue;
      const auto is_hole_around = [&](const Polygon& hole) { return within(part[0], hole); };
      if (std::none_of(other.begin() + 1, other.end(), is_hole_around)) fault();
    }
  }
}

}  // namespace

Rational exact_number(const Json* json) {
  if (json->kind != Json::Kind::number && json->kind != Json::Kind::text)
    throw NoProof("the scene has something that is not a number");
  std::string_view text = json->text;
  const bool is_short = text.size() <= 3 * most_digits;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  if (is_short) {
    const auto value = is_fraction(text) ? std::optional(fraction(text)) : decimal(text);
    if (value && !is_long(*value)) return *value;
  }
  throw NoProof("the scene has something that is not a number: " +
                std::string(text.substr(0, 40)));
}

const std::vector<Json>& list(const Json* json) {
  if (json->kind != Json::Kind::list) throw NoProof("the scene has something that is not a list");
  return json->items;
}

void allow_keys(const Json& json, std::initializer_list<std::string_view> keys) {
  if (json.kind != Json::Kind::object) throw NoProof("the scene has something that is no object");
  for (const auto& [name, value] : json.members)
    if (std::find(keys.begin(), keys.end(), name) == keys.end())
      throw NoProof("the scene has an unknown key: " + name);
}

const Json* member(const Json& json, std::string_view key) {
  const Json* found = json.find(key);
  if (!found) throw NoProof("the scene lacks the key " + std::string(key));
  return found;
}

Body read_body(const Json& json, int first, const Rational& start, bool are_records_verified) {
  allow_keys(json, {"name", "vertices", "keyframes", "motion", "closed", "holes", "parts", "radius",
                    "properties", "place_error", "angle_error", "shape_error", "pivot"});
  const Json* properties = json.find("properties");
  if (properties && properties->kind != Json::Kind::object)
    throw NoProof("the scene has properties that are no object");
  Body body;
  const Json* name = member(json, "name");
  if (name->kind != Json::Kind::text || name->text.empty())
    throw NoProof("the scene has a name that is no text, or empty");
  body.name = name->text;
  body.first = first;
  const Json* closed = json.find("closed");
  if (closed && closed->kind != Json::Kind::boolean)
    throw NoProof("the scene has a body that is neither closed nor open");
  if (const Json* radius = json.find("radius")) body.radius = exact_number(radius);
  if (sign(body.radius) < 0) throw NoProof("the scene has a radius below 0");
  const Pieces<Shape> shape = shapes(json);
  if (shape.all.front().empty()) throw NoProof("the scene has a body without vertices");
  std::size_t highest = json.find("keyframes") ? 1 : 0;
  for (const auto& [x, y] : shape.all.front())
    if (!json.find("keyframes")) highest = std::max({highest, degree(x), degree(y)});
  const BodyMotion given = motion_of(json.find("motion"), highest, are_records_verified);
  const Pieces<Motion>& motion = given.pieces;
  body.is_modelled = has_error(json, given);
  body.size = static_cast<int>(shape.all.front().size());
  const bool is_closed = !closed || closed->truth;
  body.is_polygon = body.size > 2 && is_closed;
  if (json.find("holes") && !json.find("vertices"))
    throw NoProof("the scene has holes without vertices");
  body.rings = rings(json, body, is_closed);
  check_jumps(body, shape, motion);
  std::vector<Place> all = places(shape.after(start), start);
  for (Place& p : all) p = moved(motion.after(start).at(start), p);
  check_start(body, all);
  body.breaks = shape.until;
  body.breaks.insert(body.breaks.end(), motion.until.begin(), motion.until.end());
  std::sort(body.breaks.begin(), body.breaks.end());
  body.breaks.erase(std::unique(body.breaks.begin(), body.breaks.end()), body.breaks.end());
  for (std::size_t i = 0; i <= body.breaks.size(); ++i) {
    const Rational* end = i < body.breaks.size() ? &body.breaks[i] : nullptr;
    spend(4000 * static_cast<double>(body.size));
    std::vector<Path> paths;
    const Motion& here = motion.just_before(end);
    for (const Position& p : shape.just_before(end)) paths.push_back(here.path(p));
    body.pieces.push_back(std::move(paths));
  }
  return body;
}

}  // namespace proof
