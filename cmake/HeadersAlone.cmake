# What the library is built on, for a system that Debian has no libraries of: headers
# alone, linked into a folder of their own, for /usr/include is that of this machine.
set(from /usr/include)
set(here ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${here})
foreach(part eigen3/Eigen eigen3/unsupported fmt hwy toml++ nlohmann CLI boost)
  if(NOT EXISTS ${from}/${part})
    message(FATAL_ERROR "${from}/${part} is not here: tools/setup.sh installs it")
  endif()
  get_filename_component(name ${part} NAME)
  file(CREATE_LINK ${from}/${part} ${here}/${name} SYMBOLIC)
endforeach()

foreach(name Eigen3::Eigen hwy::hwy tomlplusplus::tomlplusplus
             nlohmann_json::nlohmann_json CLI11::CLI11 fmt::fmt)
  add_library(${name} INTERFACE IMPORTED)
  target_include_directories(${name} INTERFACE ${here})
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
