# Installs the headers, tahr.pc and the package files for find_package(tahr).
install(FILES ${public_headers} ${cpp_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tahr)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# Paths in tahr.pc are relative to the file, so that an installed tree can be moved as a whole.
file(RELATIVE_PATH pc_to_prefix
    ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pc_to_prefix "${pc_to_prefix}")
# Who links an archive needs what it needs: a library with a folder or an option of its own stays as it is.
set(pc_libm)
if(TAHR_LIBM)
    set(pc_libm "-lm")
endif()
set(pc_dl ${CMAKE_DL_LIBS})
if(pc_dl MATCHES "^[A-Za-z]")
    set(pc_dl "-l${pc_dl}")
endif()
# The runtime of C++, for programs that are linked as C.
set(cxx_runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER cxx_runtime INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+)$")
set(pc_cxx)
if(cxx_runtime)
    set(pc_cxx "-l${cxx_runtime}")
endif()

# Writes NAME.pc. REQUIRES: other .pc files; PRIVATE: what the archive needs, and where there is only the archive
# everybody.
function(tahr_pc name description requires private)
    set(public)
    if(NOT TAHR_SHARED)
        set(public " ${private}")
        set(private)
    endif()
    configure_file(.cmake/tahr.pc.in ${name}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
tahr_pc(tahr "${PROJECT_DESCRIPTION}" "" "${pc_libm} ${pc_dl}")
foreach(backend ${backends})
    set(private "${pc_of_${backend}}")
    if(backend IN_LIST cxx_backends)
        string(APPEND private " ${pc_cxx}")
    endif()
    tahr_pc(tahr_${backend} "Backend ${backend} of tahr" tahr "${private} ${pc_libm}")
endforeach()

if(with_threads)
    # An archive alone: who links it needs what it needs.
    set(shared ${TAHR_SHARED})
    set(TAHR_SHARED OFF)
    tahr_pc(tahr_threads "Pool of threads for the crowds of tahr" tahr "-pthread")
    set(TAHR_SHARED ${shared})
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tahr)
configure_package_config_file(.cmake/tahr-config.cmake.in tahr-config.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 the minor number is the compatible range.
write_basic_package_version_file(tahr-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tahr-config.cmake ${PROJECT_BINARY_DIR}/tahr-config-version.cmake
    DESTINATION ${package_dir})
install(EXPORT tahr-targets NAMESPACE tahr:: DESTINATION ${package_dir})
if(with_threads)
    install(EXPORT tahr-threads-targets NAMESPACE tahr:: DESTINATION ${package_dir})
endif()
foreach(backend ${backends})
    install(EXPORT tahr-${backend}-targets NAMESPACE tahr:: DESTINATION ${package_dir})
endforeach()
