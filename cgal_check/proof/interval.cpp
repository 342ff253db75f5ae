// The map between two times, and at a time.
#include <set>

#include "checker.hpp"
#include "clusters.hpp"
#include "faults.hpp"

namespace proof {

namespace {

constexpr mp_bitcnt_t least_apart = 2048;  // of times: the span / 2^2048

}  // namespace

void Checker::go_on_to(Time next) {
  Time& now = times_.back();
  Rational unit = text_.end - text_.start;
  mpq_div_2exp(unit.get_mpq_t(), unit.get_mpq_t(), least_apart);
  const std::optional<Rational> sample = Time::sample(now, next, text_.start, unit);
  if (!sample) throw Rejected("times do not increase, or by too little");
  if (map_) settle(Time(*sample));
  if (map_ && times_.size() == 1) check_contacts(living(), now);
  times_.push_back(std::move(next));
}

// The new angles, at a sample of the interval in which they are new.
void Checker::settle(const Time& sample) {
  std::set<int> vertices, faces;
  for (const int h : fresh_) {
    angle(h).kind = kind_of(h, sample);
    vertices.insert(map_->origin(h));
  }
  for (const int h : fresh_)
    if (faces.insert(face(h)).second) count_corners(h, sample);
  if (outer_faces_ != 1)
    throw Rejected(std::to_string(outer_faces_) + " faces have no convex angle", fresh_line_);
  for (const int v : vertices) check_star(v, sample);
  fresh_.clear();
}

Kind Checker::kind_of(int h, const Time& sample) {
  const int u = map_->target(angle(h).end), v = map_->origin(h), w = map_->target(h);
  const int turn = u == w ? 0 : predicates_.orientation(u, v, w, sample);
  if (turn != 0) return turn > 0 ? Kind::convex : Kind::reflex;
  const std::string name = "the angle " + std::to_string(u) + " " + std::to_string(v) + " " +
                           std::to_string(w);
  if (!predicates_.is_flat(u, v, w, sample))
    throw Rejected(name + " vanishes during its life", fresh_line_);
  const int side = predicates_.dot_product(u, v, w, sample);
  if (u == w ? side <= 0 : side >= 0) throw Rejected(name + " is 0", fresh_line_);
  return u == w ? Kind::full : Kind::flat;
}

void Checker::count_corners(int h, const Time& sample) {
  std::size_t convex = 0, wide = 0, turns = 0;
  const std::vector<int> cycle = map_->face(h);
  spend(100 * static_cast<double>(cycle.size()));
  for (const int g : cycle) {
    convex += angle(g).kind == Kind::convex;
    wide += angle(g).kind == Kind::reflex || angle(g).kind == Kind::full;
  }
  const auto f = static_cast<std::size_t>(face(h));
  outer_faces_ -= is_outer_[f];
  is_outer_[f] = convex == 0;
  outer_faces_ += is_outer_[f];
  if (convex == 0 && component(map_->origin(h)) != outermost_)
    throw Rejected("a face in a hole has no convex angle", fresh_line_);
  if (convex == 0 || convex == 3) return;
  if (convex < 3 || wide > 0)
    throw Rejected("the face of " + std::to_string(map_->origin(h)) + " " +
                   std::to_string(map_->target(h)) + " has " + std::to_string(convex) +
                   " convex angles", fresh_line_);
  // Each turn is to the left, by less than pi: once around is once from downward to upward.
  for (const int g : cycle)
    turns += !is_upward(g, sample) && is_upward(map_->next(g), sample);
  if (turns != 1)
    throw Rejected("the face of " + std::to_string(map_->origin(h)) + " " +
                   std::to_string(map_->target(h)) + " turns " + std::to_string(turns) + " times",
                   fresh_line_);
}

// From one edge to the next counter-clockwise, the direction passes that of the x-axis if it
// goes from downward to upward, or by more than pi within either half.
void Checker::check_star(int v, const Time& sample) {
  std::size_t turns = 0;
  int h = map_->any(v);
  do {
    spend(200);
    const int g = map_->counter_clockwise(h);
    const bool from = is_upward(h, sample), to = is_upward(g, sample);
    const auto is_wide = [&] {
      return predicates_.orientation(map_->target(g), v, map_->target(h), sample) <= 0;
    };
    turns += from == to ? is_wide() : to;
    h = g;
  } while (h != map_->any(v));
  if (turns != 1)
    throw Rejected("the edges of vertex " + std::to_string(v) + " go around it " +
                   std::to_string(turns) + " times", fresh_line_);
}

// Whether the direction of a half-edge is in [0, pi).
bool Checker::is_upward(int h, const Time& sample) {
  const int u = map_->origin(h), v = map_->target(h);
  const int y = predicates_.difference_of_y(u, v, sample);
  return y > 0 || (y == 0 && predicates_.difference_of_x(u, v, sample) > 0);
}

std::vector<int> Checker::vanishing(const std::vector<int>& halves, const Time& t) {
  std::vector<int> found;
  for (const int h : halves) {
    if (angle(h).is_solid) continue;
    const int u = map_->target(angle(h).end), v = map_->origin(h), w = map_->target(h);
    const bool is_straight = angle(h).kind == Kind::flat || angle(h).kind == Kind::full;
    const int sign = is_straight ? predicates_.dot_product(u, v, w, t)
                                 : predicates_.orientation(u, v, w, t);
    if (sign == 0) found.push_back(h);
  }
  return found;
}

// Step 6, of those of some angles that vanish at a time.
void Checker::check_contacts(const std::vector<int>& halves, const Time& t) {
  in_share([&] { check_clusters(scene_, *map_, predicates_, vanishing(halves, t), t); });
}

}  // namespace proof
