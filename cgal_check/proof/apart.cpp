#include "apart.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <set>
#include <unordered_map>
#include <vector>

#include "faults.hpp"
#include "statement.hpp"

namespace proof {

namespace {

struct Item {
  int body, u, v;
};

// (w x, w y, w t, w): each linear form of it is a positive multiple of a Bernstein coefficient.
using Hull = std::vector<std::array<Integer, 4>>;

struct Span {
  Rational start, end;
  std::unordered_map<int, Hull> hulls = {};
};

struct Node {
  std::vector<int> items;
  std::shared_ptr<Span> time;
};

using Plane = std::array<Integer, 4>;

void require(bool condition, const std::string& why, std::size_t line) {
  if (!condition) throw Rejected(why, line);
}

double words(const Integer& n) { return static_cast<double>(mpz_size(n.get_mpz_t()) + 1); }

void add_hull(Hull& hull, const Path& path, const Rational& s, const Rational& e) {
  const std::size_t n = std::max({path.x.size(), path.y.size(), path.w.size()});  // degree + 1
  const Integer q = lcm(s.get_den(), e.get_den());
  const Integer a = s.get_num() * (q / s.get_den()), b = e.get_num() * (q / e.get_den());
  const double long_q = words(q) + words(a) + words(b), degree = static_cast<double>(n);
  spend(8 + degree * degree * long_q * (words(path.w.back()) + degree * long_q));
  const Poly<Integer> x = between<Integer>(path.x, a, b, q, n), y = between<Integer>(path.y, a, b, q, n);
  const Poly<Integer> w = between<Integer>(path.w, a, b, q, n);
  // t w, of the same degree n: w of degree n - 1 times (a + b s).
  const Poly<Integer> low = between<Integer>(path.w, a, b, q, n - 1);
  for (std::size_t k = 0; k <= n; ++k) {
    Integer t = k < n ? Integer(a * low[k]) : Integer(0);
    if (k > 0) t += b * low[k - 1];
    hull.push_back({x[k], y[k], t, w[k]});
  }
}

int sign_of_turn(const Place& a, const Place& b, const Place& c) {
  return sign(Rational((b.first - a.first) * (c.second - a.second) -
                       (b.second - a.second) * (c.first - a.first)));
}

bool is_on(const Place& p, const Place& a, const Place& b) {
  return sign_of_turn(a, b, p) == 0 &&
         sign(Rational((a.first - p.first) * (b.first - p.first) +
                       (a.second - p.second) * (b.second - p.second))) <= 0;
}

bool have_common_point(const std::array<Place, 4>& p) {
  const auto& [a, b, c, d] = p;
  return (sign_of_turn(a, b, c) * sign_of_turn(a, b, d) < 0 &&
          sign_of_turn(c, d, a) * sign_of_turn(c, d, b) < 0) ||
         is_on(c, a, b) || is_on(d, a, b) || is_on(a, c, d) || is_on(b, c, d);
}

Rational squared_distance(const Place& p, const Place& a, const Place& b) {
  const Rational x = b.first - a.first, y = b.second - a.second;
  const Rational z = p.first - a.first, w = p.second - a.second;
  const Rational square = x * x + y * y;
  Rational k = sign(square) == 0 ? Rational(0) : Rational((x * z + y * w) / square);
  if (k < 0) k = 0;
  if (k > 1) k = 1;
  const Rational u = z - k * x, v = w - k * y;
  return u * u + v * v;
}

bool are_near(const std::array<Place, 4>& p, const Rational& far) {
  if (have_common_point(p)) return true;
  const auto& [a, b, c, d] = p;
  const Rational most = far * far;
  return squared_distance(a, c, d) <= most || squared_distance(b, c, d) <= most ||
         squared_distance(c, a, b) <= most || squared_distance(d, a, b) <= most;
}

bool is_crossed_oddly(const Polygon& ring, const Place& p) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Place &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.second > p.second) == (b.second > p.second)) continue;
    const Rational x =
        a.first + (p.second - a.second) * (b.first - a.first) / (b.second - a.second);
    odd ^= x > p.first;
  }
  return odd;
}

