# cmake --install BUILD --prefix DIR: the program, its manual page and completion, the scenarios, the tools that draw,
# the batch scripts, and the documents. The libraries are parts of the program and are not installed.
if(TARGET scree)
  install(TARGETS scree RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(FILES ${PROJECT_SOURCE_DIR}/tools/man/scree.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
# bash-completion looks for a file with the program's name.
install(FILES ${PROJECT_SOURCE_DIR}/tools/completion/scree.bash
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME scree)

set(SCREE_DATA_DIR ${CMAKE_INSTALL_DATADIR}/scree)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios DESTINATION ${SCREE_DATA_DIR}
        FILES_MATCHING PATTERN "*.yaml" PATTERN "*.json" PATTERN "*.txt" PATTERN "*.md"
        PATTERN "CMakeLists.txt" EXCLUDE)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/plot_run.py ${PROJECT_SOURCE_DIR}/tools/plot_ranks.py
        ${PROJECT_SOURCE_DIR}/tools/render.py DESTINATION ${SCREE_DATA_DIR}/tools)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/slurm DESTINATION ${SCREE_DATA_DIR}/tools)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/pictures DESTINATION ${SCREE_DATA_DIR}/tools
        FILES_MATCHING PATTERN "*.py")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CITATION.cff ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
