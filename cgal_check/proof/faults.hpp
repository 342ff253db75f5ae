// What ends the verification of a proof.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace proof {

// A file is no scene, or no proof of this scene: exit code 2.
struct NoProof : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A line of the proof does not hold: exit code 1.
struct Rejected : std::runtime_error {
  explicit Rejected(const std::string& why, std::size_t line_ = 0)
      : std::runtime_error(why), line(line_) {}

  std::size_t line;  // 0: the line in hand
};

}  // namespace proof
