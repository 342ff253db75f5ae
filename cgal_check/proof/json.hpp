// JSON values, every number as it was written.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace proof {

struct Json {
  enum class Kind { null, boolean, number, text, list, object };

  Kind kind = Kind::null;
  bool truth = false;
  std::string text;  // of a text, or the characters of a number
  std::vector<Json> items;
  std::vector<std::pair<std::string, Json>> members;

  const Json* find(std::string_view key) const;  // null if there is no such member
};

// Throws NoProof: not JSON, a key that is there twice, or nested too deeply.
Json parse_json(const std::string& text);

}  // namespace proof
