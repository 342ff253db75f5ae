#include "map.hpp"

#include <algorithm>
#include <deque>
#include <unordered_set>

#include "faults.hpp"

namespace proof {

namespace {

std::uint64_t key(int u, int v) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(u)) << 32 |
         static_cast<std::uint32_t>(v);
}

std::string edge_in_words(int u, int v) {
  return "edge " + std::to_string(u) + " " + std::to_string(v);
}

}  // namespace

Map::Map(int vertices, const std::vector<FaceText>& faces)
    : first_(static_cast<std::size_t>(vertices), -1) {
  for (const FaceText& face : faces) {
    const std::vector<int>& cycle = face.vertices;
    if (cycle.size() < 2) throw Rejected("a face has fewer than two vertices", face.line);
    int before = make(cycle.back(), cycle.front());
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const int u = cycle[i], v = cycle[(i + 1) % cycle.size()];
      if (u == v)
        throw Rejected("a face has vertex " + std::to_string(u) + " twice in succession",
                       face.line);
      const int h = make(u, v);
      if (half(h).is_there)
        throw Rejected("the half-edge " + std::to_string(u) + " " + std::to_string(v) +
                       " is there twice",
                       face.line);
      half(h).is_there = true;
      link(twin(before), h);
      first_[static_cast<std::size_t>(u)] = h;
      before = h;
    }
  }
  for (int h = 0; h < halves(); ++h)
    if (!half(h).is_there)
      throw Rejected("the " + edge_in_words(origin(h), target(h)) +
                     " has a face on one side alone");
  edges_ = halves_.size() / 2;
  // One cycle around each vertex.
  std::vector<std::size_t> degree(first_.size());
  for (int h = 0; h < halves(); ++h) ++degree[static_cast<std::size_t>(origin(h))];
  for (std::size_t v = 0; v < first_.size(); ++v) {
    if (first_[v] == -1) throw Rejected("vertex " + std::to_string(v) + " has no edge");
    std::size_t count = 1;
    for (int h = clockwise(first_[v]); h != first_[v]; h = clockwise(h)) ++count;
    if (count != degree[v])
      throw Rejected("the edges of vertex " + std::to_string(v) + " are not one cycle around it");
  }
}

int Map::find(int u, int v) const {
  const auto found = numbers_.find(key(u, v));
  return found == numbers_.end() || !is_there(found->second) ? -1 : found->second;
}

int Map::make(int u, int v) {
  const auto found = numbers_.find(key(u, v));
  if (found != numbers_.end()) return found->second;
  const int h = halves();
  for (const int end : {u, v}) halves_.push_back({end});
  numbers_[key(u, v)] = h;
  numbers_[key(v, u)] = twin(h);
  return h;
}

// `after` follows `before` clockwise.
void Map::link(int before, int after) {
  half(before).clockwise = after;
  half(after).counter_clockwise = before;
}

std::vector<int> Map::face(int h) const {
  std::vector<int> cycle{h};
  for (int g = next(h); g != h; g = next(g)) cycle.push_back(g);
  return cycle;
}

// Two searches in turn, one from each: what a removed edge has cut off is found soon.
bool Map::are_joined(int u, int v) const {
  std::deque<int> open[2]{{u}, {v}};
  std::unordered_set<int> seen[2]{{u}, {v}};
  for (int side = 0;; side = 1 - side) {
    if (open[side].empty()) return false;
    spend(500);
    const int here = open[side].front();
    open[side].pop_front();
    if (seen[1 - side].count(here) > 0) return true;
    const int first = any(here);
    if (first == -1) continue;
    int h = first;
    do {
      if (seen[side].insert(target(h)).second) open[side].push_back(target(h));
      h = clockwise(h);
    } while (h != first);
  }
}

std::vector<int> Map::components() const {
  std::vector<int> result(first_.size(), -1);
  int number = 0;
  for (std::size_t start = 0; start < first_.size(); ++start) {
    if (result[start] != -1) continue;
    std::vector<int> open{static_cast<int>(start)};
    result[start] = number;
    while (!open.empty()) {
      const int first = any(open.back());
      open.pop_back();
      int h = first;
      do {
        int& of_target = result[static_cast<std::size_t>(target(h))];
        if (of_target == -1) {
          of_target = number;
          open.push_back(target(h));
        }
        h = clockwise(h);
      } while (h != first);
    }
    ++number;
  }
  return result;
}

std::vector<int> Map::change(const EventText& event) {
  std::vector<int> changed, come, named;
  for (const auto& [u, v] : event.removed) {
    const int h = find(u, v);
    if (h == -1) throw Rejected("the " + edge_in_words(u, v) + " that goes is not there");
    for (const int g : {h, twin(h)}) remove(g, changed);
    --edges_;
  }
  for (const auto& [u, v, w, x] : event.added) {
    if (u == v || find(u, v) != -1)
      throw Rejected("the " + edge_in_words(u, v) + " that comes is there already");
    const int h = make(u, v);
    for (const int g : {h, twin(h)}) half(g).is_there = true;
    ++edges_;
    come.push_back(h), come.push_back(twin(h));
  }
  for (const auto& [u, v, w, x] : event.added) {
    for (const auto& [from, to] : {Edge(u, x), Edge(v, w)}) {
      named.push_back(find(from, to));
      if (named.back() == -1)
        throw Rejected("the " + edge_in_words(from, to) + ", next to one that comes, is not there");
    }
  }
  place(come, named, changed);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

void Map::remove(int h, std::vector<int>& changed) {
  const int before = counter_clockwise(h), after = clockwise(h);
  half(h).is_there = false;
  int& first = first_[static_cast<std::size_t>(origin(h))];
  first = after == h ? -1 : after;
  link(before, after);
  changed.push_back(h);
  changed.push_back(after);
}

// Each half-edge that comes goes directly before the one that is named.
void Map::place(const std::vector<int>& come, const std::vector<int>& named,
                std::vector<int>& changed) {
  std::unordered_map<int, int> before;  // of a half-edge, the new one directly before it
  for (std::size_t i = 0; i < come.size(); ++i)
    if (!before.emplace(named[i], come[i]).second)
      throw Rejected("two edges come directly before the " +
                     edge_in_words(origin(named[i]), target(named[i])));
  const std::unordered_set<int> is_new(come.begin(), come.end());
  std::unordered_set<int> open = is_new;
  const auto put = [&](int h, int here) {
    link(h, here);
    open.erase(h);
    changed.push_back(h);
    changed.push_back(here);
  };
  for (const int after : named) {
    if (is_new.count(after) > 0) continue;
    int here = after;  // what stays, then what comes before it, and so on
    for (auto found = before.find(here); found != before.end(); found = before.find(here)) {
      link(counter_clockwise(here), found->second);
      put(found->second, here);
      here = found->second;
    }
  }
  // At a vertex at which nothing stays, what comes is one cycle.
  for (std::size_t i = 0; i < come.size(); ++i) {
    if (open.count(come[i]) == 0) continue;
    int& first = first_[static_cast<std::size_t>(origin(come[i]))];
    if (first != -1)
      throw Rejected("the edges that come to vertex " + std::to_string(origin(come[i])) +
                     " have no place");
    first = come[i];
    int here = first;
    do {
      put(before.at(here), here);
      here = before.at(here);
    } while (here != first);
  }
}

}  // namespace proof
