// Certificates that bodies stay apart: docs/proofs.md, Certificates.
#pragma once

#include <string>

#include "scene.hpp"
#include "text.hpp"

namespace proof {

struct Statement {
  std::string text;        // in words
  Rational until;          // the time up to which something is proved
  bool is_of_all = false;  // of all pairs, from the start of the scene
  bool is_whole = false;   // and up to its end, or to a contact
};

// Throws Rejected, with the number of the line.
Statement check_apart(const Scene& scene, const ApartText& text);

}  // namespace proof