bool is_inside(const Body& body, const Place& p, const Rational& t) {
  bool odd = false;
  if (body.is_polygon)
    for (const Polygon& ring : polygons(body, t)) odd ^= is_crossed_oddly(ring, p);
  return odd;
}

class Checker {
 public:
  Checker(const Scene& scene, const ApartText& text) : scene_(scene), text_(text) {
    const std::size_t n = scene.bodies().size();
    for (std::size_t i = 0; i < n; ++i) {
      const Body& body = scene.bodies()[i];
      group_.push_back(static_cast<int>(i));
      const std::size_t before = items_.size();
      for (const Ring& ring : body.rings)
        for (int k = 0; k < (body.is_polygon ? ring.size : ring.size - 1); ++k)
          items_.push_back({static_cast<int>(i), ring.first + k, ring.first + (k + 1) % ring.size});
      if (items_.size() == before) items_.push_back({static_cast<int>(i), body.first, body.first});
    }
    require(scene.start() <= text.start && text.start <= text.end && text.end <= scene.end(),
            "not a span of the scene", text.span_line);
    for (const ChoiceText& choice : text.choices) read_choice(choice);
    require(sign(text.distance) >= 0, "a distance below 0", text.distance_line);
  }

  Statement run() {
    Statement result;
    const bool has_contact = text_.kind != "none", is_later = scene_.start() < text_.start;
    Rational high = text_.end;
    std::string how, words, rest;
    if (has_contact) high = check_contact(how);
    const std::string far = text_.distance == 0 ? "" : "within " + text_.distance.get_str();
    const std::string a = text_.start.get_str(), low = text_.end.get_str();
    const std::string first = scene_.start().get_str(), end = scene_.end().get_str();
    if (has_contact && high == text_.start) {
      require(text_.start == text_.end && text_.nodes.empty(), "there is a contact at the start",
              text_.last_line);
      words = "two bodies " + (far.empty() ? "share a point" : far) + " at the start t = " + a +
              ": " + how;
    } else {
      require(!has_contact || text_.end < high, "a contact before the end", text_.last_line);
      check_outside();
      check_nodes();
      words = has_contact ? "first " + (far.empty() ? "contact" : "time " + far) +
                                " of two bodies in (" + low + ", " + high.get_str() + "]: " + how
                          : "no two bodies " + (far.empty() ? "share a point" : "are " + far) +
                                (text_.start < text_.end ? " in [" + a + ", " + low + "]"
                                                         : " at t = " + a);
    }
    if (is_later) rest = "[" + first + ", " + a + ")";
    if (!has_contact && text_.end < scene_.end())
      rest += (rest.empty() ? "" : " and ") + ("(" + low + ", " + end + "]");
    if (!has_contact && rest.empty()) words += ", the whole span";
    if (!rest.empty())
      words += "; the span of the scene is [" + first + ", " + end + "]: nothing is said of " + rest;
    words += selection_;
    std::string names;
    for (const int i : named_in_words_)
      names += (names.empty() ? " (b" : ", b") + std::to_string(i) + " is " +
               quoted(scene_.bodies()[static_cast<std::size_t>(i)].name);
    result.text = words + names + (names.empty() ? "" : ")");
    result.until = high;
    result.low = text_.end;
    result.has_contact = has_contact && text_.distance == 0;
    if (has_contact && !scene_.groups().do_count(met_.first, met_.second))
      throw Rejected("the contact is one of two bodies that ignore each other");
    result.is_of_all = !is_later && has_all_that_count();
    result.is_whole = result.is_of_all && rest.empty();
    return result;
  }

