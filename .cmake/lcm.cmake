# The telemetry sink on LCM: libtahr_lcm.a, and the types of its messages, generated from backends/lcm/types by lcm-gen
# for C (in the archive, headers <tahr_lcm/tahr_state_t.h>) and Python (a package `tahr`).
set(TAHR_SINK_LCM AUTO CACHE STRING "The telemetry sink on LCM (liblcm, lcm-gen; needs TAHR_THREADS): AUTO, ON, OFF")
# liblcm's own .pc file asks for glib's, which its development package does not bring: the library is enough.
find_library(TAHR_LIBLCM lcm)
find_path(TAHR_LCM_INCLUDE lcm/lcm.h)
find_program(TAHR_LCM_GEN lcm-gen)
mark_as_advanced(TAHR_LIBLCM TAHR_LCM_INCLUDE TAHR_LCM_GEN)
set(found OFF)
if(TAHR_LIBLCM AND TAHR_LCM_INCLUDE AND TAHR_LCM_GEN AND with_threads)
    set(found ON)
endif()
tahr_decide(TAHR_SINK_LCM ${found} "liblcm, lcm-gen or threads were not found" with_lcm)
if(with_lcm)
    file(GLOB lcm_types CONFIGURE_DEPENDS backends/lcm/types/*.lcm)
    set(lcm_include ${PROJECT_BINARY_DIR}/lcm)
    set(lcm_generated ${lcm_include}/tahr_lcm)
    set(lcm_python ${lcm_include}/python)
    set(lcm_type_sources)
    set(lcm_type_headers)
    set(lcm_type_modules ${lcm_python}/tahr/__init__.py)
    foreach(type ${lcm_types})
        get_filename_component(name ${type} NAME_WE)
        list(APPEND lcm_type_sources ${lcm_generated}/tahr_${name}.c)
        list(APPEND lcm_type_headers ${lcm_generated}/tahr_${name}.h)
        list(APPEND lcm_type_modules ${lcm_python}/tahr/${name}.py)
    endforeach()
    add_custom_command(OUTPUT ${lcm_type_sources} ${lcm_type_headers}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${lcm_generated}
        COMMAND ${TAHR_LCM_GEN} --c --c-cpath ${lcm_generated} --c-hpath ${lcm_generated} ${lcm_types}
        DEPENDS ${lcm_types} VERBATIM)
    # lcm-gen adds to an __init__.py that is there: each run begins without one.
    add_custom_command(OUTPUT ${lcm_type_modules}
        COMMAND ${CMAKE_COMMAND} -E rm -rf ${lcm_python}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${lcm_python}
        COMMAND ${TAHR_LCM_GEN} --python --ppath ${lcm_python} ${lcm_types}
        DEPENDS ${lcm_types} VERBATIM)
    add_custom_target(tahr_lcm_python ALL DEPENDS ${lcm_type_modules})
    # Generated code is not held to our warnings.
    add_library(tahr_lcm_types OBJECT ${lcm_type_sources} ${lcm_type_headers})
    set_target_properties(tahr_lcm_types PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_include_directories(tahr_lcm_types SYSTEM PUBLIC ${lcm_include} ${TAHR_LCM_INCLUDE})

    file(GLOB lcm_sources CONFIGURE_DEPENDS backends/lcm/*.c)
    add_library(tahr_lcm_core OBJECT ${lcm_sources})
    add_dependencies(tahr_lcm_core tahr_lcm_types) # for their headers
    tahr_defaults(tahr_lcm_core)
    target_include_directories(tahr_lcm_core PRIVATE include)
    target_include_directories(tahr_lcm_core SYSTEM PRIVATE ${lcm_include} ${TAHR_LCM_INCLUDE})
    target_compile_definitions(tahr_lcm_core PRIVATE TAHR_BUILD _POSIX_C_SOURCE=200809L)
    set_target_properties(tahr_lcm_core PROPERTIES POSITION_INDEPENDENT_CODE ON)
    tahr_library(tahr_lcm_static STATIC tahr_lcm tahr-lcm-targets tahr_lcm_core tahr_lcm_types)
    # Installed, the package file names the library where it is found then.
    target_link_libraries(tahr_lcm_static PUBLIC $<BUILD_INTERFACE:${TAHR_LIBLCM}>)
    target_include_directories(tahr_lcm_static SYSTEM INTERFACE
        $<BUILD_INTERFACE:${lcm_include}> $<BUILD_INTERFACE:${TAHR_LCM_INCLUDE}>)
    add_library(tahr::tahr_lcm_static ALIAS tahr_lcm_static)
    list(APPEND products tahr_lcm_static tahr_lcm_python)
    list(APPEND program_links tahr_lcm_static)
    list(APPEND program_defines TAHR_HAVE_LCM=1)
endif()
