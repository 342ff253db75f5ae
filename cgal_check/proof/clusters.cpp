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

// A sweep from the left to the right over boxes: of a vertex and another one, or of a vertex and
// an edge that does not end there, which may touch.
template <class Pair>
void sweep(const Map& map, Predicates& predicates, const Cluster& cluster, const Time& t,
           Pair pair) {
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
    spend(static_cast<double>(open.size()));
    for (const Item& other : open) {
      if ((here.vertex < 0 && other.vertex < 0) || here.is_beside(other)) continue;
      const int v = std::max(here.vertex, other.vertex), h = std::max(here.half, other.half);
      if (h < 0)
        pair(std::min(here.vertex, other.vertex), v, -1);
      else if (v != map.origin(h) && v != map.target(h))
        pair(v, -1, h);
    }
    open.push_back(here);
  }
}

void check(const Map& map, Predicates& predicates, const Cluster& cluster, const Time& t) {
  sweep(map, predicates, cluster, t, [&](int u, int v, int h) {
    if (h < 0 && predicates.coincide(u, v, t))
      throw Rejected("vertices " + std::to_string(u) + " and " + std::to_string(v) +
                     " coincide at t = " + t.in_words());
    if (h < 0) return;
    const int p = map.origin(h), q = map.target(h);
    if (predicates.is_on(u, p, q, t))
      throw Rejected("vertex " + std::to_string(u) + " is on the edge " +
                     std::to_string(std::min(p, q)) + " " + std::to_string(std::max(p, q)) +
                     " at t = " + t.in_words());
  });
}

}  // namespace

void check_clusters(const Scene& scene, const Map& map, Predicates& predicates,
                    const std::vector<int>& halves, const Time& t) {
  for (const Cluster& cluster : clusters_of(scene, map, faces_of(map, halves)))
    check(map, predicates, cluster, t);
}

std::set<Incidence> incidences(const Scene& scene, const Map& map, Predicates& predicates,
                               const std::vector<int>& halves, const Time& t) {
  Cluster all;
  for (const Cluster& cluster : clusters_of(scene, map, faces_of(map, halves))) {
    all.vertices.insert(all.vertices.end(), cluster.vertices.begin(), cluster.vertices.end());
    all.edges.insert(all.edges.end(), cluster.edges.begin(), cluster.edges.end());
  }
  for (std::vector<int>* each : {&all.vertices, &all.edges}) {
    std::sort(each->begin(), each->end());
    each->erase(std::unique(each->begin(), each->end()), each->end());
  }
  std::set<Incidence> found;
  sweep(map, predicates, all, t, [&](int u, int v, int h) {
    if (h < 0) {
      if (predicates.coincide(u, v, t)) found.insert({u, false, v});
      return;
    }
    const int p = map.origin(h), q = map.target(h);
    if (predicates.is_on(u, p, q, t) && !predicates.coincide(u, p, t) &&
        !predicates.coincide(u, q, t))
      found.insert({u, true, scene.first_of_edge(p, q)});
  });
  return found;
}

}  // namespace proof
