# Files of one room are compiled together, about 120 kB a unit: what they include is parsed
# once a unit and not once a file. Therefore two files of a room have no names in common in
# their unnamed namespaces, and a test file has a namespace of its own. The preset `dev` and
# -DTROCHOID_UNITY=OFF compile every file by itself, and find the file that lacks an include.
option(TROCHOID_UNITY "Compile the files of a room together" ON)

# Rooms that read and write words. Their units are compiled with -O1 after the flags of a
# release: a third of their time. A million rows of simulate, a record of identify and a sweep
# of 2000 rows took 1 to 2 % more CPU for it (medians of nine pairs).
set(rooms_of_words results cases report run sweep cli python)
set(flags_of_words $<$<CONFIG:Release>:-O1>)

# trochoid_unity(TARGET [BYTES]): group the sources of a target by their folder under src or
# tests; 120 kB a unit, or what BYTES says. A source that has a UNITY_GROUP keeps it.
function(trochoid_unity target)
  if(NOT TROCHOID_UNITY)
    return()
  endif()
  set(most 120000)
  if(ARGC GREATER 1)
    set(most ${ARGV1})
  endif()
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} NORMALIZE)
    # Not what is made by the build.
    if(NOT source MATCHES "^${PROJECT_SOURCE_DIR}/(src/trochoid|tests)/([^/]+)/.*\\.cpp$")
      continue()
    endif()
    set(room ${CMAKE_MATCH_2})
    get_source_file_property(alone ${source} TARGET_DIRECTORY ${target}
      SKIP_UNITY_BUILD_INCLUSION)
    get_source_file_property(group ${source} TARGET_DIRECTORY ${target} UNITY_GROUP)
    # Highway compiles such a file once for each width of vectors.
    file(STRINGS ${source} vectors REGEX "foreach_target" LIMIT_COUNT 1)
    if(vectors OR alone)
      continue()
    endif()
    if(NOT group)
      file(SIZE ${source} bytes)
      math(EXPR bytes_of_${room} "0${bytes_of_${room}} + ${bytes}")
      if(bytes_of_${room} GREATER most)
        set(bytes_of_${room} ${bytes})
        math(EXPR part_of_${room} "0${part_of_${room}} + 1")
      endif()
      set(group ${room}${part_of_${room}})
      set_source_files_properties(${source} TARGET_DIRECTORY ${target}
        PROPERTIES UNITY_GROUP ${group})
    endif()
    if(room IN_LIST rooms_of_words)
      get_target_property(build ${target} BINARY_DIR)
      set_source_files_properties(
        ${build}/CMakeFiles/${target}.dir/Unity/unity_${group}_cxx.cxx
        TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS "${flags_of_words}")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
