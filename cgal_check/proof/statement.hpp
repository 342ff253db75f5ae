// Names in messages.
#pragma once

#include <string>

namespace proof {

// A text in quotes, in ASCII with escapes, as Python's ascii() has it.
std::string quoted(const std::string& name);

// The words before a statement that is about the modelled bodies, and not the true ones.
std::string about(bool is_modelled);

}  // namespace proof
