# Read by CPack for each kind of package: what goes into it.
if(CPACK_GENERATOR STREQUAL "DEB")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_COMPONENTS_ALL Unspecified documents debian)
else()
  string(TOLOWER ${CPACK_SYSTEM_NAME} system)
  if(system STREQUAL "win64")
    set(system windows)
  endif()
  set(CPACK_PACKAGE_FILE_NAME
    ${CPACK_PACKAGE_NAME}-${CPACK_PACKAGE_VERSION}-${system}-${CPACK_TROCHOID_PROCESSOR})
  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
  set(CPACK_COMPONENTS_ALL ${CPACK_TROCHOID_PROGRAM} documents)
endif()
