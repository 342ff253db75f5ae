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

// The budget of work is used up: exit code 4.
struct Exhausted : std::runtime_error {
  Exhausted() : std::runtime_error("the budget of work is used up (see --work)") {}
};

// What may still be done, in products of two words of 64 bits, as they are estimated.
inline double work_left = 0;

inline double usual_work(std::size_t bytes) { return 1e9 + 1e3 * static_cast<double>(bytes); }

inline void spend(double products) {
  work_left -= products;
  if (work_left < 0) throw Exhausted();
}

}  // namespace proof
