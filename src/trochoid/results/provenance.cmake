# Writes provenance.cpp at build time, and only when it changes: a commit must not need a
# new configuration, nor an unchanged one a new compilation.
# Given: SOURCE_DIR, VERSION, OUTPUT
set(commit unknown)
find_program(GIT git)
if(GIT)
  # A tarball unpacked inside somebody else's repository is not that repository's commit.
  execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} rev-parse --show-toplevel
    OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH ${SOURCE_DIR} source)
  if(top STREQUAL source)
    execute_process(
      COMMAND ${GIT} --no-optional-locks -C ${SOURCE_DIR}
              describe --always --dirty --abbrev=12 --exclude=*
      OUTPUT_VARIABLE described RESULT_VARIABLE failed
      OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT failed)
      set(commit ${described})
    endif()
  endif()
endif()

set(text "#include <trochoid/results/provenance.h>

namespace trochoid::results {

std::string_view version() { return \"${VERSION}\"; }
std::string_view commit() { return \"${commit}\"; }

}  // namespace trochoid::results
")
set(before "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT text STREQUAL before)
  file(WRITE ${OUTPUT} "${text}")
endif()
