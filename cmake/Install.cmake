# cmake --install: the program, the library, its headers and find_package(trochoid).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/trochoid)
install(TARGETS trochoid EXPORT trochoidTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS trochoid_cli)
install(EXPORT trochoidTargets NAMESPACE trochoid:: DESTINATION ${package})
configure_package_config_file(cmake/trochoidConfig.cmake.in trochoidConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(trochoidConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/trochoidConfig.cmake
  ${PROJECT_BINARY_DIR}/trochoidConfigVersion.cmake DESTINATION ${package})
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
