# For the browser: Emscripten's compiler, one thread, files that live in memory alone.
include(cmake/HeadersAlone.cmake)
add_compile_definitions(HWY_COMPILE_ONLY_EMU128)  # one set of instructions for all

add_compile_options(-fwasm-exceptions)
add_link_options(-fwasm-exceptions)
# libc++ 13 lacks some of C++20.
set(missing ${PROJECT_SOURCE_DIR}/cmake/web/libcxx13)
include_directories(SYSTEM ${PROJECT_SOURCE_DIR}/cmake/web/include)
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${missing}.h>")
add_library(trochoid_missing STATIC ${missing}.cpp)
target_compile_features(trochoid_missing PRIVATE cxx_std_20)
target_link_libraries(trochoid_missing PRIVATE fmt::fmt)
link_libraries($<BUILD_INTERFACE:trochoid_missing>)
# Node of another source than Debian's does not look where Debian's libraries for it are.
set(CMAKE_CXX_LINKER_LAUNCHER env NODE_PATH=/usr/share/nodejs)
