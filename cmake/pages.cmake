# Writes a C++ file with the pages of docs/reference as texts: cmake -DFOLDER=.. -DOUT=.. -P pages.cmake
file(GLOB_RECURSE pages RELATIVE ${FOLDER} ${FOLDER}/*.md)
list(SORT pages)
set(mark "pg~")
file(WRITE ${OUT}.new "// Made by cmake/pages.cmake from docs/reference.\n#include <cstddef>\n\nnamespace gable::language {\n\n"
  "struct PageFile {\n  const char* path;\n  const char* text;\n};\n\nextern const PageFile kPageFiles[];\nextern const size_t kPageFileCount;\n\n"
  "const PageFile kPageFiles[] = {\n")
set(count 0)
foreach(page IN LISTS pages)
  file(READ ${FOLDER}/${page} text)
  file(APPEND ${OUT}.new "    {\"${page}\", R\"${mark}(${text})${mark}\"},\n")
  math(EXPR count "${count} + 1")
endforeach()
file(APPEND ${OUT}.new "};\nconst size_t kPageFileCount = ${count};\n\n}  // namespace gable::language\n")
file(COPY_FILE ${OUT}.new ${OUT} ONLY_IF_DIFFERENT)
