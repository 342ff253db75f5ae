// SHA-256 (FIPS 180-4).
#pragma once

#include <string>

namespace proof {

// In lower-case hexadecimal digits.
std::string sha256(const std::string& bytes);

}  // namespace proof
