# Makes a C++ source that holds every shader file and the layout slice of minirt.h as strings: OUTPUT from the files below SHADER_DIR.
# Run as a script: cmake -DSHADER_DIR=.. -DHEADER=.. -DOUTPUT=.. -P EmbedShaders.cmake
file(GLOB_RECURSE files RELATIVE ${SHADER_DIR} ${SHADER_DIR}/*.glsl ${SHADER_DIR}/*.comp)
list(SORT files)

file(READ ${HEADER} layout)
string(REGEX REPLACE ".*/\\* layout-begin \\*/(.*)/\\* layout-end \\*/.*" "\\1" layout "${layout}")

set(text "// Made by cmake/EmbedShaders.cmake.\n#include \"shader_library.hpp\"\n\nnamespace minirtc {\n\nconst std::map<std::string, std::string>& shaderLibrary() {\n    static const std::map<std::string, std::string> files = {\n")
string(APPEND text "        {\"layout\", R\"~~~(${layout})~~~\"},\n")
foreach(file ${files})
    file(READ ${SHADER_DIR}/${file} content)
    string(APPEND text "        {\"${file}\", R\"~~~(${content})~~~\"},\n")
endforeach()
string(APPEND text "    };\n    return files;\n}\n\n}  // namespace minirtc\n")
file(WRITE ${OUTPUT} "${text}")
