// Names in messages.
#pragma once

#include <string>

namespace proof {

// A text in quotes, in ASCII with escapes, as Python's ascii() has it.
std::string quoted(const std::string& name);

}  // namespace proof
