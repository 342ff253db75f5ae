#include "verify.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <istream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "apart.hpp"
#include "chain.hpp"
#include "checker.hpp"
#include "faults.hpp"
#include "sha256.hpp"
#include "statement.hpp"

namespace proof {

namespace {

constexpr std::size_t most_jobs = 256;
constexpr std::size_t most_bytes = 1'000'000'000;
constexpr const char* usage =
    "usage: cgal_check proof SCENE PROOF [--until T | --partial | --expect ANSWER] [--work N] "
    "[--jobs N], or proof FOLDER";

struct Call {
  std::vector<std::string> paths;
  std::size_t jobs = 1;
  bool is_partial = false;        // whether a proof may end before the span of the scene
  std::optional<Rational> until;  // the time before which it may not end
  std::string expected;           // the path of an answer
  std::optional<double> work;  // for all parts
};

struct Verdict {
  int code = 0;
  std::string text;        // what is proved, or what went wrong
  std::string difference;  // from the answer that is expected
  std::size_t number = 0, line = 0;  // of a failure
};

std::size_t number_of(const std::string& option, const std::string& word, std::size_t digits) {
  if (!is_integer(word) || word.front() == '-' || word.size() > digits)
    throw NoProof(option + ": not a number: " + quoted(word));
  return std::stoul(word);
}

// Whether a fraction has at most 10,000 digits above and below, as in a proof.
bool is_short(const std::string& text) {
  const std::size_t over = std::min(text.find('/'), text.size());
  return over - (text.front() == '-') <= 10'000 && text.size() - over <= 10'001;
}

Call read_call(const std::vector<std::string>& words) {
  Call call;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& option = words[i];
    if (option == "--partial") {
      call.is_partial = true;
    } else if (option.substr(0, 2) != "--") {
      call.paths.push_back(option);
    } else {
      const std::string value = ++i < words.size() ? words[i] : "";
      if (option == "--jobs") {
        call.jobs = number_of(option, value, 3);
        if (call.jobs == 0 || call.jobs > most_jobs)
          throw NoProof("--jobs: a number from 1 to " + std::to_string(most_jobs));
      } else if (option == "--work") {
        call.work = static_cast<double>(number_of(option, value, 18));
      } else if (option == "--until" && is_fraction(value) && is_short(value)) {
        call.until = fraction(value);
      } else if (option == "--expect" && !value.empty()) {
        call.expected = value;
      } else {
        throw NoProof(usage);
      }
    }
  }
  // A certificate may be of some pairs, and an answer does not say so.
  const int wishes = call.until.has_value() + (call.is_partial || !call.expected.empty());
  const std::size_t count = call.paths.size();
  if (count == 0 || count > 2 || wishes > 1 || (count == 1 && !call.expected.empty()))
    throw NoProof(usage);
  return call;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  file.exceptions(std::ios::badbit);
  try {
    if (file) std::copy(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>(),
                        std::ostreambuf_iterator<char>(bytes));
  } catch (const std::ios::failure&) {  // a directory
    file.setstate(std::ios::failbit);
  }
  if (!file) throw NoProof(path + " cannot be read");
  if (static_cast<std::size_t>(bytes.tellp()) > most_bytes) throw NoProof(path + " is too long");
  return bytes.str();
}

Verdict verdict(Scene& scene, const ProofText& text, const std::string* answer, std::size_t share,
                std::size_t shares) {
  try {
    Checker checker(scene, text, share, shares);
    const std::optional<Failure> failure = checker.run();
    if (failure) return {1, failure->why, "", failure->number, failure->line};
    return {0, checker.conclusion(), answer ? checker.difference(*answer) : "", 0, 0};
  } catch (const Exhausted& fault) {
    return {4, fault.what(), "", 0, 0};
  } catch (const NoProof& fault) {
    return {2, fault.what(), "", 0, 0};
  } catch (const std::exception& fault) {
    return {3, fault.what(), "", 0, 0};
  }
}

// A verdict as bytes through a pipe.
std::string packed(const Verdict& verdict) {
  return std::to_string(verdict.code) + " " + std::to_string(verdict.number) + " " +
         std::to_string(verdict.line) + "\n" + verdict.difference + "\n" + verdict.text;
}

Verdict unpacked(const std::string& bytes) {
  std::istringstream lines(bytes);
  Verdict verdict;
  std::string head;
  std::getline(lines, head);
  std::istringstream numbers(head);
  if (!(numbers >> verdict.code >> verdict.number >> verdict.line))
    return {3, "a process has ended too early", "", 0, 0};
  std::getline(lines, verdict.difference);
  std::getline(lines, verdict.text, '\0');
  return verdict;
}

std::string read_all(int file) {
  std::string bytes;
  char buffer[4096];
  for (ssize_t got = 1; got > 0;) {
    got = ::read(file, buffer, sizeof buffer);
    if (got > 0) bytes.append(buffer, static_cast<std::size_t>(got));
  }
  ::close(file);
  return bytes;
}

// A process for each share; they are started before the answers are read.
Verdict by_processes(Scene& scene, const ProofText& text, const std::string* answer,
                     std::size_t jobs) {
  std::vector<std::pair<pid_t, int>> children;
  for (std::size_t share = 0; share < jobs; ++share) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) {
      ::close(ends[0]);
      const std::string bytes = packed(verdict(scene, text, answer, share, jobs));
      for (std::size_t sent = 0; sent < bytes.size();) {
        const ssize_t put = ::write(ends[1], bytes.data() + sent, bytes.size() - sent);
        if (put <= 0) ::_exit(3);
        sent += static_cast<std::size_t>(put);
      }
      ::_exit(0);
    }
    ::close(ends[1]);
    children.emplace_back(child, ends[0]);
  }
  Verdict first;
  const auto is_before = [](const Verdict& a, const Verdict& b) {
    if (a.code != b.code) return a.code != 0 && (b.code == 0 || b.code == 1);
    return a.code == 1 && a.number < b.number;
  };
  for (std::size_t share = 0; share < jobs; ++share) {
    Verdict here = unpacked(read_all(children[share].second));
    ::waitpid(children[share].first, nullptr, 0);
    if (share == 0 || is_before(here, first)) first = std::move(here);
  }
  return first;
}

