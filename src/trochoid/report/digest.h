#pragma once

#include <string>
#include <string_view>

namespace trochoid::report {

/// @brief SHA-256 of a text in base64, as a Content-Security-Policy names a script.
/// @src [nist2015] section 6.2; [josefsson2006] section 4
std::string sha256_base64(std::string_view text);

}  // namespace trochoid::report
