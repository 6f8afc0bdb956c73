# Installs the headers, tahr.pc and the package files for find_package(tahr).
install(FILES ${public_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tahr)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# Paths in tahr.pc are relative to the file, so that an installed tree can be moved as a whole.
file(RELATIVE_PATH pc_to_prefix
    ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pc_to_prefix "${pc_to_prefix}")
# Libraries with a folder or -l of their own stay as they are; "dl" becomes -ldl.
string(REGEX REPLACE "^([A-Za-z])" "-l\\1" pc_dl "${CMAKE_DL_LIBS}")
configure_file(.cmake/tahr.pc.in tahr.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/tahr.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tahr)
configure_package_config_file(.cmake/tahr-config.cmake.in tahr-config.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 the minor number is the compatible range.
write_basic_package_version_file(tahr-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tahr-config.cmake ${PROJECT_BINARY_DIR}/tahr-config-version.cmake
    DESTINATION ${package_dir})
install(EXPORT tahr-targets NAMESPACE tahr:: DESTINATION ${package_dir})
foreach(backend ${backends})
    install(EXPORT tahr-${backend}-targets NAMESPACE tahr:: DESTINATION ${package_dir})
endforeach()