// A line without line breaks, in the printable characters of ASCII.
int answer(const std::string& text, int code) {
  std::string line;
  for (const char c : text) line += c >= ' ' && c <= '~' ? c : '?';
  std::puts(line.c_str());
  std::fflush(stdout);
  return code;
}

int answer_failure(const Verdict& found, const std::string& where) {
  const std::string end = found.text + where;
  if (found.code == 1) return answer("rejected: line " + std::to_string(found.line) + ": " + end, 1);
  if (found.code == 2) return answer("no proof: " + end, 2);
  if (found.code == 4) return answer("not decided: " + end, 4);
  return answer("error internal: " + end, 3);
}

// Whether less than what is wanted has been proved.
bool is_too_short(const Call& call, const Scene& scene, const ProofText& text) {
  return !text.contact && text.end < scene.end() && !call.is_partial && call.expected.empty() &&
         !(call.until && *call.until <= text.end);
}

int answer_too_short(const ProofText& text) {
  return answer("rejected: proved up to " + text.end.get_str() + " only (see --until, --partial)", 1);
}

// Scenes with a radius have certificates, and no proofs.
void refuse_radii(const Scene& scene) {
  for (const Body& body : scene.bodies())
    if (body.radius != 0) throw NoProof("the scene has a radius: no proof is possible");
}

// What is wrong with a proof by a tiling of this scene, whatever its lines are; empty if nothing.
std::string objection(const Scene& scene) {
  return scene.groups().is_empty()
             ? ""
             : "a proof by a tiling counts all pairs, this scene ignores some";
}

