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
