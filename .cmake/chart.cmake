# The program that measures what `make chart` draws.
file(GLOB chart_sources CONFIGURE_DEPENDS tests/bench/chart/*.c)
if(chart_sources AND PROJECT_IS_TOP_LEVEL)
    foreach(helper backend level mesh obj solid tiles wander)
        list(APPEND chart_sources tests/support/scene_${helper}.c)
    endforeach()
    add_executable(tahr_chart ${chart_sources} tests/bench/bench_world.c tests/bench/bench_query.c)
    tahr_defaults(tahr_chart)
    target_include_directories(tahr_chart PRIVATE tests/support tests/bench)
    string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
    target_compile_definitions(tahr_chart PRIVATE TAHR_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
        TAHR_CHART_FLAGS="${CMAKE_C_FLAGS} ${CMAKE_C_FLAGS_${build_type}} -std=c11 -ffp-contract=off -fno-math-errno")
    target_link_libraries(tahr_chart PRIVATE tahr_program)
endif()