int verify_certificate(const Call& call, const std::string& scene_bytes, const std::string& bytes) {
  if (call.jobs != 1) throw NoProof(usage);
  const ApartText text = parse_certificate(bytes);
  const std::string hash = sha256(scene_bytes);
  if (text.hash != hash)
    throw NoProof("the certificate was made for a different scene: the hashes differ");
  const Scene scene(scene_bytes, false);
  const Statement found = check_apart(scene, text);
  const std::string proved =
      "accepted: " + hash.substr(0, 16) + " " + about(scene.is_modelled()) + found.text;
  const bool is_up_to = !call.expected.empty() || (call.until && *call.until <= found.until);
  const bool is_enough = found.is_whole || call.is_partial || (found.is_of_all && is_up_to);
  if (!is_enough)
    return answer("rejected: proved is only a part (see --until, --partial): " + proved, 1);
  if (!call.expected.empty()) {
    const std::string fault = difference(found, bytes_of(call.expected));
    if (!fault.empty())
      return answer("rejected: " + fault + " in " + quoted(call.expected) + "; proved is: " + proved, 1);
  }
  return answer(proved, 0);
}

constexpr const char* head_of_rows = "exactpt-apart-rows 1\n";

std::vector<std::string> lines_of(const std::string& bytes) {
  std::vector<std::string> result;
  for (std::size_t i = 0, end; (end = bytes.find('\n', i)) != std::string::npos; i = end + 1)
    result.push_back(bytes.substr(i, end - i));
  return result;
}

// Certificates of many scenes, a line each.
int verify_rows(const Call& call, const std::string& scene_bytes, const std::string& bytes) {
  if (!call.expected.empty() || call.jobs != 1) throw NoProof(usage);
  std::vector<std::string> scenes = lines_of(scene_bytes), rows = lines_of(bytes);
  const std::string hash = sha256(scene_bytes);
  if (bytes.back() != '\n' || (!scene_bytes.empty() && scene_bytes.back() != '\n'))
    throw NoProof("a last line without an end");
  if (rows.size() < 2 || rows[1] != "scenes sha256 " + hash)
    throw NoProof("the certificate was made for a different scene: the hashes differ");
  if (rows.size() != scenes.size() + 2) throw NoProof("the numbers of scenes and of rows differ");
  const char* kinds[] = {"no contact", "first contact", "contact at the start", "open"};
  std::size_t found[4] = {};
  bool is_modelled = false;  // in one of the scenes
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    if (k > 0 && scenes[k].compare(0, 3, "\xef\xbb\xbf") == 0)
      throw NoProof("a byte order mark that is not the beginning of the file");
    const Scene scene(scenes[k], false);
    is_modelled = is_modelled || scene.is_modelled();
    std::string& row = rows[k + 2];
    if (row == "open") {
      ++found[3];
      continue;
    }
    std::replace(row.begin(), row.end(), ';', '\n');
    const ApartText text = parse_certificate("exactpt-apart 1\nscene sha256 -\n" + row);
    const std::string where = "row " + std::to_string(k + 1) + ": ";
    try {
      if (scene.bodies().size() < 2 || text.distance != 0)
        throw Rejected("no contacts of two bodies");
      const Statement one = check_apart(scene, text);
      if (!one.is_whole) throw Rejected("only a part is proved: " + one.text);
      const std::string first = one.text.substr(0, one.text.find(' '));
      ++found[first == "no" ? 0 : first == "first" ? 1 : 2];
    } catch (const Rejected& fault) {
      throw Rejected(where + fault.what());
    }
  }
  std::string said;
  for (std::size_t i = 0; i < 4; ++i)
    if (found[i])
      said += (said.empty() ? "" : ", ") + (kinds[i] + (" in " + std::to_string(found[i])));
  const std::string text = "accepted: " + hash.substr(0, 16) + " " + about(is_modelled) +
                           std::to_string(scenes.size()) +
                           " rows, each of two or more bodies in the whole span: " + said;
  if (found[3] && !call.is_partial)
    return answer("rejected: proved is only a part (see --until, --partial): " + text, 1);
  return answer(text, 0);
}

