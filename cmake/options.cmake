# Compiler settings that every target shares.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
# All programs lie at the top of the build folder: build/release/gable.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CXX_FLAGS)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(GABLE_CCACHE ccache)
if(GABLE_CCACHE)
  set(launcher ${GABLE_CCACHE})
  if(EMSCRIPTEN)
    # It has headers compiled before, which ccache takes if it is told so.
    set(launcher ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${GABLE_CCACHE})
  endif()
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
endif()

# Same input, same bytes: no fused multiply-add, no value-changing optimisation.
add_compile_options(-ffp-contract=off -fno-fast-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # No function of the library is replaced from outside: calls within a file may be inlined, which
  # clang++ does unasked.
  add_compile_options($<$<CONFIG:Release>:-fno-semantic-interposition>)
  # g++ 12 loses the rounding of (double)(float)x when it packs neighbouring conversions into one
  # vector (src/io/exporters/stl_writer.cpp shows it from -O2 on). Loops are not affected.
  add_compile_options(-fno-tree-slp-vectorize)
endif()
add_compile_options(-Wall -Wextra -Wshadow -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 warns wrongly about "literal" + std::string (its bug 105651).
  add_compile_options(-Wno-restrict)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Wno-missing-braces)
endif()

# `dev` is optimised and checked at once: NDEBUG stays off, GABLE_DCHECK is on.
if(GABLE_DEV)
  add_compile_definitions(GABLE_DCHECKS=1)
endif()

if(GABLE_SANITIZE)
  add_compile_options(-fsanitize=${GABLE_SANITIZE} -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=${GABLE_SANITIZE})
endif()

find_program(GABLE_LLD ld.lld)
if(GABLE_LLD AND NOT EMSCRIPTEN)
  add_link_options(-fuse-ld=lld)
endif()

if(EMSCRIPTEN)
  # A browser gives no threads to pages of servers that send no headers for it: all work is done by the caller.
  add_library(Threads::Threads INTERFACE IMPORTED)
else()
  find_package(Threads REQUIRED)
endif()

# gable_finds_libraries(PROGRAM): installed, it finds libraries in lib/gable, where archives have them; by
# the older kind of path, which holds for the libraries of libraries as well.
function(gable_finds_libraries program)
  set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/../lib/gable")
  target_link_options(${program} PRIVATE LINKER:--disable-new-dtags)
endfunction()
