// Bodies of a scene that ignore each other.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "json.hpp"

namespace proof {

class Groups {
 public:
  // None at first, of so many bodies.
  explicit Groups(std::size_t bodies = 0) : groups_of_(bodies) {}

  // Of the value of the key "ignoring"; the bodies by their names. Throws NoProof.
  Groups(const Json& json, const std::unordered_map<std::string, int>& number_of);

  bool is_empty() const { return count_ == 0; }

  // Whether two bodies are a pair that counts: no group has both. A body may be in several groups.
  bool do_count(int i, int j) const;

 private:
  std::size_t count_ = 0;
  std::vector<std::set<std::size_t>> groups_of_;  // of each body, the numbers of its groups
};

}  // namespace proof
