# Needs Box2D 3, and a backend that was built with it.
if("TAHR_BOX2D_HAS_3" IN_LIST box2d_defines)
    set(example_libraries ${box2d_3} ${box2d_3_headers})
else()
    set(example_left_out "Box2D 3 was not found")
endif()
