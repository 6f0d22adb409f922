# Writes a C++ file that holds the parts of the page as raw string literals.
# Given: OUTPUT, NAMES (of the functions) and FILES, in the same order
set(text "#include <trochoid/report/page.h>\n\nnamespace trochoid::report {\n")
foreach(name file IN ZIP_LISTS NAMES FILES)
  file(READ ${file} content)
  # The map of a minified file stays behind, and a browser would look for it.
  string(REGEX REPLACE "\n//# sourceMappingURL=[^\n]*" "" content "${content}")
  string(APPEND text "\nstd::string_view ${name}() {\n  return R\"page~(")
  string(APPEND text "${content}")
  string(APPEND text ")page~\";\n}\n")
endforeach()
string(APPEND text "\n}  // namespace trochoid::report\n")
file(WRITE ${OUTPUT} "${text}")
