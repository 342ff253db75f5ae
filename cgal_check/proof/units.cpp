#include "units.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "faults.hpp"
#include "numbers.hpp"
#include "reading.hpp"

namespace proof {

namespace {

constexpr std::size_t most_characters = 32;
constexpr std::size_t most_decimals = 30;

bool is_first_byte(char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }

// Whether a text in UTF-8 has a control character, U+0000 to U+001F and U+007F to U+009F, or one
// of the line breaks U+2028 and U+2029.
bool has_control(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x20 || c == 0x7f) return true;
    if (c == 0xc2 && static_cast<unsigned char>(text[i + 1]) < 0xa0) return true;
  }
  return text.find("\xe2\x80\xa8") != std::string::npos ||
         text.find("\xe2\x80\xa9") != std::string::npos;
}

void check_unit(const Json& unit) {
  if (unit.kind != Json::Kind::text || unit.text.empty())
    throw NoProof("units: a unit that is no text, or empty");
  if (std::count_if(unit.text.begin(), unit.text.end(), is_first_byte) >
      static_cast<std::ptrdiff_t>(most_characters))
    throw NoProof("units: a unit of more than 32 characters");
  if (has_control(unit.text)) throw NoProof("units: a unit with a control character");
}

// Whether time in this unit can be added to a date.
bool is_of_dates(const std::string& unit) {
  const std::array<std::string_view, 7> known{"ns", "us", "ms", "s", "min", "h", "day"};
  return std::find(known.begin(), known.end(), unit) != known.end();
}

int days_of(int year, int month) {
  const bool is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  if (month == 2) return is_leap ? 29 : 28;
  return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

// Reads the front of a text, and removes it.
class Front {
 public:
  explicit Front(std::string_view text) : text_(text) {}

  bool is_at_end() const { return text_.empty(); }

  // One of these characters.
  bool accept(std::string_view any) {
    if (text_.empty() || any.find(text_.front()) == std::string_view::npos) return false;
    text_.remove_prefix(1);
    return true;
  }

  // A number of exactly so many digits, at most a highest one; -1 if there is none.
  int number(std::size_t digits, int highest) {
    const std::string_view front = text_.substr(0, digits);
    if (front.size() < digits || leading_digits(front) < digits) return -1;
    text_.remove_prefix(digits);
    const int n = std::stoi(std::string(front));
    return n <= highest ? n : -1;
  }

  std::size_t skip_digits() {
    const std::size_t count = leading_digits(text_);
    text_.remove_prefix(count);
    return count;
  }

 private:
  std::string_view text_;
};

bool is_date(Front& front) {
  const int year = front.number(4, 9999);
  if (year < 1 || !front.accept("-")) return false;
  const int month = front.number(2, 12);
  if (month < 1 || !front.accept("-")) return false;
  return front.number(2, days_of(year, month)) >= 1;
}

bool is_hours_and_minutes(Front& front) {
  return front.number(2, 23) >= 0 && front.accept(":") && front.number(2, 59) >= 0;
}

bool is_time_of_day(Front& front) {
  if (!is_hours_and_minutes(front) || !front.accept(":") || front.number(2, 59) < 0) return false;
  if (!front.accept(".")) return true;
  const std::size_t decimals = front.skip_digits();
  return 1 <= decimals && decimals <= most_decimals;
}

bool is_zone(Front& front) {
  return front.accept("Zz") || (front.accept("+-") && is_hours_and_minutes(front));
}

// Whether a text is a date and time with a zone, by RFC 3339 without leap seconds.
bool is_epoch(std::string_view text) {
  Front front(text);
  return is_date(front) && front.accept("Tt ") && is_time_of_day(front) && is_zone(front) &&
         front.is_at_end();
}

}  // namespace

void check_units(const Json* units, const Json* epoch) {
  const Json* time = nullptr;
  if (units) {
    allow_keys(*units, {"length", "time"});
    if (units->members.empty()) throw NoProof("units: neither a length nor a time");
    for (const auto& [key, unit] : units->members) check_unit(unit);
    time = units->find("time");
  }
  if (!epoch) return;
  if (epoch->kind != Json::Kind::text || !is_epoch(epoch->text))
    throw NoProof("epoch: not a date and time with a zone");
  if (!time || !is_of_dates(time->text))
    throw NoProof("epoch: it needs units with a time in ns, us, ms, s, min, h or day");
}

}  // namespace proof
