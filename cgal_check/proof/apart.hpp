// Certificates that bodies stay apart: docs/proofs.md, Certificates.
#pragma once

#include <string>

#include "scene.hpp"
#include "text.hpp"

namespace proof {

struct Statement {
  std::string text;        // in words
  Rational until;          // the time up to which something is proved
  Rational low;            // up to which bodies are apart
  bool has_contact = false;  // in (low, until], of two bodies without a distance
  bool is_of_all = false;  // of all pairs, from the start of the scene
  bool is_whole = false;   // and up to its end, or to a contact
};

// Throws Rejected, with the number of the line.
Statement check_apart(const Scene& scene, const ApartText& text);

// How an answer of `exactpt collide --json` differs from the statement; "" if it does not.
std::string difference(const Statement& statement, const std::string& answer);

}  // namespace proof
