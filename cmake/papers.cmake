# Man pages and completions, written by the program itself, and where shells and man(1) look for them.
set(papers ${PROJECT_BINARY_DIR}/papers)
set(shells bash zsh fish)
list(TRANSFORM shells REPLACE "(.+)" "${papers}/gable.\\1" OUTPUT_VARIABLE completions)
set(commands)
foreach(shell ${shells})
  list(APPEND commands COMMAND gable completion ${shell} > ${papers}/gable.${shell})
endforeach()
find_program(GABLE_GZIP gzip)
if(GABLE_GZIP)
  list(APPEND commands COMMAND sh -c [["$0" -9nf "$1"/man1/*.1]] ${GABLE_GZIP} ${papers})
endif()
add_custom_command(OUTPUT ${completions} ${papers}/done
                   COMMAND ${CMAKE_COMMAND} -E rm -rf ${papers}
                   COMMAND ${CMAKE_COMMAND} -E make_directory ${papers}
                   COMMAND gable man -o ${papers}/man1 ${commands}
                   COMMAND ${CMAKE_COMMAND} -E touch ${papers}/done
                   DEPENDS gable COMMENT "Writing man pages and completions" VERBATIM)
add_custom_target(papers ALL DEPENDS ${papers}/done)

install(DIRECTORY ${papers}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
install(FILES ${papers}/gable.bash DESTINATION share/bash-completion/completions RENAME gable COMPONENT program)
# Debian's zsh looks into vendor-completions, others into site-functions.
install(FILES ${papers}/gable.zsh DESTINATION share/zsh/site-functions RENAME _gable COMPONENT program)
install(FILES ${papers}/gable.zsh DESTINATION share/zsh/vendor-completions RENAME _gable
        COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES ${papers}/gable.fish DESTINATION share/fish/vendor_completions.d COMPONENT program)
