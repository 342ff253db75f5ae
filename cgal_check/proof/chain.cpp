#include "chain.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <unordered_map>

#include "faults.hpp"
#include "sha256.hpp"
#include "statement.hpp"

namespace proof {

namespace {

std::vector<Place> places(const Scene& scene, const Body& body, const Rational& t) {
  std::vector<Place> result;
  for (int v = body.first; v < body.first + body.size; ++v)
    result.push_back(place(scene.path(v, Time(t)), t));
  return result;
}

bool are_alike(const Body& a, const Body& b) {
  const auto is_same = [&](const Ring& r, const Ring& s) {
    return r.first - a.first == s.first - b.first && r.size == s.size && r.is_hole == s.is_hole;
  };
  return a.size == b.size && a.is_polygon == b.is_polygon && a.rings.size() == b.rings.size() &&
         std::equal(a.rings.begin(), a.rings.end(), b.rings.begin(), is_same);
}

// The bodies of one scene that another one has not: " enters 'a', 'b'".
std::string others(const char* word, const Scene& one, const Scene& other) {
  std::set<std::string> known;
  for (const Body& body : other.bodies()) known.insert(body.name);
  std::string result;
  for (const Body& body : one.bodies())
    if (known.count(body.name) == 0)
      result += (result.empty() ? std::string(word) + " " : ", ") + quoted(body.name);
  return result;
}

}  // namespace

Chain::Chain(const std::string& folder) : folder_(folder), lines_{"exactpt-chain 1"} {
  std::error_code failure;
  std::set<unsigned long> numbers;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".proof" && is_integer(stem) && stem.size() <= 9 &&
        stem.front() >= '1')
      numbers.insert(std::stoul(stem));
  }
  if (failure) throw NoProof(quoted(folder) + " is no folder");
  if (numbers.count(1) == 0) throw NoProof(quoted(folder) + " has no 1.proof");
  if (*numbers.rbegin() != numbers.size()) throw Rejected("the numbers of the parts have a gap");
  size_ = numbers.size();
}

std::string Chain::path(std::size_t k, const std::string& end) const {
  return (std::filesystem::path(folder_) / ((k > 0 ? std::to_string(k) : "") + end)).string();
}

void Chain::add(Part part) {
  if (last_.empty())
    start_ = part.start;
  else
    check_seam(last_.back(), part);
  lines_.push_back(std::to_string(lines_.size()) + " " + part.scene_hash + " " + part.proof_hash +
                   " " + part.start.get_str() + " " + part.end.get_str() + " " +
                   sha256(lines_.back()));
  is_modelled_ = is_modelled_ || part.scene.is_modelled();
  last_.clear();
  last_.push_back(std::move(part));
}

void Chain::check_seam(const Part& before, const Part& after) {
  const std::string part = "part " + std::to_string(lines_.size());
  if (before.has_contact) throw Rejected(part + " comes after a contact");
  if (before.end != after.start) throw Rejected(part + " does not begin where the last one ends");
  const Rational& t = after.start;
  std::unordered_map<std::string, const Body*> known;
  for (const Body& body : before.scene.bodies()) known.emplace(body.name, &body);
  for (const Body& body : after.scene.bodies()) {
    const auto old = known.find(body.name);
    if (old != known.end() &&
        (!are_alike(*old->second, body) ||
         places(before.scene, *old->second, t) != places(after.scene, body, t)))
      throw Rejected(part + ": " + quoted(body.name) + " is not what or where it was");
  }
  const std::string come = others("enters", after.scene, before.scene);
  const std::string go = others("leaves", before.scene, after.scene);
  if (!come.empty() || !go.empty())
    seams_.push_back("at t = " + t.get_str() + " " + come +
                     (come.empty() || go.empty() ? "" : " and ") + go);
}

std::string Chain::manifest() const {
  std::string result;
  for (const std::string& line : lines_) result += line + "\n";
  return result;
}

std::string Chain::conclusion() const {
  const Part& last = last_.back();
  std::string said = last.conclusion;
  const std::string begin = "no contact in [";
  if (!last.has_contact)
    said = begin + start_.get_str() + said.substr(begin.size() + last.start.get_str().size());
  said = sha256(lines_.back()).substr(0, 16) + " along " + std::to_string(size_) +
         " parts from t = " + start_.get_str() + ": " + about(is_modelled_) + said;
  for (const std::string& seam : seams_) said += "; " + seam;
  return said;
}

}  // namespace proof
