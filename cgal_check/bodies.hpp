// Bodies at one instant: what two of them have in common, and whether one is the union of others.
#pragma once

#include <string>

#include "reader.hpp"

// Each reads what follows the request's name, "end" included, and returns the answer.
// They throw Bad if a ring of a body is not simple, and if a claim is false.
std::string reply_to_pair(Reader& in);
std::string reply_to_union(Reader& in);
