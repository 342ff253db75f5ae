// Real roots of integer polynomials, by CGAL's univariate algebraic kernel.
#pragma once

#include <string>

#include "reader.hpp"

// Each reads what follows the request's name, "end" included, and returns the answer.
// They throw Bad if an interval does not isolate a root.
std::string reply_to_root(Reader& in);
std::string reply_to_compare(Reader& in);
std::string reply_to_sign(Reader& in);
