# Flags of our own targets. Never -ffast-math: it would change the results, and the
# floating-point mode of whoever links the library.
add_library(trochoid_compile_options INTERFACE)
target_compile_options(trochoid_compile_options INTERFACE -ffp-contract=off)
if(TROCHOID_DEVELOPER)
  target_compile_options(trochoid_compile_options INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wsign-conversion
    -Wno-missing-field-initializers -Wnon-virtual-dtor -Woverloaded-virtual -Werror
    # g++ 12 sees an overlap in std::string operator+ that is not there (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
endif()
if(TROCHOID_SANITIZE)
  add_compile_options(-fsanitize=${TROCHOID_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all -D_GLIBCXX_ASSERTIONS)
  add_link_options(-fsanitize=${TROCHOID_SANITIZE})
endif()

# What nearly every file includes, parsed once a target: a third of the time of a file.
# Each file still includes what it uses. The preset `dev`, tools/tidy and whoever sets
# CMAKE_DISABLE_PRECOMPILE_HEADERS compile without, and find the one that does not.
set(TROCHOID_PRECOMPILED
  <fmt/core.h> <algorithm> <array> <cmath> <complex> <cstddef> <functional> <limits>
  <memory> <numbers> <numeric> <optional> <span> <stdexcept> <string> <string_view>
  <utility> <variant> <vector>)
