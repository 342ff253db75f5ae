#include "json.hpp"

#include <cctype>
#include <unordered_set>

#include <nlohmann/json.hpp>

#include "faults.hpp"
#include "numbers.hpp"

namespace proof {

namespace {

constexpr std::size_t deepest = 32;

bool is_number_part(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.' ||
         c == 'e' || c == 'E';
}

bool is_json_number(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  const std::size_t whole = leading_digits(text);
  if (whole == 0 || (whole > 1 && text.front() == '0')) return false;
  text.remove_prefix(whole);
  if (!text.empty() && text.front() == '.') {
    const std::size_t part = leading_digits(text.substr(1));
    if (part == 0) return false;
    text.remove_prefix(part + 1);
  }
  if (text.empty()) return true;
  if (text.front() != 'e' && text.front() != 'E') return false;
  text.remove_prefix(1);
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  return !text.empty() && leading_digits(text) == text.size();
}

// The text with its numbers replaced by their indices in a list: the parser would round them.
std::string numbered(const std::string& text, std::vector<std::string>& numbers) {
  std::string result;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (!quoted && (c == '-' || std::isdigit(static_cast<unsigned char>(c)))) {
      std::size_t end = i;
      while (end < text.size() && is_number_part(text[end])) ++end;
      numbers.push_back(text.substr(i, end - i));
      if (!is_json_number(numbers.back())) throw NoProof("the scene is not JSON: a number");
      result += std::to_string(numbers.size() - 1);
      i = end;
      continue;
    }
    if (c == '"') quoted = !quoted;
    result += c;
    ++i;
    if (quoted && c == '\\' && i < text.size()) result += text[i++];
  }
  return result;
}

class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Builder(const std::vector<std::string>& numbers) : numbers_(numbers) {}

  Json result;

  bool null() override { return add(Json{}); }
  bool boolean(bool value) override {
    Json json{};
    json.kind = Json::Kind::boolean;
    json.truth = value;
    return add(std::move(json));
  }
  bool number_integer(number_integer_t) override { return false; }
  bool number_unsigned(number_unsigned_t index) override {
    return add(named(Json::Kind::number, numbers_.at(index)));
  }
  bool number_float(number_float_t, const string_t&) override { return false; }
  bool string(string_t& text) override { return add(named(Json::Kind::text, text)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::Kind::object); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Json::Kind::list); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    if (!known_.back().insert(name).second) throw NoProof("the scene has a key twice");
    keys_.back() = name;
    return true;
  }
  bool parse_error(std::size_t place, const std::string&,
                   const nlohmann::detail::exception&) override {
    throw NoProof("the scene is not JSON: after " + std::to_string(place) + " characters");
  }

 private:
  static Json named(Json::Kind kind, const std::string& text) {
    Json json{};
    json.kind = kind;
    json.text = text;
    return json;
  }

  bool open(Json::Kind kind) {
    if (open_.size() == deepest) throw NoProof("the scene is nested too deeply");
    open_.push_back(named(kind, ""));
    keys_.emplace_back();
    known_.emplace_back();
    return true;
  }

  bool close() {
    Json json = std::move(open_.back());
    open_.pop_back();
    keys_.pop_back();
    known_.pop_back();
    return add(std::move(json));
  }

  bool add(Json json) {
    if (open_.empty())
      result = std::move(json);
    else if (open_.back().kind == Json::Kind::list)
      open_.back().items.push_back(std::move(json));
    else
      open_.back().members.emplace_back(keys_.back(), std::move(json));
    return true;
  }

  const std::vector<std::string>& numbers_;
  std::vector<Json> open_;
  std::vector<std::string> keys_;
  std::vector<std::unordered_set<std::string>> known_;  // the keys of each that is open
};

}  // namespace

const Json* Json::find(std::string_view key) const {
  for (const auto& [name, value] : members)
    if (name == key) return &value;
  return nullptr;
}

Json parse_json(const std::string& text) {
  // A parser of strings of C would end at one.
  if (text.find('\0') != std::string::npos) throw NoProof("the scene is not JSON: a null");
  std::vector<std::string> numbers;
  const std::string in_line = numbered(text, numbers);
  Builder builder(numbers);
  if (!nlohmann::json::sax_parse(in_line, &builder)) throw NoProof("the scene is not JSON");
  return std::move(builder.result);
}

}  // namespace proof
