#include "groups.hpp"

#include "faults.hpp"
#include "reading.hpp"

namespace proof {

namespace {

using NumberOf = std::unordered_map<std::string, int>;

// The bodies that a text stands for: the one with this name, or all that a pattern matches.
std::set<int> bodies_of(const Json& json, const NumberOf& number_of) {
  if (json.kind != Json::Kind::text)
    throw NoProof("ignoring: a group has something that is no name");
  const std::string& text = json.text;
  const auto named = number_of.find(text);
  if (named != number_of.end()) return {named->second};
  if (text.empty() || text.back() != '*') throw NoProof("ignoring: there is no body " + text);
  const std::string_view beginning = std::string_view(text).substr(0, text.size() - 1);
  spend(static_cast<double>(number_of.size()));
  std::set<int> matching;
  for (const auto& [name, number] : number_of)
    if (std::string_view(name).substr(0, beginning.size()) == beginning) matching.insert(number);
  if (matching.empty()) throw NoProof("ignoring: no body matches " + text);
  spend(1000 * static_cast<double>(matching.size()));  // a short pattern may stand for many bodies
  return matching;
}

}  // namespace

Groups::Groups(const Json& json, const NumberOf& number_of) : groups_of_(number_of.size()) {
  for (const Json& group : list(&json)) {
    std::set<int> bodies;
    for (const Json& text : list(&group)) {
      const std::set<int> some = bodies_of(text, number_of);
      bodies.insert(some.begin(), some.end());
    }
    if (bodies.size() < 2) throw NoProof("ignoring: a group of fewer than two bodies");
    for (const int i : bodies) groups_of_[static_cast<std::size_t>(i)].insert(count_);
    ++count_;
  }
}

bool Groups::do_count(int i, int j) const {
  const auto& one = groups_of_[static_cast<std::size_t>(i)];
  const auto& other = groups_of_[static_cast<std::size_t>(j)];
  spend(4 * static_cast<double>(1 + one.size()));
  for (const std::size_t group : one)
    if (other.count(group) > 0) return false;
  return true;
}

}  // namespace proof
