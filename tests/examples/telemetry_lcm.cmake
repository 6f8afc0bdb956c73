if(NOT with_lcm)
    set(example_left_out "LCM was not found")
endif()
