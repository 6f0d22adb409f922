// The part of toml++ that is in its shared library, for a program without it: Debian has
// no static one.
#define TOML_HEADER_ONLY 0
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