 private:
  int index(int i, std::size_t size, std::size_t line) const {
    require(static_cast<std::size_t>(i) < size, "not the number of a body, vertex or item", line);
    return i;
  }

  void read_choice(const ChoiceText& choice) {
    selection_ += choice.is_group ? "; ignoring" : "; between";
    std::set<int> here;
    for (const int i : choice.bodies) {
      index(i, group_.size(), choice.line);
      require(here.insert(i).second && grouped_.count(i) == 0, "a body is there twice", choice.line);
      named_in_words_.insert(i);
      selection_ += " b" + std::to_string(i);
    }
    if (!choice.is_group) {
      pairs_.insert({*here.begin(), *here.rbegin()});
      return;
    }
    grouped_.insert(here.begin(), here.end());
    for (const int i : here) group_[static_cast<std::size_t>(i)] = *here.begin();
  }

  bool count(const std::set<int>& bodies) const {
    const auto group = [&](int i) { return group_[static_cast<std::size_t>(i)]; };
    if (!pairs_.empty())
      return std::any_of(pairs_.begin(), pairs_.end(), [&](const auto& pair) {
        return group(pair.first) != group(pair.second) && bodies.count(pair.first) &&
               bodies.count(pair.second);
      });
    return std::any_of(bodies.begin(), bodies.end(),
                       [&](int i) { return group(i) != group(*bodies.begin()); });
  }

  bool counts(int i, int j) const {
    const auto group = [&](int k) { return group_[static_cast<std::size_t>(k)]; };
    return group(i) != group(j) && (pairs_.empty() || pairs_.count({std::min(i, j), std::max(i, j)}) > 0);
  }

