# The man page and what the shells complete, from the table that --help tells of.
set(manual ${PROJECT_BINARY_DIR}/manual)
set(made "")
function(trochoid_manual kind file destination)
  add_custom_command(OUTPUT ${manual}/${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${manual}
    COMMAND trochoid_cli --manual ${kind} > ${manual}/${file}
    DEPENDS trochoid_cli)
  set(made ${made} ${manual}/${file} PARENT_SCOPE)
  install(FILES ${manual}/${file} DESTINATION ${destination} COMPONENT documents ${ARGN})
endfunction()
set(share ${CMAKE_INSTALL_DATADIR})
trochoid_manual(man trochoid.1 ${CMAKE_INSTALL_MANDIR}/man1)
trochoid_manual(bash trochoid.bash ${share}/bash-completion/completions RENAME trochoid)
trochoid_manual(zsh _trochoid ${share}/zsh/vendor-completions)
trochoid_manual(fish trochoid.fish ${share}/fish/vendor_completions.d)
add_custom_target(trochoid_manual ALL DEPENDS ${made})
