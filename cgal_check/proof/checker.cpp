#include "checker.hpp"

#include <algorithm>
#include <set>

#include "faults.hpp"

namespace proof {

Checker::Checker(Scene& scene, const ProofText& text, std::size_t share, std::size_t shares)
    : scene_(scene), text_(text), share_(share), shares_(shares), predicates_(scene) {}

std::optional<Failure> Checker::run() {
  try {
    check_all();
    return std::nullopt;
  } catch (const Rejected& fault) {
    // A check that is shared fails before one that all make after it.
    return Failure{2 * checks_ + (is_in_share_ ? 0 : 1), fault.line ? fault.line : line_,
                   fault.what()};
  }
}

void Checker::check_all() {
  check_span();
  if (text_.faces.empty() && text_.events.empty() && text_.contact) {
    line_ = text_.last_line;
    check_contact_at_start(*text_.contact);
    is_at_start_ = true;
    return;
  }
  begin();
  for (const EventText& event : text_.events) {
    line_ = event.line;
    check_items(event);
    go_on_to(time_of(event.time));
    if (map_) check_contacts(ending(event), times_.back());
    change(event);
  }
  line_ = text_.last_line;
  finish();
}

void Checker::check_span() {
  line_ = text_.span_line;
  if (text_.start != scene_.start() || text_.end <= text_.start || text_.end > scene_.end())
    throw Rejected("the time span is not one of the scene");
  scene_.examine(text_.end);
  times_.emplace_back(text_.start);
}

void Checker::check_vertices(const std::vector<int>& vertices) const {
  for (const int v : vertices)
    if (v >= scene_.size())
      throw Rejected("not a vertex, 0 to " + std::to_string(scene_.size() - 1) + ": " +
                     std::to_string(v));
}

void Checker::check_items(const EventText& event) const {
  const auto check_edge = [&](int u, int v) {
    check_vertices({u, v});
    if (scene_.is_body_edge(u, v))
      throw Rejected("the edge " + std::to_string(u) + " " + std::to_string(v) + " is of a body");
  };
  for (const auto& [u, v] : event.removed) check_edge(u, v);
  for (const auto& [u, v, w, x] : event.added) {
    check_edge(u, v);
    check_vertices({w, x});
  }
  const bool has_items = !event.added.empty() || !event.removed.empty() || !event.renewed.empty();
  if (!map_ && (has_items || scene_.size() == 0)) throw Rejected("there is nothing to change");
  for (const auto& [u, v, w, x] : event.added)
    if (component(u) != component(v))
      throw Rejected("the edge " + std::to_string(u) + " " + std::to_string(v) +
                     " joins two components of the map");
  for (const auto& [u, v] : event.renewed) {
    check_vertices({u, v});
    const int h = map_->find(u, v);
    if (h == -1 || angle(h).is_solid)
      throw Rejected("there is no angle of " + std::to_string(u) + " " + std::to_string(v) +
                     " to be taken anew");
  }
}

// The half-edges of all angles that may end by an event, of the map before.
std::vector<int> Checker::ending(const EventText& event) const {
  std::set<int> found;
  for (const auto& [u, v] : event.removed) {
    const int h = map_->find(u, v);
    if (h == -1) continue;
    for (const int g : {h, Map::twin(h)}) found.insert({g, map_->clockwise(g)});
  }
  for (const auto& [u, v, w, x] : event.added) found.insert({map_->find(v, w), map_->find(u, x)});
  for (const auto& [u, v] : event.renewed) found.insert(map_->find(u, v));
  found.erase(-1);
  return {found.begin(), found.end()};
}

void Checker::change(const EventText& event) {
  fresh_line_ = line_;
  if (!map_) return;
  std::vector<int> changed = map_->change(event);
  angles_.resize(static_cast<std::size_t>(map_->halves()));
  face_.resize(angles_.size(), -1);
  renew(std::move(changed), event.renewed);
  const auto count = static_cast<std::size_t>(scene_.size());
  if (count + faces_ != map_->edges() + 2 * components_)
    throw Rejected("V - E + F is not " + std::to_string(2 * components_));
  check_connected(event);
  check_insides(fresh_);
}

void Checker::renew(std::vector<int> changed, const std::vector<Edge>& renewed) {
  std::vector<int> ended, begun;
  for (const int h : changed) {
    const bool is_there = map_->is_there(h);
    if (is_there && angle(h).is_alive && angle(h).end == map_->counter_clockwise(h)) continue;
    if (angle(h).is_alive) {
      if (angle(h).is_solid) throw Rejected("the inside of a rigid body is not one face");
      end_life(h);
      ended.push_back(h);
    }
    if (is_there) {
      begin_life(h);
      begun.push_back(h);
    }
  }
  for (const auto& [u, v] : renewed) {
    const int h = map_->find(u, v);
    if (h == -1 || angle(h).since == &times_.back()) continue;
    end_life(h);
    begin_life(h);
  }
  renew_faces(ended, begun);
}

void Checker::begin_life(int h) {
  angle(h) = {true, false, map_->counter_clockwise(h), &times_.back(), Kind::convex};
  fresh_.push_back(h);
}

void Checker::end_life(int h) {
  angle(h).is_alive = false;
  in_share([&] {
    const Angle& a = angle(h);
    const int u = map_->target(a.end), v = map_->origin(h), w = map_->target(h);
    if (!keeps_kind(scene_, u, v, w, a.kind, *a.since, times_.back()))
      throw Rejected("the angle " + std::to_string(u) + " " + std::to_string(v) + " " +
                     std::to_string(w) + " vanishes during its life");
  });
}

// Of the half-edges of angles that ended and began, other than by being taken anew.
void Checker::renew_faces(const std::vector<int>& ended, const std::vector<int>& begun) {
  std::set<int> gone;
  for (const int h : ended) gone.insert(face(h));
  for (const int f : gone)
    if (is_outer_[static_cast<std::size_t>(f)]) --outer_faces_;
  faces_ -= gone.size();
  const int first = static_cast<int>(is_outer_.size());
  for (const int h : begun) {
    if (face(h) >= first) continue;
    const std::vector<int> cycle = map_->face(h);
    spend(20 * static_cast<double>(cycle.size()));
    for (const int g : cycle) face(g) = static_cast<int>(is_outer_.size());
    is_outer_.push_back(false);
    ++faces_;
  }
}

void Checker::check_connected(const EventText& event) const {
  for (const auto& [u, v] : event.removed)
    if (map_->find(u, v) == -1 && !map_->are_joined(u, v))
      throw Rejected("the map is not connected: vertices " + std::to_string(u) + " and " +
                     std::to_string(v));
}

// On the side of the inside, edges of a vertex lead to its body.
void Checker::check_insides(const std::vector<int>& halves) const {
  std::set<int> vertices;
  for (const int h : halves) vertices.insert(map_->origin(h));
  for (const int v : vertices) {
    if (!scene_.body(v).is_polygon) continue;
    const int last = map_->find(v, scene_.before(v));
    for (int h = map_->find(v, scene_.after(v)); h != last; h = map_->counter_clockwise(h))
      if (scene_.body_of(map_->target(h)) != scene_.body_of(v))
        throw Rejected("the edge " + std::to_string(v) + " " + std::to_string(map_->target(h)) +
                       " runs inside a body to another one");
  }
}

std::vector<int> Checker::living() const {
  std::vector<int> result;
  for (int h = 0; h < map_->halves(); ++h)
    if (angle(h).is_alive && !angle(h).is_solid) result.push_back(h);
  return result;
}

void Checker::finish() {
  const Time last = text_.contact ? time_of(text_.contact->time) : Time(text_.end);
  if (last.compare(text_.end) > 0)
    throw Rejected("the contact is after the time span");
  go_on_to(last);
  if (map_) {
    const std::vector<int> halves = living();
    if (!text_.contact) check_contacts(halves, times_.back());
    if (text_.contact)
      found_ = incidences(scene_, *map_, predicates_, vanishing(halves, times_.back()),
                          times_.back());
    for (const int h : halves) end_life(h);
  }
  if (text_.contact) check_contact(*text_.contact, times_.back());
}

}  // namespace proof
