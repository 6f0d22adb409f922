# ./run packages: a Debian package and an archive for other systems with Linux, by CPack;
# ./run windows: an archive and an installer for Windows. PackageKind.cmake says which parts go
# into which.
set(CPACK_PACKAGE_NAME trochoid)
set(CPACK_PACKAGE_VENDOR "The Trochoid authors")
set(CPACK_PACKAGE_CONTACT "The Trochoid authors")
set(CPACK_STRIP_FILES ON)
set(CPACK_TROCHOID_PROCESSOR ${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_TROCHOID_PROGRAM alone)
if(WIN32)
  set(CPACK_TROCHOID_PROGRAM windows)
  install(PROGRAMS $<TARGET_FILE:trochoid_cli> DESTINATION .
    COMPONENT windows EXCLUDE_FROM_ALL)
  trochoid_install_licences(windows mingw-w64-x86-64-dev gcc-mingw-w64-x86-64-posix
    libz-mingw-w64-dev)
  set(TROCHOID_DROP_FILES ${PROJECT_BINARY_DIR}/drop_files)
  include(${CMAKE_CURRENT_LIST_DIR}/windows/DropFiles.cmake)
  install(DIRECTORY ${TROCHOID_DROP_FILES}/ DESTINATION . COMPONENT windows EXCLUDE_FROM_ALL)

  # The installer has the same files, and is made of a template of ours.
  set(CPACK_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/windows)
  set(CPACK_NSIS_PACKAGE_NAME "Trochoid ${PROJECT_VERSION}")
  set(CPACK_NSIS_DISPLAY_NAME Trochoid)
  set(CPACK_NSIS_INSTALL_ROOT "$LOCALAPPDATA\\Programs")
  set(CPACK_PACKAGE_INSTALL_DIRECTORY Trochoid)
  set(CPACK_NSIS_COMPRESSOR "/SOLID lzma")
  set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
  install(FILES /usr/share/doc/nsis-common/copyright RENAME nsis DESTINATION licences
    COMPONENT installer EXCLUDE_FROM_ALL OPTIONAL)
endif()
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/PackageKind.cmake)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# What links to it is found by dpkg-shlibdeps. The module stands for one version of Python
# only, and the program needs none; the libraries are for those who link the static one.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libfmt-dev, libhwy-dev, libtomlplusplus-dev, \
nlohmann-json3-dev, zlib1g-dev, libhdf5-dev, pkg-config, python3-matplotlib, python3-pandas")
if(TARGET trochoid_python)
  get_property(minor GLOBAL PROPERTY TROCHOID_PYTHON_MINOR)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
    "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
endif()
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Computes what the teeth of a milling cutter with runout cut, and turns measured
forces, machined walls and frequency responses into cutting coefficients, runout,
modes and limits of chatter, with how well each is known.
.
The program trochoid, its library for C++ and its controller for C, a module for
Python, examples and documentation.")

# Where Debian's Python looks, whatever its version.
if(TARGET trochoid_python)
  install(TARGETS trochoid_python LIBRARY DESTINATION lib/python3/dist-packages/trochoid
    COMPONENT debian EXCLUDE_FROM_ALL)
  get_property(files GLOBAL PROPERTY TROCHOID_PYTHON_FILES)
  install(FILES ${files} DESTINATION lib/python3/dist-packages/trochoid
    COMPONENT debian EXCLUDE_FROM_ALL)
endif()
install(FILES ${CMAKE_CURRENT_LIST_DIR}/debian_copyright RENAME copyright
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT debian EXCLUDE_FROM_ALL)
trochoid_install_licences(debian libhdf5-dev libaec-dev)

include(CPack)
