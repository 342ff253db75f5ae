// The text of the requests: words, counts and numbers, read from a file descriptor.
// Knows nothing of geometry; every fault of the text is a BadInput.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// The text is not a request of the protocol: what is wrong, for one line of the answer.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A rational as it was written: decimal digits, the numerator perhaps with a minus sign,
// the denominator never zero. Not in lowest terms.
struct Fraction {
  std::string numerator;
  std::string denominator;
};

class Reader {
 public:
  explicit Reader(int file) : file_(file), buffer_(1 << 16) {}

  // Skips white space. True if nothing else follows.
  bool at_end();

  // The line of the last word, from 1.
  std::size_t line() const { return line_of_word_; }

  const std::string& word();

  // The next word, which must be this one.
  void expect(std::string_view expected);

  // The next word if it is this one, which then is read; otherwise nothing is.
  bool accept(std::string_view expected);

  // A number of things that follow; no memory is taken for what has not been read.
  std::size_t count();

  // A number from 0 to size - 1; `what` names the list that it points into.
  int index(std::size_t size, std::string_view what);

  std::string integer();
  Fraction fraction();

 private:
  int peek();  // the next byte, or -1 at the end
  void load();

  int file_;
  std::vector<char> buffer_;
  std::size_t next_ = 0;
  std::size_t filled_ = 0;
  std::size_t line_ = 1;
  std::size_t line_of_word_ = 1;
  std::string word_;
  bool loaded_ = false;  // word_ was looked at by accept() and is still to be read
};

// A piece of the input, made fit to stand in a one-line message.
std::string shown(std::string_view text);
