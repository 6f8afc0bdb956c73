# The C++ binding: headers, and no library of its own. In the build folder they lie where installing will put them, so
# that <tahr/tahr.hpp> is their name everywhere.
file(GLOB cpp_headers CONFIGURE_DEPENDS bindings/cpp/*.hpp)
foreach(header ${cpp_headers})
    get_filename_component(name ${header} NAME)
    configure_file(${header} ${PROJECT_BINARY_DIR}/cpp/tahr/${name} COPYONLY)
endforeach()
add_library(tahr_cpp INTERFACE)
target_compile_features(tahr_cpp INTERFACE cxx_std_17)
target_include_directories(tahr_cpp INTERFACE
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/cpp> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
if(TAHR_SHARED)
    target_link_libraries(tahr_cpp INTERFACE tahr)
else()
    target_link_libraries(tahr_cpp INTERFACE tahr_static)
endif()
add_library(tahr::tahr_cpp ALIAS tahr_cpp)
install(TARGETS tahr_cpp EXPORT tahr-targets)
