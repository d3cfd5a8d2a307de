# Turns text files into a C++ source: cmake -DOUTPUT=FILE -DNAMES=a,b -DFILES=FILE,FILE -P embed.cmake
# gives `extern const std::string_view` constants of namespace ninebit, one a file.
string(REPLACE "," ";" names "${NAMES}")
string(REPLACE "," ";" files "${FILES}")
set(source "// Made by embed.cmake.\n#include \"src/study/report/page_texts.h\"\n\nnamespace ninebit {\n")
foreach(name file IN ZIP_LISTS names files)
  file(READ "${file}" text)
  string(FIND "${text}" ")ninebit\"" delimiter)
  if(NOT delimiter EQUAL -1)
    message(FATAL_ERROR "${file} holds the end mark of the literal that it should stand in")
  endif()
  string(APPEND source "\nconst std::string_view ${name} = R\"ninebit(${text})ninebit\";\n")
endforeach()
file(WRITE "${OUTPUT}" "${source}\n}  // namespace ninebit\n")
