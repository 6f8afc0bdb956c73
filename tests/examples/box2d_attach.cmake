# Needs Box2D 2.4, and a backend that was built with it.
if("TAHR_BOX2D_HAS_2" IN_LIST box2d_defines)
    set(example_libraries box2d::box2d)
else()
    set(example_left_out "Box2D 2.4 was not found")
endif()
