#include "text.hpp"

#include <algorithm>
#include <string_view>

#include "faults.hpp"

namespace proof {

namespace {

constexpr std::size_t most_digits = 10'000;      // of a numerator or denominator
constexpr std::size_t most_in_time = 20'000;     // digits of all coefficients of a time
constexpr std::size_t most_terms = 193;          // of the polynomial of a time
constexpr std::size_t most_in_line = 100'000'000;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// A piece of the file, made fit to stand in a one-line message.
std::string shown(std::string_view text) {
  constexpr std::size_t limit = 40;
  std::string result;
  for (const char c : text.substr(0, limit)) result.push_back(c >= ' ' && c <= '~' ? c : '?');
  return text.size() > limit ? result + "..." : result;
}

// The words of a line.
class Words {
 public:
  Words(std::size_t number, std::string_view line) : number_(number) {
    for (std::size_t i = 0; i < line.size();) {
      const std::size_t begin = i;
      while (i < line.size() && !is_space(line[i])) ++i;
      if (i > begin) words_.push_back(line.substr(begin, i - begin));
      while (i < line.size() && is_space(line[i])) ++i;
    }
  }

  std::size_t number() const { return number_; }
  bool at_end() const { return next_ == words_.size(); }
  std::string_view look() const { return at_end() ? std::string_view{} : words_[next_]; }

  [[noreturn]] void fault(const std::string& why) const {
    throw NoProof("line " + std::to_string(number_) + ": " + why);
  }

  std::string_view word() {
    if (at_end()) fault("the line is not complete");
    return words_[next_++];
  }

  bool accept(std::string_view expected) {
    if (look() != expected) return false;
    ++next_;
    return true;
  }

  void end() const {
    if (!at_end()) fault("too many words: " + shown(look()));
  }

  Rational rational() {
    const std::string_view text = word();
    if (!is_fraction(text)) fault("not a number: " + shown(text));
    const std::string_view over = text.substr(0, text.find('/'));
    const std::size_t digits = over.size() - (over.front() == '-');
    if (digits > most_digits || text.size() - over.size() > most_digits + 1)
      fault("a number of more than 10,000 digits");
    return fraction(text);
  }

  Integer integer() {
    const std::string_view text = look();
    if (!is_integer(text)) fault("not an integer: " + shown(text));
    return rational().get_num();
  }

  int index() {
    const std::string_view text = word();
    if (text.size() > 9 || text.front() == '-' || !is_integer(text))
      fault("not the number of a vertex or a body: " + shown(text));
    return std::stoi(std::string(text));
  }

  Edge edge() {
    const int u = index();
    return {u, index()};
  }

 private:
  std::size_t number_;
  std::vector<std::string_view> words_;
  std::size_t next_ = 0;
};

TimeText read_time(Words& words) {
  TimeText time;
  time.low = words.rational();
  time.high = words.rational();
  if (words.accept("@")) {
    while (time.vertices.size() < 3 && !words.at_end() && is_integer(words.look()))
      time.vertices.push_back(words.index());
    if (time.vertices.size() < 2) words.fault("a time is named by two or three vertices");
    return time;
  }
  std::size_t digits = 0;
  while (!words.at_end() && is_integer(words.look())) {
    const std::string_view word = words.word();
    digits += word.size() - (word.front() == '-');
    if (digits > most_in_time || time.coefficients.size() == most_terms)
      words.fault("a polynomial of too many digits or too high a degree");
    time.coefficients.emplace_back(std::string(word), 10);
  }
  return time;
}

EventText read_event(Words& words) {
  EventText event{words.number(), read_time(words), {}, {}, {}};
  while (!words.at_end()) {
    if (words.accept("-")) {
      event.removed.push_back(words.edge());
    } else if (words.accept("=")) {
      event.renewed.push_back(words.edge());
    } else if (words.accept("+")) {
      const Edge edge = words.edge();
      const Edge after = words.edge();
      event.added.push_back({edge.first, edge.second, after.first, after.second});
    } else {
      words.fault("not an item: " + shown(words.look()));
    }
  }
  return event;
}

ContactText read_contact(Words& words) {
  using Kind = ContactText::Kind;
  ContactText contact{Kind::vertex, read_time(words), -1, {-1, -1}, -1};
  if (words.accept("edge")) {
    contact.kind = Kind::crossing;
    contact.vertex = words.index();
    contact.end = words.index();
    if (!words.accept("edge")) words.fault("an edge is in contact with an edge");
    contact.edge = words.edge();
  } else if (words.accept("vertex")) {
    contact.vertex = words.index();
    if (words.accept("edge")) {
      contact.kind = Kind::edge;
      contact.edge = words.edge();
    } else if (words.accept("inside")) {
      contact.kind = Kind::inside;
      contact.edge.first = words.index();
    } else if (words.accept("vertex")) {
      contact.edge.first = words.index();
    } else {
      words.fault("not a contact: " + shown(words.look()));
    }
  } else {
    words.fault("not a contact: " + shown(words.look()));
  }
  return contact;
}

bool is_utf8(const std::string& bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const auto c = static_cast<unsigned char>(bytes[i]);
    const int more = c < 0x80 ? 0 : c >= 0xc2 && c < 0xe0 ? 1 : c >= 0xe0 && c < 0xf0 ? 2
                     : c >= 0xf0 && c < 0xf5 ? 3 : -1;
    if (more < 0) return false;
    // Shorter forms of what follows, surrogates, and what is above U+10FFFF.
    const unsigned char least = c == 0xe0 ? 0xa0 : c == 0xf0 ? 0x90 : 0x80;
    const unsigned char most = c == 0xed ? 0x9f : c == 0xf4 ? 0x8f : 0xbf;
    for (int k = 0; k < more; ++k) {
      if (++i == bytes.size()) return false;
      const auto next = static_cast<unsigned char>(bytes[i]);
      if (next < (k == 0 ? least : 0x80) || next > (k == 0 ? most : 0xbf)) return false;
    }
    ++i;
  }
  return true;
}

// The lines that are neither empty nor remarks.
std::vector<Words> lines(const std::string& bytes) {
  std::vector<Words> result;
  std::size_t number = 1;
  for (std::size_t i = 0; i < bytes.size(); ++number) {
    const std::size_t end = std::min(bytes.find('\n', i), bytes.size());
    const std::string_view line = std::string_view(bytes).substr(i, end - i);
    if (line.size() > most_in_line) throw NoProof("a line is too long");
    Words words(number, line);
    if (!words.at_end() && line.front() != '#') result.push_back(std::move(words));
    i = end + 1;
  }
  return result;
}

void expect(Words& words, std::initializer_list<std::string_view> expected) {
  for (const std::string_view word : expected)
    if (!words.accept(word)) words.fault("expected '" + std::string(word) + "'");
}

}  // namespace

