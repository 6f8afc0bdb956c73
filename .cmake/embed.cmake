# Writes a C file OUT that holds every one of FILES as an array of bytes, ended by a zero that its size does not count:
# side.tmj becomes level_side_tmj and level_side_tmj_size. Strings would be longer than compilers promise to take.
set(text "/* Made by embed.cmake. */\n")
foreach(file ${FILES})
    get_filename_component(name ${file} NAME)
    string(MAKE_C_IDENTIFIER "level_${name}" name)
    file(READ ${file} bytes HEX)
    string(REGEX REPLACE "(................................................................)" "\\1\n" bytes "${bytes}")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
    string(APPEND text "extern const unsigned char ${name}[];\nextern const unsigned long ${name}_size;\n"
        "const unsigned char ${name}[] = {\n${bytes}0};\nconst unsigned long ${name}_size = sizeof ${name} - 1;\n")
endforeach()
file(WRITE ${OUT} "${text}")
