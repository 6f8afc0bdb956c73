# tahr_peers: Tahr beside the controllers of other engines (make peers). Each engine is a shared object of its own,
# lib/peer_NAME.so, built only when asked for by its name: what cannot be built is missing, and nothing else suffers.
# Rapier and PhysX come from tests/bench/peers/rust; tests/bench/peers/build.sh builds everything.
set(TAHR_JOLT_DIR "" CACHE PATH "Sources of Jolt (with Jolt/ and Build/), for peer_jolt")
set(peers ${PROJECT_SOURCE_DIR}/tests/bench/peers)

# peer_NAME of SOURCE, on top of the libraries that follow.
function(tahr_peer name source)
    add_library(peer_${name} MODULE EXCLUDE_FROM_ALL ${peers}/${source})
    set_target_properties(peer_${name} PROPERTIES PREFIX "" C_STANDARD 17 CXX_STANDARD 17
        C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    target_include_directories(peer_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/bench)
    target_link_libraries(peer_${name} PRIVATE tahr_flags ${ARGN})
endfunction()

if(TAHR_JOLT_DIR AND with_cxx)
    # As Jolt ships to players: without its profiler, asserts and debug drawing; with AVX2 and FMA, its defaults.
    foreach(option TARGET_UNIT_TESTS TARGET_HELLO_WORLD TARGET_PERFORMANCE_TEST TARGET_SAMPLES TARGET_VIEWER
            ENABLE_ALL_WARNINGS INTERPROCEDURAL_OPTIMIZATION GENERATE_DEBUG_SYMBOLS FLOATING_POINT_EXCEPTIONS_ENABLED
            PROFILER_IN_DEBUG_AND_RELEASE DEBUG_RENDERER_IN_DEBUG_AND_RELEASE)
        set(${option} OFF CACHE BOOL "" FORCE)
    endforeach()
    set(CMAKE_POSITION_INDEPENDENT_CODE ON)
    add_subdirectory(${TAHR_JOLT_DIR}/Build jolt EXCLUDE_FROM_ALL)
    unset(CMAKE_POSITION_INDEPENDENT_CODE)
    set_target_properties(Jolt PROPERTIES CXX_VISIBILITY_PRESET hidden)
    tahr_peer(jolt peer_jolt.cpp Jolt)
    target_include_directories(peer_jolt SYSTEM PRIVATE ${TAHR_JOLT_DIR})
endif()

if(with_cxx AND PkgConfig_FOUND)
    pkg_check_modules(bullet QUIET IMPORTED_TARGET bullet)
    if(bullet_FOUND)
        tahr_peer(bullet peer_bullet.cpp PkgConfig::bullet)
        target_compile_definitions(peer_bullet PRIVATE PEER_VERSION="${bullet_VERSION}")
    endif()
endif()

if(TARGET tahr_box2d_3)
    tahr_peer(box2d peer_box2d.c tahr_box2d_3 tahr_box2d_3_headers)
    target_sources(peer_box2d PRIVATE ${PROJECT_SOURCE_DIR}/tests/bench/method_outline.c)
    if(TAHR_BOX2D_3_ORIGIN)
        target_compile_definitions(peer_box2d PRIVATE PEER_BOX2D_ORIGIN)
    endif()
endif()

add_executable(tahr_peers EXCLUDE_FROM_ALL ${peers}/tahr_peers.c)
tahr_defaults(tahr_peers)
target_link_libraries(tahr_peers PRIVATE tahr_course ${CMAKE_DL_LIBS})