int verify_pair(const Call& call) {
  const std::string scene_bytes = bytes_of(call.paths[0]), bytes = bytes_of(call.paths[1]);
  work_left = call.work.value_or(usual_work(scene_bytes.size() + bytes.size()));
  if (bytes.compare(0, 21, head_of_rows) == 0) return verify_rows(call, scene_bytes, bytes);
  if (is_certificate(bytes)) return verify_certificate(call, scene_bytes, bytes);
  if (call.is_partial && !call.expected.empty()) throw NoProof(usage);
  const ProofText text = parse_proof(bytes);
  const std::string hash = sha256(scene_bytes);
  if (text.hash != hash)
    throw NoProof("the proof is of another scene: the hash of its file is another one");
  Scene scene(scene_bytes);
  refuse_radii(scene);
  if (const std::string why = objection(scene); !why.empty()) throw Rejected(why);
  const std::string expected = call.expected.empty() ? "" : bytes_of(call.expected);
  const std::string* wanted = call.expected.empty() ? nullptr : &expected;
  const Verdict found = call.jobs == 1 ? verdict(scene, text, wanted, 0, 1)
                                       : by_processes(scene, text, wanted, call.jobs);
  if (found.code != 0) return answer_failure(found, "");
  if (!found.difference.empty())
    return answer("rejected: " + found.difference + " in " + quoted(call.expected) +
                      "; proved is: " + about(scene.is_modelled()) + found.text,
                  1);
  if (is_too_short(call, scene, text)) return answer_too_short(text);
  const std::string of_bodies = about(scene.is_modelled());
  return answer("accepted: " + hash.substr(0, 16) + " " + of_bodies + found.text, 0);
}

int verify_folder(const Call& call) {
  Chain chain(call.paths[0]);
  for (std::size_t k = 1; k <= chain.size(); ++k) {
    const std::string scene_bytes = bytes_of(chain.path(k, ".scene.json"));
    const std::string proof_bytes = bytes_of(chain.path(k, ".proof"));
    const std::string where = " (part " + std::to_string(k) + ")";
    if (!call.work) work_left = usual_work(scene_bytes.size() + proof_bytes.size());
    const ProofText text = parse_proof(proof_bytes);
    if (text.hash != sha256(scene_bytes)) throw NoProof("the proof is of another scene" + where);
    Scene scene(scene_bytes);
    refuse_radii(scene);
    if (const std::string why = objection(scene); !why.empty()) throw Rejected(why + where);
    const Verdict found = call.jobs == 1 ? verdict(scene, text, nullptr, 0, 1)
                                         : by_processes(scene, text, nullptr, call.jobs);
    if (found.code != 0) return answer_failure(found, where);
    if (k == chain.size() && is_too_short(call, scene, text)) return answer_too_short(text);
    chain.add({std::move(scene), sha256(scene_bytes), sha256(proof_bytes), text.start, text.end,
               text.contact.has_value(), found.text});
  }
  const std::string manifest = chain.path(0, "run.chain");
  if (std::filesystem::exists(manifest) && bytes_of(manifest) != chain.manifest())
    throw Rejected("the parts are not those of run.chain");
  return answer("accepted: " + chain.conclusion(), 0);
}

int verify(const Call& call) {
  work_left = call.work.value_or(0);
  return call.paths.size() == 1 ? verify_folder(call) : verify_pair(call);
}

int guarded(const std::function<int()>& verification) {
  try {
    return verification();
  } catch (const NoProof& fault) {
    return answer(std::string("no proof: ") + fault.what(), 2);
  } catch (const Rejected& fault) {
    const std::string where = fault.line ? "line " + std::to_string(fault.line) + ": " : "";
    return answer("rejected: " + where + fault.what(), 1);
  } catch (const Exhausted& fault) {
    return answer(std::string("not decided: ") + fault.what(), 4);
  } catch (const std::exception& fault) {
    return answer(std::string("error internal: ") + fault.what(), 3);
  }
}

}  // namespace

int verify(int count, const char* const* arguments) {
  return guarded([&] { return verify(read_call({arguments, arguments + count})); });
}

int verify_each(std::istream& calls) {
  Call call;
  call.is_partial = true;
  call.paths.resize(2);
  while (std::getline(calls, call.paths[0]) && std::getline(calls, call.paths[1]))
    guarded([&] { return verify(call); });
  return 0;
}

}  // namespace proof
