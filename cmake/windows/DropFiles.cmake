# The files on which a case is dropped, with line ends of Windows:
# cmake -D TROCHOID_DROP_FILES=FOLDER -P DropFiles.cmake
function(trochoid_drop_file name command stay_open what)
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/drop.cmd.in
    "${TROCHOID_DROP_FILES}/${name}.cmd" @ONLY NEWLINE_STYLE CRLF)
endfunction()
trochoid_drop_file("Check a case" "check " 1
  "Trochoid names every mistake in a case and in its measurements.")
trochoid_drop_file("Compute a case" "" ""
  "Trochoid computes what a case asks for, and shows the report in the browser.")
