// A planar map without coordinates: edges around vertices, and faces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "text.hpp"

namespace proof {

// Half-edges are numbered, the two of an edge 2 k and 2 k + 1. An edge that goes keeps its
// numbers, and has them again if it comes back.
class Map {
 public:
  struct Half {
    int origin;
    int clockwise = -1, counter_clockwise = -1;  // the next ones around the origin
    bool is_there = false;
  };

  // Of all faces. Throws Rejected.
  Map(int vertices, const std::vector<FaceText>& faces);

  static int twin(int h) { return h ^ 1; }
  int origin(int h) const { return half(h).origin; }
  int target(int h) const { return half(twin(h)).origin; }
  int next(int h) const { return half(twin(h)).clockwise; }  // around its face
  int clockwise(int h) const { return half(h).clockwise; }
  int counter_clockwise(int h) const { return half(h).counter_clockwise; }
  bool is_there(int h) const { return half(h).is_there; }
  int halves() const { return static_cast<int>(halves_.size()); }
  std::size_t edges() const { return edges_; }
  int any(int v) const { return first_[static_cast<std::size_t>(v)]; }  // -1 if there is none

  // The half-edge from u to v, or -1 if it is not there.
  int find(int u, int v) const;

  std::vector<int> face(int h) const;

  bool are_joined(int u, int v) const;  // by a path
  std::vector<int> components() const;  // of each vertex the number of its component

  // Changes the map. Throws Rejected. Returns the half-edges of which another one, or none, is
  // before them counter-clockwise now; those that went among them.
  std::vector<int> change(const EventText& event);

 private:
  const Half& half(int h) const { return halves_[static_cast<std::size_t>(h)]; }
  Half& half(int h) { return halves_[static_cast<std::size_t>(h)]; }
  int make(int u, int v);  // the half-edge from u to v, new unless it has a number
  void link(int before, int after);
  void remove(int h, std::vector<int>& changed);
  void place(const std::vector<int>& come, const std::vector<int>& named,
             std::vector<int>& changed);

  std::vector<Half> halves_;
  std::vector<int> first_;
  std::unordered_map<std::uint64_t, int> numbers_;
  std::size_t edges_ = 0;
};

}  // namespace proof
