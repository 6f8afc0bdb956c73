# The telemetry sink on LCM: libtahr_lcm.a, and the types of its messages, generated from backends/lcm/types by lcm-gen.
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
    set(lcm_generated ${PROJECT_BINARY_DIR}/lcm)
    set(lcm_type_sources)
    set(lcm_type_headers)
    foreach(type ${lcm_types})
        get_filename_component(name ${type} NAME_WE)
        list(APPEND lcm_type_sources ${lcm_generated}/tahr_${name}.c)
        list(APPEND lcm_type_headers ${lcm_generated}/tahr_${name}.h)
    endforeach()
    add_custom_command(OUTPUT ${lcm_type_sources} ${lcm_type_headers}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${lcm_generated}
        COMMAND ${TAHR_LCM_GEN} --c --c-cpath ${lcm_generated} --c-hpath ${lcm_generated} ${lcm_types}
        DEPENDS ${lcm_types} VERBATIM)
    # Generated code is not held to our warnings.
    add_library(tahr_lcm_types OBJECT ${lcm_type_sources} ${lcm_type_headers})
    set_target_properties(tahr_lcm_types PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_include_directories(tahr_lcm_types SYSTEM PUBLIC ${lcm_generated} ${TAHR_LCM_INCLUDE})
endif()