bool is_certificate(const std::string& bytes) {
  const std::vector<Words> all = lines(bytes);
  return !all.empty() && all[0].look() == "exactpt-apart";
}

ApartText parse_certificate(const std::string& bytes) {
  std::vector<Words> all = lines(bytes);
  if (!is_utf8(bytes)) throw NoProof("the file is not UTF-8");
  if (all.size() < 4) throw NoProof("the certificate is not complete");
  ApartText text;
  expect(all[0], {"exactpt-apart", "1"});
  expect(all[1], {"scene", "sha256"});
  text.hash = all[1].word();
  expect(all[2], {"span"});
  text.span_line = all[2].number();
  text.start = all[2].rational();
  text.end = all[2].rational();
  int stage = 0;  // lines are in this order: between, ignoring, distance, nodes
  const auto reach = [&](Words& words, int next) {
    if (stage > next || (stage == next && next == 2)) words.fault("a line is not in its place");
    stage = next;
  };
  for (std::size_t i = 3; i + 1 < all.size(); ++i) {
    Words& words = all[i];
    const std::string kind(words.word());
    if (kind == "between" || kind == "ignoring") {
      reach(words, kind == "between" ? 0 : 1);
      ChoiceText choice{words.number(), kind == "ignoring", {words.index(), words.index()}};
      while (choice.is_group && !words.at_end()) choice.bodies.push_back(words.index());
      text.choices.push_back(std::move(choice));
    } else if (kind == "distance") {
      reach(words, 2);
      text.distance_line = words.number();
      text.distance = words.rational();
    } else if (kind == "c" || kind == "t" || kind == "s") {
      reach(words, 3);
      NodeText node{words.number(), kind[0], 0, 0, 0, 0};
      if (kind == "c") {
        node.x = words.integer();
        node.y = words.integer();
        node.c = words.rational();
        if (!words.at_end()) node.v = words.rational();
      } else if (kind == "s") {
        node.body = words.index();
        node.item = words.index();
      } else if (!words.at_end()) {
        node.has_time = true;
        node.c = words.rational();
      }
      text.nodes.push_back(std::move(node));
    } else {
      words.fault("not a line of a certificate: " + shown(kind));
    }
  }
  Words& last = all.back();
  text.last_line = last.number();
  text.kind = std::string(last.word());
  if (text.kind == "meet" || text.kind == "inside" || text.kind == "cross") {
    text.times.push_back(last.rational());
    if (text.kind == "cross") text.times.push_back(last.rational());
    text.first = last.index();
    text.second = last.index();
  } else if (text.kind != "none") {
    last.fault("the last line is neither a contact nor 'none'");
  }
  for (const Words& words : all) words.end();
  return text;
}

ProofText parse_proof(const std::string& bytes) {
  std::vector<Words> all = lines(bytes);
  if (all.empty() || !is_utf8(bytes)) throw NoProof("the file is no proof");
  if (!all[0].accept("exactpt-proof") || !all[0].accept("1") || !all[0].at_end())
    throw NoProof("the file is no proof: it does not begin with 'exactpt-proof 1'");
  if (all.size() < 4) throw NoProof("the proof is not complete");
  ProofText proof;
  expect(all[1], {"scene", "sha256"});
  proof.hash = all[1].word();
  expect(all[2], {"span"});
  proof.span_line = all[2].number();
  proof.start = all[2].rational();
  proof.end = all[2].rational();
  for (std::size_t i = 3; i < all.size(); ++i) {
    Words& words = all[i];
    const bool is_last = i + 1 == all.size();
    proof.last_line = words.number();
    if (words.accept("none") || words.look() == "contact") {
      if (!is_last) words.fault("nothing follows a contact or 'none'");
      if (words.accept("contact")) proof.contact = read_contact(words);
    } else if (is_last) {
      words.fault("the last line is neither a contact nor 'none'");
    } else if (words.accept("event")) {
      proof.events.push_back(read_event(words));
    } else if (words.accept("face") || words.accept("inside") || words.accept("outer")) {
      if (!proof.events.empty()) words.fault("faces come before events");
      proof.faces.push_back({words.number(), {words.index()}});
      while (!words.at_end()) proof.faces.back().vertices.push_back(words.index());
    } else {
      words.fault("not a line of a proof: " + shown(words.look()));
    }
  }
  for (const Words& words : all) words.end();
  return proof;
}

}  // namespace proof
