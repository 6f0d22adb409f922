# Flags of our own targets. Never -ffast-math: it would change the results, and the
# floating-point mode of whoever links the library.
add_library(trochoid_compile_options INTERFACE)
target_compile_options(trochoid_compile_options INTERFACE -ffp-contract=off)
if(TROCHOID_DEVELOPER)
  target_compile_options(trochoid_compile_options INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion
    -Wno-missing-field-initializers -Wnon-virtual-dtor -Woverloaded-virtual -Werror
    # g++ 12 sees an overlap in std::string operator+ that is not there (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  if(TROCHOID_UNITY)
    # What a file has at its top is seen by the next one, which may have a variable of that
    # name.
    target_compile_options(trochoid_compile_options INTERFACE
      $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
  else()
    target_compile_options(trochoid_compile_options INTERFACE -Wshadow)
  endif()
endif()
if(TROCHOID_UNITY)
  # g++ does not see that the unnamed namespace of a unit is in one unit only.
  target_compile_options(trochoid_compile_options INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()

# What a file that is read wrongly meets before it does harm: for the library and the
# program. Not the controller, which is to need nothing of its host, and not under the
# sanitizers, which see more. Below a hundredth of the instructions of a command.
add_library(trochoid_hardening INTERFACE)
if(CMAKE_SYSTEM_NAME STREQUAL Linux AND NOT TROCHOID_SANITIZE)
  set(newer "$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,12>>")
  target_compile_options(trochoid_hardening INTERFACE -fstack-protector-strong
    # It needs an optimizer; some compilers define it by themselves.
    "$<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=$<IF:${newer},3,2>>")
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
  <fmt/core.h> <algorithm> <array> <atomic> <chrono> <cmath> <complex> <cstddef>
  <filesystem> <functional> <limits> <map> <memory> <numbers> <numeric> <optional> <set>
  <span> <stdexcept> <string> <string_view> <utility> <variant> <vector>)
