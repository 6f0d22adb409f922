# trochoid_hold_hdf5(TARGET): the program holds HDF5 and what it needs, where Debian's static
# libraries are here. The shared one brings thirty more with it (curl, Kerberos), and loading
# them takes half of a start. TROCHOID_STATIC_HDF5 names the archives, empty without them.
set(TROCHOID_STATIC_HDF5 "")
if(hdf5_FOUND AND CMAKE_SYSTEM_NAME STREQUAL Linux)
  foreach(name hdf5 sz aec)
    find_library(TROCHOID_STATIC_${name} lib${name}.a HINTS ${hdf5_LIBRARY_DIRS})
    mark_as_advanced(TROCHOID_STATIC_${name})
    if(NOT TROCHOID_STATIC_${name})
      set(TROCHOID_STATIC_HDF5 "")
      break()
    endif()
    list(APPEND TROCHOID_STATIC_HDF5 ${TROCHOID_STATIC_${name}})
  endforeach()
endif()

function(trochoid_hold_hdf5 target)
  if(TROCHOID_STATIC_HDF5)
    # After the library that calls it, before the shared one, which is then not needed.
    target_link_libraries(${target} PRIVATE ${TROCHOID_STATIC_HDF5} ${CMAKE_DL_LIBS})
    target_link_options(${target} PRIVATE LINKER:--as-needed)
  endif()
endfunction()
