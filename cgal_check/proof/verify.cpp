#include "verify.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <istream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "checker.hpp"
#include "faults.hpp"
#include "sha256.hpp"

namespace proof {

namespace {

constexpr std::size_t most_jobs = 256;

struct Call {
  std::string scene, proof;
  std::size_t jobs = 1;
  bool is_partial = false;        // whether a proof may end before the span of the scene
  std::optional<Rational> until;  // the time before which it may not end
};

struct Verdict {
  std::optional<Failure> failure;
  std::string conclusion;  // or what went wrong
  bool is_broken = false;
};

Call read_call(const std::vector<std::string>& words) {
  Call call;
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--partial") {
      call.is_partial = true;
      continue;
    }
    if (words[i] == "--until") {
      const std::string number = ++i < words.size() ? words[i] : "";
      if (!is_fraction(number)) throw NoProof("--until: not a number, p or p/q");
      call.until = fraction(number);
      continue;
    }
    if (words[i] != "--jobs") {
      paths.push_back(words[i]);
      continue;
    }
    const std::string number = ++i < words.size() ? words[i] : "";
    if (!is_integer(number) || number.front() == '-' || number.size() > 3 ||
        std::stoul(number) == 0 || std::stoul(number) > most_jobs)
      throw NoProof("--jobs: a number from 1 to " + std::to_string(most_jobs));
    call.jobs = std::stoul(number);
  }
  if (paths.size() != 2 || (call.is_partial && call.until))
    throw NoProof("usage: cgal_check proof SCENE PROOF [--jobs N] [--until T | --partial]");
  call.scene = paths[0], call.proof = paths[1];
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
  return bytes.str();
}

Verdict verdict(Scene& scene, const ProofText& text, std::size_t share, std::size_t shares) {
  try {
    Checker checker(scene, text, share, shares);
    std::optional<Failure> failure = checker.run();
    return {failure, failure ? "" : checker.conclusion(), false};
  } catch (const std::exception& fault) {
    return {std::nullopt, fault.what(), true};
  }
}

// A verdict as bytes through a pipe.
std::string packed(const Verdict& verdict) {
  if (verdict.is_broken) return "broken\n" + verdict.conclusion;
  if (!verdict.failure) return "accepted\n" + verdict.conclusion;
  return "rejected " + std::to_string(verdict.failure->number) + " " +
         std::to_string(verdict.failure->line) + "\n" + verdict.failure->why;
}

Verdict unpacked(const std::string& bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  std::istringstream head(bytes.substr(0, end));
  const std::string rest = bytes.substr(std::min(end + 1, bytes.size()));
  std::string word;
  Failure failure{0, 0, rest};
  head >> word >> failure.number >> failure.line;
  if (word == "rejected") return {failure, "", false};
  if (word == "accepted") return {std::nullopt, rest, false};
  return {std::nullopt, word == "broken" ? rest : "a process has ended too early", true};
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
Verdict by_processes(Scene& scene, const ProofText& text, std::size_t jobs) {
  std::vector<std::pair<pid_t, int>> children;
  for (std::size_t share = 0; share < jobs; ++share) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) {
      ::close(ends[0]);
      const std::string answer = packed(verdict(scene, text, share, jobs));
      for (std::size_t sent = 0; sent < answer.size();) {
        const ssize_t put = ::write(ends[1], answer.data() + sent, answer.size() - sent);
        if (put <= 0) ::_exit(3);
        sent += static_cast<std::size_t>(put);
      }
      ::_exit(0);
    }
    ::close(ends[1]);
    children.emplace_back(child, ends[0]);
  }
  Verdict first;
  for (std::size_t share = 0; share < jobs; ++share) {
    Verdict here = unpacked(read_all(children[share].second));
    ::waitpid(children[share].first, nullptr, 0);
    const bool is_first = share == 0 || (here.failure && !first.is_broken &&
                          (!first.failure || here.failure->number < first.failure->number));
    if (is_first || here.is_broken) first = std::move(here);
  }
  return first;
}

// A line without line breaks.
void answer(const std::string& text) {
  std::string line;
  for (const char c : text) line += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  std::puts(line.c_str());
  std::fflush(stdout);
}

int verify(const Call& call) {
  const std::string scene_bytes = bytes_of(call.scene);
  const ProofText text = parse_proof(bytes_of(call.proof));
  if (text.hash != sha256(scene_bytes))
    throw NoProof("the proof is of another scene: the hash of its file is another one");
  Scene scene(scene_bytes);
  const Verdict found =
      call.jobs == 1 ? verdict(scene, text, 0, 1) : by_processes(scene, text, call.jobs);
  if (found.is_broken) {
    answer("error internal: " + found.conclusion);
    return 3;
  }
  if (found.failure) {
    answer("rejected: line " + std::to_string(found.failure->line) + ": " + found.failure->why);
    return 1;
  }
  const bool is_short = !text.contact && text.end < scene.end();
  if (is_short && !call.is_partial && !(call.until && *call.until <= text.end)) {
    answer("rejected: proved up to t = " + text.end.get_str() + " only (see --partial)");
    return 1;
  }
  answer("accepted: " + found.conclusion);
  return 0;
}

int guarded(const std::function<int()>& verification) {
  try {
    return verification();
  } catch (const NoProof& fault) {
    answer(std::string("no proof: ") + fault.what());
    return 2;
  } catch (const std::exception& fault) {
    answer(std::string("error internal: ") + fault.what());
    return 3;
  }
}

}  // namespace

int verify(int count, const char* const* arguments) {
  return guarded([&] { return verify(read_call({arguments, arguments + count})); });
}

int verify_each(std::istream& calls) {
  Call call;
  call.is_partial = true;
  while (std::getline(calls, call.scene) && std::getline(calls, call.proof))
    guarded([&] { return verify(call); });
  return 0;
}

}  // namespace proof
