#include "reader.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace {

// More vertices than this are no snapshot but a mistake, and indices stay within int.
constexpr std::size_t largest_count = 10'000'000;

bool is_space(int c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_integer(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  return is_digits(text);
}

}  // namespace

int Reader::peek() {
  if (next_ == filled_) {
    ssize_t got;
    do {
      got = ::read(file_, buffer_.data(), buffer_.size());
    } while (got < 0 && errno == EINTR);
    if (got < 0) throw std::system_error(errno, std::generic_category(), "standard input");
    next_ = 0;
    filled_ = static_cast<std::size_t>(got);
    if (got == 0) return -1;
  }
  return static_cast<unsigned char>(buffer_[next_]);
}

bool Reader::at_end() {
  if (loaded_) return false;
  for (int c = peek(); c != -1; c = peek()) {
    if (!is_space(c)) return false;
    if (c == '\n') ++line_;
    ++next_;
  }
  return true;
}

void Reader::load() {
  if (loaded_) return;
  const bool ended = at_end();
  line_of_word_ = line_;
  if (ended) throw BadInput("the input ends in the middle of a request");
  word_.clear();
  for (int c = peek(); c != -1 && !is_space(c); c = peek()) {
    word_.push_back(static_cast<char>(c));
    ++next_;
  }
  loaded_ = true;
}

const std::string& Reader::word() {
  load();
  loaded_ = false;
  return word_;
}

void Reader::expect(std::string_view expected) {
  if (word() != expected)
    throw BadInput("expected '" + std::string(expected) + "', found '" + shown(word_) + "'");
}

bool Reader::accept(std::string_view expected) {
  load();
  if (word_ != expected) return false;
  loaded_ = false;
  return true;
}

std::size_t Reader::count() {
  const std::string& text = word();
  if (!is_digits(text)) throw BadInput("expected a count, found '" + shown(text) + "'");
  std::size_t value = 0;
  for (char c : text) {
    value = 10 * value + static_cast<std::size_t>(c - '0');
    if (value > largest_count) throw BadInput("count is too large: " + shown(text));
  }
  return value;
}

int Reader::index(std::size_t size, std::string_view what) {
  const std::size_t value = count();
  if (value >= size)
    throw BadInput("no such " + std::string(what) + ": " + word_ + " of " + std::to_string(size));
  return static_cast<int>(value);
}

std::string Reader::integer() {
  const std::string& text = word();
  if (!is_integer(text)) throw BadInput("expected an integer, found '" + shown(text) + "'");
  return text;
}

Fraction Reader::fraction() {
  const std::string& text = word();
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) {
    if (!is_integer(text)) throw BadInput("expected a rational, found '" + shown(text) + "'");
    return {text, "1"};
  }
  Fraction f{text.substr(0, slash), text.substr(slash + 1)};
  if (!is_integer(f.numerator) || !is_digits(f.denominator))
    throw BadInput("expected a rational, found '" + shown(text) + "'");
  if (f.denominator.find_first_not_of('0') == std::string::npos)
    throw BadInput("denominator is zero: " + shown(text));
  return f;
}

std::string shown(std::string_view text) {
  constexpr std::size_t limit = 40;
  std::string result;
  for (char c : text.substr(0, limit)) result.push_back(c >= ' ' && c <= '~' ? c : '?');
  if (text.size() > limit) result += "...";
  return result;
}
