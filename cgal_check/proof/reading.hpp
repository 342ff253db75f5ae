// Bodies from JSON.
#pragma once

#include "json.hpp"
#include "scene.hpp"

namespace proof {

// A number, or a text that is one. Throws NoProof, as do the others.
Rational exact_number(const Json* json);

const std::vector<Json>& list(const Json* json);

// The numbering of its vertices begins at `first`; it is simple at the start. That its pieces turn
// by the `spin`, or follow the `path`, that stands beside them is verified, or not.
Body read_body(const Json& json, int first, const Rational& start, bool are_records_verified);

// The members of an object, which must be among the keys. Throws NoProof.
void allow_keys(const Json& json, std::initializer_list<std::string_view> keys);

// A member that must be there.
const Json* member(const Json& json, std::string_view key);

}  // namespace proof
