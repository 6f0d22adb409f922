# trochoid_alone: the program that needs nothing of its system but the kernel, not even the
# C library. The objects are those of the program; what Debian has no static library of
# (fmt, toml++, Highway) comes from files of ours, which the linker takes first. It is
# for ./run packages, and there is none where a static library is missing.
if(NOT CMAKE_SYSTEM_NAME STREQUAL Linux OR TROCHOID_SANITIZE OR BUILD_SHARED_LIBS)
  return()
endif()

set(static ${TROCHOID_STATIC_HDF5})
if(hdf5_FOUND AND NOT static)
  message(STATUS "libhdf5.a, libsz.a or libaec.a is not here: no program that stands alone")
  return()
endif()
if(hdf5_FOUND OR ZLIB_FOUND)
  find_library(TROCHOID_STATIC_z libz.a)
  mark_as_advanced(TROCHOID_STATIC_z)
  if(NOT TROCHOID_STATIC_z)
    message(STATUS "libz.a is not here: no program that stands alone")
    return()
  endif()
  list(APPEND static ${TROCHOID_STATIC_z})
endif()

set(sources ${PROJECT_SOURCE_DIR}/src/trochoid)
add_executable(trochoid_alone EXCLUDE_FROM_ALL $<TARGET_OBJECTS:trochoid_cli>
  ${sources}/cli/alone/format.cpp
  ${sources}/cli/alone/toml.cpp
  ${sources}/cli/alone/vectors.cpp)
set_target_properties(trochoid_alone PROPERTIES OUTPUT_NAME trochoid CXX_EXTENSIONS OFF
  RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/alone)
target_compile_features(trochoid_alone PRIVATE cxx_std_20)
target_include_directories(trochoid_alone PRIVATE ${PROJECT_SOURCE_DIR}/src)
add_dependencies(trochoid_alone trochoid trochoid_controller)
# As files: as a target the library would bring the shared ones that it links.
target_link_libraries(trochoid_alone PRIVATE trochoid_compile_options trochoid_hardening
  $<TARGET_FILE:trochoid> $<TARGET_FILE:trochoid_controller> ${static} ${CMAKE_DL_LIBS} m)
target_link_options(trochoid_alone PRIVATE -static-pie -Wl,-z,relro,-z,now)
set_property(TARGET trochoid_alone APPEND PROPERTY LINK_DEPENDS
  $<TARGET_FILE:trochoid> $<TARGET_FILE:trochoid_controller>)

install(PROGRAMS $<TARGET_FILE:trochoid_alone> DESTINATION ${CMAKE_INSTALL_BINDIR}
  COMPONENT alone EXCLUDE_FROM_ALL)
trochoid_install_licences(alone libc6-dev libstdc++-12-dev libhdf5-dev libaec-dev zlib1g-dev)
