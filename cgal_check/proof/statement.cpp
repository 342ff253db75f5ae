// What has been proved, in words, and whether an answer says the same.
#include "statement.hpp"

#include <algorithm>
#include <cstdio>
#include <unordered_map>

#include "apart.hpp"
#include "checker.hpp"
#include "faults.hpp"
#include "json.hpp"
#include "reading.hpp"

namespace proof {

namespace {

std::vector<unsigned long> characters(const std::string& utf8) {
  std::vector<unsigned long> found;
  for (const char byte : utf8) {
    const auto c = static_cast<unsigned char>(byte);
    if (c < 0x80)
      found.push_back(c);
    else if (c < 0xc0)
      found.back() = found.back() << 6 | (c & 0x3f);
    else
      found.push_back(c & (c < 0xe0 ? 0x1f : c < 0xf0 ? 0x0f : 0x07));
  }
  return found;
}

int number_in(const Json& json, const char* key) {
  const Json* found = member(json, key);
  if (found->kind != Json::Kind::number || !is_integer(found->text) || found->text.size() > 9 ||
      found->text.front() == '-')
    throw NoProof("the answer has no number for " + std::string(key));
  return std::stoi(found->text);
}

struct AnsweredTime {
  Poly<Integer> f;
  Rational low, high;
};

AnsweredTime time_in(const Json& contact) {
  const Json& time = *member(contact, "time");
  AnsweredTime root{{}, exact_number(member(time, "low")), exact_number(member(time, "high"))};
  for (const Json& c : list(member(time, "polynomial"))) {
    if (!is_integer(c.text)) throw NoProof("the answer has no polynomial");
    root.f.push_back(Integer(c.text, 10));
  }
  trim(root.f);
  if (root.f.empty() || (root.low == root.high && sign_at(root.f, root.low) != 0))
    throw NoProof("the answer has no time");
  return root;
}

}  // namespace

std::string quoted(const std::string& name) {
  const bool has_one = name.find('\'') != std::string::npos;
  const char quote = has_one && name.find('"') == std::string::npos ? '"' : '\'';
  std::string result(1, quote);
  for (const unsigned long c : characters(name)) {
    char escaped[16];
    if (c == static_cast<unsigned char>(quote) || c == '\\')
      result += std::string("\\") + static_cast<char>(c);
    else if (c == '\n' || c == '\r' || c == '\t')
      result += c == '\n' ? "\\n" : c == '\r' ? "\\r" : "\\t";
    else if (c >= ' ' && c < 0x7f)
      result += static_cast<char>(c);
    else {
      const char* form = c <= 0xff ? "\\x%02lx" : c <= 0xffff ? "\\u%04lx" : "\\U%08lx";
      std::snprintf(escaped, sizeof escaped, form, c);
      result += escaped;
    }
  }
  return result + quote;
}

std::string about(bool is_modelled) { return is_modelled ? "modelled bodies: " : ""; }

std::string Checker::conclusion() const {
  const std::string from = scene_.start().get_str(), to = text_.end.get_str();
  const std::string last = scene_.end().get_str();
  if (!text_.contact) {
    const std::string proved = "no contact in [" + from + ", " + to + "]";
    if (text_.end == scene_.end()) return proved + ", the whole span";
    return proved + "; the span of the scene is [" + from + ", " + last +
           "]: nothing is said of (" + to + ", " + last + "]";
  }
  const ContactText& contact = *text_.contact;
  const auto edge = [&](int u, int v) { return scene_.in_short(scene_.first_of_edge(u, v)); };
  std::set<int> named;
  std::string said;
  if (is_at_start_) {
    using Kind = ContactText::Kind;
    const auto& [a, b] = contact.edge;
    const int other = contact.kind == Kind::inside ? a : scene_.body_of(a), v = contact.vertex;
    named = {scene_.body_of(v), other};
    said = "contact at the start t = " + from + ": ";
    if (contact.kind == Kind::inside)
      said += scene_.in_short(v) + " in the inside of b" + std::to_string(a);
    if (contact.kind == Kind::vertex)
      said += scene_.in_short(std::min(v, a)) + " at " + scene_.in_short(std::max(v, a));
    if (contact.kind == Kind::edge) said += scene_.in_short(v) + " on edge " + edge(a, b);
    if (contact.kind == Kind::crossing)
      said += "edge " + edge(v, contact.end) + " meets edge " + edge(a, b);
  } else {
    const TimeText& time = contact.time;
    said = "first contact at T = ";
    if (time.low == time.high) {
      said += time.low.get_str();
    } else {
      said += times_.back().twelve_digits() + "..., the root of";
      for (const Integer& c : polynomial_of(time)) said += " " + c.get_str();
      said += " in [" + time.low.get_str() + ", " + time.high.get_str() + "]";
    }
    said += ": incidences exactly ";
    bool is_first = true;
    for (const Incidence& i : found_) {
      said += std::string(is_first ? "" : ", ") + scene_.in_short(i.vertex) +
              (i.is_on_edge ? " on edge " : " at ") + scene_.in_short(i.other);
      is_first = false;
      named.insert(scene_.body_of(i.vertex));
      named.insert(scene_.body_of(i.other));
    }
  }
  const char* before = " (";
  for (const int i : named) {
    const std::string& name = scene_.bodies()[static_cast<std::size_t>(i)].name;
    said += before + ("b" + std::to_string(i)) + " is " + quoted(name);
    before = ", ";
  }
  return named.empty() ? said : said + ")";
}

std::string Checker::difference(const std::string& answer) const {
  const Json json = parse_json(answer);
  const Json* contact = member(json, "contact");
  if (contact->kind == Json::Kind::null) {
    const bool is_same = !text_.contact && text_.end >= exact_number(member(json, "until"));
    return is_same ? "" : "no contact is the answer";
  }
  const auto [f, low, high] = time_in(*contact);
  std::set<Incidence> pairs;
  std::unordered_map<std::string, const Body*> bodies;
  for (const Body& body : scene_.bodies()) bodies.emplace(body.name, &body);
  const auto feature = [&](const Json& side, const char* kind) {
    const Json* name = member(side, "body");
    const auto body = bodies.find(name->text);
    const int k = number_in(side, kind);
    if (name->kind != Json::Kind::text || body == bodies.end() || k >= body->second->size)
      throw NoProof("the answer has a body or a feature that the scene has not");
    return body->second->first + k;
  };
  for (const Json& pair : list(member(*contact, "pairs"))) {
    const Json& other = *member(pair, "b");
    const bool is_on_edge = other.find("edge") != nullptr;
    const int u = feature(*member(pair, "a"), "vertex");
    const int v = feature(other, is_on_edge ? "edge" : "vertex");
    pairs.insert(is_on_edge ? Incidence{u, true, v} : Incidence{std::min(u, v), false, std::max(u, v)});
  }
  const bool is_initial = member(*contact, "kind")->text == "initial";
  if (!text_.contact) return "a contact is the answer";
  const Time found = is_at_start_ ? Time(scene_.start()) : times_.back();
  const bool is_same = found.compare(low) >= 0 && found.compare(high) <= 0 && found.sign_of(f) == 0;
  if (!is_same) return "another time is the answer";
  if (is_initial) return is_at_start_ ? "" : "a contact at the start is the answer";
  return pairs == found_ ? "" : "other incidences are the answer";
}

std::string difference(const Statement& found, const std::string& answer) {
  const Json json = parse_json(answer);
  const Json* contact = member(json, "contact");
  if (contact->kind == Json::Kind::null) {
    const bool is_same = found.low >= exact_number(member(json, "until"));
    return is_same ? "" : "no contact is the answer";
  }
  const AnsweredTime time = time_in(*contact);
  const auto sign_of_f = [&](const Rational& t) { return sign_at(time.f, t); };
  const int at_low = sign_of_f(time.low), at_high = sign_of_f(time.high);
  if (time.low != time.high && (time.low > time.high || at_low * at_high >= 0))
    throw NoProof("the answer has no time");
  if (member(*contact, "kind")->text == "self" || !found.has_contact)
    return "a contact that is not certified is the answer";
  const Rational &a = found.low, &b = found.until;
  const bool is_start = time.low == a && time.high == a && a == b;
  const bool is_after =
      is_start || time.low > a || (time.high > a && sign_of_f(a) * at_low > 0);
  const bool is_before = time.high <= b || (time.low < b && sign_of_f(b) * at_high >= 0);
  return is_after && is_before ? "" : "another time is the answer";
}

}  // namespace proof
