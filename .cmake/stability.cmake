# The stability matrix: everything but main is a library of its own, so that tests reach the parts.
file(GLOB stability_sources CONFIGURE_DEPENDS tests/stability/*.c)
list(FILTER stability_sources EXCLUDE REGEX "/(test_.*|tahr_stability)\\.c$")
foreach(helper engine mutant oracle scene_mesh scene_solid)
    list(APPEND stability_sources tests/support/${helper}.c)
endforeach()
add_library(tahr_stability_parts STATIC EXCLUDE_FROM_ALL
    ${stability_sources})
tahr_defaults(tahr_stability_parts)
target_include_directories(tahr_stability_parts PUBLIC tests/stability tests/support)
target_link_libraries(tahr_stability_parts PUBLIC tahr_program)
add_executable(tahr_stability EXCLUDE_FROM_ALL tests/stability/tahr_stability.c)
tahr_defaults(tahr_stability)
target_link_libraries(tahr_stability PRIVATE tahr_stability_parts)
