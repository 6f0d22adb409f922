# trochoid.exe, which needs nothing of its Windows but what each has: everything is linked
# into it. Records in HDF5 are refused in words, for Debian has no such library for it.
include(cmake/HeadersAlone.cmake)
enable_language(RC)
set(ZLIB_USE_STATIC_LIBS ON)  # its DLL is a part of wine and not of Windows
find_package(ZLIB)

# What all computers that run this Windows have. Not AVX: this compiler takes the stack to
# be aligned for its values, and here it is not (GCC bug 54412). Not MMX: the compiler moves
# numbers through its registers, which are those of the x87, and does not free them; exp of
# this C library computes with the x87 and then gives NaN.
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:-march=x86-64-v2;-mno-mmx>")
add_compile_definitions(HWY_COMPILE_ONLY_STATIC WIN32_LEAN_AND_MEAN NOMINMAX
  _WIN32_WINNT=0x0A00 __USE_MINGW_ANSI_STDIO=1)
add_link_options(-static)
# Text is UTF-8, also in names of files, which the C library does not know.
add_library(trochoid_utf8 OBJECT ${PROJECT_SOURCE_DIR}/cmake/windows/utf8.cpp
  ${PROJECT_SOURCE_DIR}/cmake/windows/utf8.rc)
target_compile_features(trochoid_utf8 PRIVATE cxx_std_20)
# In its archive, documents and examples lie beside it.
set(CMAKE_INSTALL_DOCDIR .)
