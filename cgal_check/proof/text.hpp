// The text of a proof: its lines, in the words of the format. Knows nothing of geometry.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "numbers.hpp"

namespace proof {

struct TimeText {
  Rational low, high;
  std::vector<Integer> coefficients;  // of NAME, constant term first
  std::vector<int> vertices;          // of NAME, two or three; neither may be there
};

using Edge = std::pair<int, int>;

struct FaceText {
  std::size_t line;
  std::vector<int> vertices;
};

struct EventText {
  std::size_t line;
  TimeText time;
  std::vector<Edge> removed;
  std::vector<std::array<int, 4>> added;  // u v w x
  std::vector<Edge> renewed;
};

struct ContactText {
  enum class Kind { edge, vertex, inside, crossing };
  Kind kind;
  TimeText time;
  int vertex;  // of a crossing: the first end of the first edge
  Edge edge;   // or: the other vertex; the body; the second edge
  int end;     // of a crossing: the second end of the first edge
};

struct ProofText {
  std::string hash;
  Rational start, end;
  std::size_t span_line = 0;
  std::vector<FaceText> faces;
  std::vector<EventText> events;
  std::size_t last_line = 0;
  std::optional<ContactText> contact;  // or "none"
};

// A certificate that bodies stay apart.
struct ChoiceText {
  std::size_t line;
  bool is_group;  // "ignoring", else "between"
  std::vector<int> bodies;
};

struct NodeText {
  std::size_t line;
  char kind;          // of a line, a time or items: c, t or s
  Integer x, y;       // the direction of a line
  Rational c, v;      // the place and speed of a line; the time
  bool has_time = false;
  int body = -1, item = -1;
};

struct ApartText {
  std::string hash;
  Rational start, end, distance;
  std::size_t span_line = 0, distance_line = 0, last_line = 0;
  std::vector<ChoiceText> choices;
  std::vector<NodeText> nodes;
  std::string kind;             // of the last line
  std::vector<Rational> times;  // of a contact: one, or two
  int first = -1, second = -1;
};

// Whether a file begins as a certificate does.
bool is_certificate(const std::string& bytes);

// Throw NoProof, with the number of the line, if it is not in the format.
ApartText parse_certificate(const std::string& bytes);
ProofText parse_proof(const std::string& bytes);

}  // namespace proof
