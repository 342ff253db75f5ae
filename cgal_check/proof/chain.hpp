// Proofs of the parts of one run, in a folder: 1.proof with 1.scene.json, and so on.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene.hpp"

namespace proof {

// A part that has been verified by itself.
struct Part {
  Scene scene;
  std::string scene_hash, proof_hash;
  Rational start, end;
  bool has_contact;
  std::string conclusion;
};

class Chain {
 public:
  // Of a folder. Throws NoProof if it has no parts, Rejected if their numbers have a gap.
  explicit Chain(const std::string& folder);

  std::size_t size() const { return size_; }
  std::string path(std::size_t k, const std::string& end) const;  // of part k; 0 for none

  // Throws Rejected if the part does not go on where the last one ended.
  void add(Part part);

  // After all parts: the lines of run.chain, and what has been proved.
  std::string manifest() const;
  std::string conclusion() const;

 private:
  void check_seam(const Part& before, const Part& after);

  std::string folder_;
  std::size_t size_ = 0;
  std::vector<Part> last_;          // none or one
  std::vector<std::string> lines_;  // of run.chain
  std::vector<std::string> seams_;  // at which bodies come or go
  bool is_modelled_ = false;        // in one of the parts
  Rational start_;
};

}  // namespace proof
