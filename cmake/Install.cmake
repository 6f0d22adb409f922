# cmake --install: the program, the libraries with their headers, find_package(trochoid) and
# pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Libraries of other formats that were there: what a static library links as well.
set(TROCHOID_OPTIONAL_REQUIRES "")
if(ZLIB_FOUND)
  string(APPEND TROCHOID_OPTIONAL_REQUIRES ", zlib")
endif()
if(hdf5_FOUND)
  string(APPEND TROCHOID_OPTIONAL_REQUIRES ", hdf5-serial")
endif()

# Two exports: what needs the controller only must find nothing else.
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/trochoid)
install(TARGETS trochoid_controller EXPORT trochoidControllerTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS trochoid EXPORT trochoidTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS trochoid_cli)
foreach(set trochoidControllerTargets trochoidTargets)
  install(EXPORT ${set} NAMESPACE trochoid:: DESTINATION ${package})
endforeach()
configure_package_config_file(cmake/trochoidConfig.cmake.in trochoidConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(trochoidConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/trochoidConfig.cmake
  ${PROJECT_BINARY_DIR}/trochoidConfigVersion.cmake DESTINATION ${package})

# The place of a .pc file tells where the rest is, wherever all of it is moved.
set(pkgconfig ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH TROCHOID_PREFIX
  ${CMAKE_INSTALL_PREFIX}/${pkgconfig} ${CMAKE_INSTALL_PREFIX})
get_target_property(type trochoid TYPE)
set(TROCHOID_REQUIRES_KEY Requires)  # of a static library all is needed to link it
if(type STREQUAL SHARED_LIBRARY)
  set(TROCHOID_REQUIRES_KEY Requires.private)
endif()
foreach(name trochoid trochoid-controller)
  configure_file(cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${pkgconfig})
endforeach()

# Pages and examples, as far from one another as their links have it; without the answers
# of who ran the examples here.
install(FILES LICENSE README.md CHANGELOG.md ARCHITECTURE.md CONTRIBUTING.md CITATION.cff
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
install(DIRECTORY docs examples linuxcnc matlab DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT documents
  REGEX "\\.(simulate|identify|check|surface|calibrate|stability|modes|actuator|dynamics|correct|plan|program|sweep)$" EXCLUDE
  PATTERN __pycache__ EXCLUDE)

# The licences of what is linked into a program that stands alone, as Debian has them:
# trochoid_install_licences(COMPONENT PACKAGE...), besides those of the headers it is built on.
function(trochoid_install_licences component)
  foreach(package ${ARGN} libfmt-dev libhwy-dev libtomlplusplus-dev nlohmann-json3-dev
      libcli11-dev libeigen3-dev libboost-dev)
    install(FILES /usr/share/doc/${package}/copyright RENAME ${package}
      DESTINATION ${CMAKE_INSTALL_DOCDIR}/licences COMPONENT ${component} EXCLUDE_FROM_ALL
      OPTIONAL)
  endforeach()
  foreach(module uplot write-excel-file fflate)  # within the reports
    install(FILES ${PROJECT_SOURCE_DIR}/node_modules/${module}/LICENSE RENAME ${module}
      DESTINATION ${CMAKE_INSTALL_DOCDIR}/licences COMPONENT ${component} EXCLUDE_FROM_ALL)
  endforeach()
endfunction()
