# A second library of the same sources under the sanitizers, in the same build and the same
# ctest run, so that one command tests both. "quick" is what reads files and the kernels
# below them, but for the solvers and for what only writes; "all" is every room (./test --all).
set(TROCHOID_SANITIZED_TESTS quick CACHE STRING
  "Run tests also under ASan and UBSan: quick, all or OFF")
set(TROCHOID_SANITIZED_ROOMS base numerics geometry chip force signal files cases)
if(TROCHOID_SANITIZE)
  set(TROCHOID_SANITIZED_TESTS OFF)  # then everything already is
endif()

if(TROCHOID_SANITIZED_TESTS)
  add_library(trochoid_sanitizers INTERFACE)
  # -w: the other build warns already, and g++ 12 sees uninitialized values in what the
  # sanitizers insert.
  target_compile_options(trochoid_sanitizers INTERFACE -UNDEBUG -w
    -fsanitize=address,undefined -fno-sanitize-recover=all -D_GLIBCXX_ASSERTIONS)
  target_link_options(trochoid_sanitizers INTERFACE -fsanitize=address,undefined)

  get_target_property(sources trochoid SOURCES)
  get_target_property(controller trochoid_controller SOURCES)
  if(NOT TROCHOID_SANITIZED_TESTS STREQUAL all)
    list(JOIN TROCHOID_SANITIZED_ROOMS "|" rooms)
    list(FILTER sources INCLUDE REGEX "/trochoid/(${rooms})/")
    # Little but templates of Eigen, and a fifth of the time to compile.
    list(FILTER sources EXCLUDE REGEX
      "/numerics/(dense|least_squares|complex_eigenvalues|[a-z_]*levenberg_marquardt)\\.cpp")
    # They take no bytes from outside, and nearly a minute of CPU to compile.
    list(FILTER sources EXCLUDE REGEX "/cases/(case_schema|describe_case|new_case|write_case)\\.cpp")
  endif()
  list(APPEND sources ${controller})
  get_target_property(libraries trochoid LINK_LIBRARIES)
  list(REMOVE_ITEM libraries trochoid_controller "$<BUILD_INTERFACE:trochoid_hardening>")
  add_library(trochoid_sanitized STATIC EXCLUDE_FROM_ALL ${sources})
  add_dependencies(trochoid_sanitized trochoid)  # it makes the generated sources
  target_precompile_headers(trochoid_sanitized PRIVATE ${TROCHOID_PRECOMPILED})
  target_compile_options(trochoid_sanitized PRIVATE -O1)  # longer to compile, half as long to run
  # Checks of addresses as calls, not in line: they watch the same and compile sooner.
  list(APPEND rooms_of_words files)
  set(flags_of_words --param=asan-instrumentation-with-call-threshold=0)
  trochoid_unity(trochoid_sanitized)
  target_compile_features(trochoid_sanitized PUBLIC cxx_std_20)
  target_include_directories(trochoid_sanitized PUBLIC
    $<TARGET_PROPERTY:trochoid,INCLUDE_DIRECTORIES>)
  target_compile_definitions(trochoid_sanitized PRIVATE
    $<TARGET_PROPERTY:trochoid,COMPILE_DEFINITIONS>)
  target_link_libraries(trochoid_sanitized PUBLIC ${libraries} trochoid_sanitizers)
  if(NOT TROCHOID_SANITIZED_TESTS STREQUAL all)
    target_link_libraries(trochoid_sanitized PUBLIC trochoid)  # for what is called, unwatched
  endif()
  set_target_properties(trochoid_sanitized PROPERTIES CXX_EXTENSIONS OFF)
endif()

# The test itself is watched as well.
function(trochoid_compile_sanitized name)
  get_target_property(sources ${name} SOURCES)
  add_executable(${name}_sanitized ${sources})
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "/(property|unit/surface)$")
    # Of an inline function the linker takes the test's copy: in these it is called often.
    target_compile_options(${name}_sanitized PRIVATE -O1)
  endif()
  target_precompile_headers(${name}_sanitized REUSE_FROM trochoid_test_headers_sanitized)
  trochoid_unity(${name}_sanitized)
  target_include_directories(${name}_sanitized PRIVATE
    $<TARGET_PROPERTY:${name},INCLUDE_DIRECTORIES>)
  target_compile_definitions(${name}_sanitized PRIVATE
    $<TARGET_PROPERTY:${name},COMPILE_DEFINITIONS>)
endfunction()

# The test as it was compiled, with the library that is watched. The library comes first on
# the command line: of an inline function the linker takes the copy that is watched.
function(trochoid_link_sanitized name)
  add_executable(${name}_sanitized $<TARGET_OBJECTS:${name}>)
  set_target_properties(${name}_sanitized PROPERTIES LINKER_LANGUAGE CXX)
  target_link_options(${name}_sanitized PRIVATE
    "LINKER:--whole-archive,$<TARGET_FILE:trochoid_sanitized>,--no-whole-archive")
endfunction()

function(trochoid_sanitized_twin name)
  if(NOT TROCHOID_SANITIZED_TESTS)
    return()
  endif()
  list(JOIN TROCHOID_SANITIZED_ROOMS "|" rooms)
  if(NOT TROCHOID_SANITIZED_TESTS STREQUAL all
      AND NOT CMAKE_CURRENT_SOURCE_DIR MATCHES
        "/tests/(unit/(${rooms})|broken|fuzz|outside/linuxcnc)$")
    return()
  endif()
  if(TROCHOID_SANITIZED_TESTS STREQUAL all)
    trochoid_compile_sanitized(${name})
  else()
    trochoid_link_sanitized(${name})
  endif()
  target_link_libraries(${name}_sanitized PRIVATE trochoid_sanitized
    trochoid_compile_options GTest::gtest_main)
  add_test(NAME sanitized.${name} COMMAND ${name}_sanitized --gtest_brief=1)
  set_tests_properties(sanitized.${name} PROPERTIES
    ENVIRONMENT "UBSAN_OPTIONS=print_stacktrace=1")
endfunction()