  // Whether each pair that counts in the scene counts here. More may do: bodies that the scene
  // ignores, and that are apart nevertheless.
  bool has_all_that_count() const {
    if (selection_.empty()) return true;
    const int n = static_cast<int>(group_.size());
    if (!pairs_.empty()) {
      for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n; ++j)
          if (!counts(i, j) && scene_.groups().do_count(i, j)) return false;
      return true;
    }
    // No pair is left out but those of one group, each of which is in one line.
    for (const ChoiceText& choice : text_.choices)
      for (const int i : choice.bodies)
        for (const int j : choice.bodies)
          if (i != j && scene_.groups().do_count(i, j)) return false;
    return true;
  }

  const Item& item(int i) const { return items_[static_cast<std::size_t>(i)]; }
  const Body& body(int i) const { return scene_.bodies()[static_cast<std::size_t>(i)]; }

  void check_nodes() {
    Node root{{}, std::make_shared<Span>(Span{text_.start, text_.end})};
    for (std::size_t i = 0; i < items_.size(); ++i) root.items.push_back(static_cast<int>(i));
    std::vector<Node> todo{root};
    auto next = text_.nodes.begin();
    while (!todo.empty()) {
      const Node node = std::move(todo.back());
      todo.pop_back();
      spend(100 * static_cast<double>(node.items.size() + pairs_.size()));
      std::set<int> bodies;
      for (const int i : node.items) bodies.insert(item(i).body);
      if (!count(bodies)) continue;
      require(next != text_.nodes.end(), "a node is missing: two bodies are left together",
              text_.last_line);
      const NodeText& line = *next++;
      if (line.kind == 't') {
        const Rational& s = node.time->start;
        const Rational& e = node.time->end;
        const Rational q = line.has_time ? line.c : Rational((s + e) / 2);
        require(s < q && q < e, "a time that is not inside the interval", line.line);
        todo.push_back({node.items, std::make_shared<Span>(Span{q, e})});
        todo.push_back({node.items, std::make_shared<Span>(Span{s, q})});
        continue;
      }
      std::vector<int> not_above, not_below;
      if (line.kind == 's') index(line.body, group_.size(), line.line);
      if (line.kind == 'c') {
        require(line.x != 0 || line.y != 0, "a line without a direction", line.line);
        sides_.clear();
        planes_.clear();
      }
      for (const int i : node.items) {
        const int side = line.kind == 'c'           ? side_of(item(i), line, *node.time)
                         : item(i).body != line.body ? 0
                         : i < line.item             ? -1
                                                     : 1;
        if (side <= 0) not_above.push_back(i);
        if (side >= 0) not_below.push_back(i);
      }
      todo.push_back({std::move(not_below), node.time});
      todo.push_back({std::move(not_above), node.time});
    }
    require(next == text_.nodes.end(), "there are more nodes than are needed", text_.last_line);
  }

  int side_of(const Item& item, const NodeText& line, Span& time) {
    const int one = side_of(item.body, item.u, line, time);
    return one != 0 && one == side_of(item.body, item.v, line, time) ? one : 0;
  }

  // -1 if a vertex is below a line by more than the radius, 1 if it is above, else 0.
  int side_of(int body_number, int v, const NodeText& line, Span& time) {
    const auto known = sides_.find(v);
    if (known != sides_.end()) return known->second;
    const auto& [low, high] = planes(body(body_number).radius, line);
    const Hull& points = hull(v, time);
    spend(4 * static_cast<double>(points.size()) * words(points.front()[3]) * words(low[3]));
    const auto value = [](const Plane& plane, const std::array<Integer, 4>& p) {
      return sign(Integer(plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3]));
    };
    int side = 0;
    if (std::all_of(points.begin(), points.end(), [&](const auto& p) { return value(low, p) < 0; }))
      side = -1;
    else if (std::all_of(points.begin(), points.end(),
                         [&](const auto& p) { return value(high, p) >= 0; }))
      side = 1;
    sides_[v] = side;
    return side;
  }

  const std::pair<Plane, Plane>& planes(const Rational& radius, const NodeText& line) {
    const auto known = planes_.find(radius);
    if (known != planes_.end()) return known->second;
    const Integer square = line.x * line.x + line.y * line.y;
    Rational norm(sqrt(Integer(square << 128)) + 1, Integer(1) << 64);
    norm.canonicalize();
    const Rational low = line.c - norm * radius, high = line.c + norm * (radius + text_.distance);
    const Integer d = lcm(line.v.get_den(), Integer(lcm(low.get_den(), high.get_den())));
    const auto plane = [&](const Rational& c) -> Plane {
      return {d * line.x, d * line.y, Rational(-d * line.v).get_num(), Rational(-d * c).get_num()};
    };
    return planes_[radius] = {plane(low), plane(high)};
  }

  const Hull& hull(int v, Span& time) {
    const auto known = time.hulls.find(v);
    if (known != time.hulls.end()) return known->second;
    Hull points;
    const Body& body = scene_.body(v);
    Rational from = time.start;
    for (const Rational& q : body.breaks) {
      if (!(time.start < q && q < time.end)) continue;
      add_hull(points, scene_.path(v, Time(from)), from, q);
      from = q;
    }
    add_hull(points, scene_.path(v, Time(from)), from, time.end);
    return time.hulls[v] = std::move(points);
  }

  Place at(int v, const Rational& t) const { return place(scene_.path(v, Time(t)), t); }

  void check_outside() const {
    struct First {
      Place place;
      int body;
    };
    std::vector<First> firsts;
    for (std::size_t i = 0; i < scene_.bodies().size(); ++i)
      for (const Ring& ring : scene_.bodies()[i].rings)
        firsts.push_back({at(ring.first, text_.start), static_cast<int>(i)});
    std::sort(firsts.begin(), firsts.end(),
              [](const First& a, const First& b) { return a.place < b.place; });
    for (std::size_t i = 0; i < scene_.bodies().size(); ++i) {
      const Body& body = scene_.bodies()[i];
      if (!body.is_polygon) continue;
      const std::vector<Polygon> rings = polygons(body, text_.start);
      Rational left = rings[0][0].first, right = left;
      for (const Polygon& ring : rings)
        for (const Place& p : ring) {
          left = std::min(left, p.first);
          right = std::max(right, p.first);
        }
      auto near = std::lower_bound(firsts.begin(), firsts.end(), left,
                                   [](const First& f, const Rational& x) { return f.place.first < x; });
      for (; near != firsts.end() && near->place.first <= right; ++near) {
        spend(100 * static_cast<double>(body.size + pairs_.size()));
        if (!count({static_cast<int>(i), near->body})) continue;
        bool odd = false;
        for (const Polygon& ring : rings) odd ^= is_crossed_oddly(ring, near->place);
        require(!odd, "a body has a ring inside another one at the start", text_.last_line);
      }
    }
  }

  // The time of the last line; how bodies meet then.
  Rational check_contact(std::string& how) {
    const std::size_t line = text_.last_line;
    const Rational& s = text_.times.front();
    const Rational& t = text_.times.back();
    const std::string when = " at t = " + t.get_str();
    int i, j;
    require(text_.start <= std::min(s, t) && std::max(s, t) <= scene_.end(),
            "a time outside of the span", line);
    if (text_.kind == "meet") {
      const Item& a = item(index(text_.first, items_.size(), line));
      const Item& b = item(index(text_.second, items_.size(), line));
      i = a.body;
      j = b.body;
      const Rational far = text_.distance + body(i).radius + body(j).radius;
      require(are_near({at(a.u, t), at(a.v, t), at(b.u, t), at(b.v, t)}, far),
              "these are not near each other at that time", line);
      how = scene_.in_short(a.u) + " and " + scene_.in_short(b.u) + when;
    } else {
      const int v = index(text_.first, static_cast<std::size_t>(scene_.size()), line);
      i = scene_.body_of(v);
      if (text_.kind == "inside") {
        j = index(text_.second, scene_.bodies().size(), line);
        require(is_inside(body(j), at(v, t), t), "it is not inside at that time", line);
        how = scene_.in_short(v) + " inside b" + std::to_string(j) + when;
      } else {
        const Item& edge = item(index(text_.second, items_.size(), line));
        j = edge.body;
        require(s < t, "not a time of one formula", line);
        for (const int k : {i, j})
          for (const Rational& q : body(k).breaks)
            require(!(s < q && q < t), "not a time of one formula", line);
        const Time from(s);
        const Path &p = scene_.path(v, from), &a = scene_.path(edge.u, from),
                   &b = scene_.path(edge.v, from);
        const Poly<Integer> f = orientation(p, a, b);
        require(sign_at(f, s) * sign_at(f, t) <= 0, "it stays on one side of the edge", line);
        for (const Poly<Integer>& g : {dot_product(p, a, b), dot_product(p, b, a)})
          for (const Integer& c : between(g, s, t))
            require(sign(c) > 0, "it may pass beside the edge", line);
        how = scene_.in_short(v) + " through " + scene_.in_short(edge.u) + " in [" + s.get_str() +
              ", " + t.get_str() + "]";
      }
    }
    require(i != j && count({i, j}), "bodies that do not count as a pair", line);
    named_in_words_.insert({i, j});
    met_ = {i, j};
    return t;
  }

  const Scene& scene_;
  const ApartText& text_;
  std::vector<Item> items_;
  std::vector<int> group_;
  std::set<std::pair<int, int>> pairs_;
  std::set<int> grouped_, named_in_words_;
  std::pair<int, int> met_;  // the bodies of the contact
  std::string selection_;
  std::unordered_map<int, int> sides_;  // of vertices, at the node in hand
  std::map<Rational, std::pair<Plane, Plane>> planes_;  // of radii, likewise
};

}  // namespace

Statement check_apart(const Scene& scene, const ApartText& text) {
  return Checker(scene, text).run();
}

}  // namespace proof
