#include "clusters.hpp"

#include <algorithm>
#include <unordered_map>

#include "faults.hpp"

namespace proof {

namespace {

struct Cluster {
  std::vector<int> vertices;
  std::vector<int> edges;  // those of bodies, as half-edges
};

// Faces and what they consist of; `face` tells of half-edges in which of these they are.
struct Faces {
  std::unordered_map<int, int> face;
  std::vector<std::vector<int>> cycles;
};

Faces faces_of(const Map& map, const std::vector<int>& halves) {
  Faces faces;
  for (const int h : halves) {
    if (faces.face.count(h) > 0) continue;
    faces.cycles.push_back(map.face(h));
    for (const int g : faces.cycles.back())
      faces.face[g] = static_cast<int>(faces.cycles.size()) - 1;
  }
  return faces;
}

std::vector<Cluster> clusters_of(const Scene& scene, const Map& map, const Faces& faces) {
  std::vector<Cluster> clusters;
  std::vector<bool> seen(faces.cycles.size());
  for (std::size_t i = 0; i < faces.cycles.size(); ++i) {
    if (seen[i]) continue;
    Cluster cluster;
    std::vector<std::size_t> open{i};
    seen[i] = true;
    while (!open.empty()) {
      const std::size_t face = open.back();
      open.pop_back();
      for (const int h : faces.cycles[face]) {
        cluster.vertices.push_back(map.origin(h));
        if (scene.is_body_edge(map.origin(h), map.target(h))) {
          cluster.edges.push_back(std::min(h, Map::twin(h)));
          continue;
        }
        const auto beyond = faces.face.find(Map::twin(h));
        if (beyond == faces.face.end() || seen[static_cast<std::size_t>(beyond->second)]) continue;
        seen[static_cast<std::size_t>(beyond->second)] = true;
        open.push_back(static_cast<std::size_t>(beyond->second));
      }
    }
    for (std::vector<int>* all : {&cluster.vertices, &cluster.edges}) {
      std::sort(all->begin(), all->end());
      all->erase(std::unique(all->begin(), all->end()), all->end());
    }
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

// A vertex or a body edge, from the left to the right.
struct Item {
  double left, right, bottom, top;
  int vertex, half;  // one of them is -1

  bool is_beside(const Item& other) const { return !(bottom <= other.top && other.bottom <= top); }
};

Item item(const Map& map, Predicates& predicates, int vertex, int half, const Time& t) {
  const Predicates::Box& p = predicates.box(half < 0 ? vertex : map.origin(half), t);
  const Predicates::Box& q = predicates.box(half < 0 ? vertex : map.target(half), t);
  return {std::min(p.x.inf(), q.x.inf()), std::max(p.x.sup(), q.x.sup()),
          std::min(p.y.inf(), q.y.inf()), std::max(p.y.sup(), q.y.sup()), vertex, half};
}

void check_pair(const Map& map, Predicates& predicates, const Item& a, const Item& b,
                const Time& t) {
  if (a.vertex < 0 && b.vertex < 0) return;
  if (a.is_beside(b)) return;
  if (a.vertex >= 0 && b.vertex >= 0) {
    if (predicates.coincide(a.vertex, b.vertex, t))
      throw Rejected("vertices " + std::to_string(std::min(a.vertex, b.vertex)) + " and " +
                     std::to_string(std::max(a.vertex, b.vertex)) + " coincide at t = " +
                     t.in_words());
    return;
  }
  const int v = std::max(a.vertex, b.vertex), h = std::max(a.half, b.half);
  const int p = map.origin(h), q = map.target(h);
  if (v != p && v != q && predicates.is_on(v, p, q, t))
    throw Rejected("vertex " + std::to_string(v) + " is on the edge " +
                   std::to_string(std::min(p, q)) + " " + std::to_string(std::max(p, q)) +
                   " at t = " + t.in_words());
}

// A sweep from the left to the right over boxes.
void check(const Map& map, Predicates& predicates, const Cluster& cluster, const Time& t) {
  std::vector<Item> items;
  for (const int v : cluster.vertices) items.push_back(item(map, predicates, v, -1, t));
  for (const int h : cluster.edges) items.push_back(item(map, predicates, -1, h, t));
  std::sort(items.begin(), items.end(),
            [](const Item& a, const Item& b) { return a.left < b.left; });
  std::vector<Item> open;
  for (const Item& here : items) {
    open.erase(std::remove_if(open.begin(), open.end(),
                              [&](const Item& past) { return past.right < here.left; }),
               open.end());
    for (const Item& other : open) check_pair(map, predicates, other, here, t);
    open.push_back(here);
  }
}

}  // namespace

void check_clusters(const Scene& scene, const Map& map, Predicates& predicates,
                    const std::vector<int>& halves, const Time& t) {
  for (const Cluster& cluster : clusters_of(scene, map, faces_of(map, halves)))
    check(map, predicates, cluster, t);
}

}  // namespace proof
