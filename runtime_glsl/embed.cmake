# SPDX-License-Identifier: Apache-2.0 OR MIT
# cmake -DOUTPUT=file.cpp -DINPUTS=a.glsl|b.glsl -P embed.cmake
# Writes the texts as C++ strings: a table of file names and contents for host/shader_source.cpp.
string(REPLACE "|" ";" inputs "${INPUTS}")
set(text "// Generated from the .glsl files by embed.cmake.\n#include \"runtime_glsl/host/embedded_shaders.h\"\n\n")
string(APPEND text "namespace fetex {\n\nconst EmbeddedShader kEmbeddedShaders[] = {\n")
foreach(input IN LISTS inputs)
  get_filename_component(name "${input}" NAME)
  file(READ "${input}" content)
  string(APPEND text "    {\"${name}\", R\"fetex(${content})fetex\"},\n")
endforeach()
string(APPEND text "    {nullptr, nullptr},\n};\n\n} // namespace fetex\n")
file(WRITE "${OUTPUT}" "${text}")
