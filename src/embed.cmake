# Turns text files into a C++ source:
# cmake -DOUTPUT=FILE -DHEADER=src/… -DNAMESPACE=ninebit -DNAMES=a,b -DFILES=FILE,FILE -P embed.cmake
# defines one `extern const std::string_view` constant, which the header declares, in the namespace for each file.
string(REPLACE "," ";" names "${NAMES}")
string(REPLACE "," ";" files "${FILES}")
set(source "// Made by embed.cmake.\n#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n")
foreach(name file IN ZIP_LISTS names files)
  file(READ "${file}" text)
  string(FIND "${text}" ")ninebit\"" delimiter)
  if(NOT delimiter EQUAL -1)
    message(FATAL_ERROR "${file} contains )ninebit\", the end of the raw string literal that would hold it")
  endif()
  string(APPEND source "\nconst std::string_view ${name} = R\"ninebit(${text})ninebit\";\n")
endforeach()
file(WRITE "${OUTPUT}" "${source}\n}  // namespace ${NAMESPACE}\n")
