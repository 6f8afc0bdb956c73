if(NOT with_threads)
    set(example_left_out "there are no threads")
endif()
