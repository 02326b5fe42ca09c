# The engine as WebAssembly, for the playground: what only this target needs. tools/playground.sh brings the
# compiler and the sources of the libraries.

# Exceptions of the machine itself: calls cost nothing where none is thrown. Jumps of the C libraries likewise.
set(GABLE_WASM_MODE -fwasm-exceptions -sSUPPORT_LONGJMP=wasm)
add_link_options(${GABLE_WASM_MODE})
# emcc reads its own JavaScript by Debian's acorn, which a node from elsewhere does not find by itself.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")

# em++ starts Python for each file, which takes as long as compiling a small one. So the compiler behind it is called,
# as em++ says that it would.
execute_process(COMMAND ${CMAKE_CXX_COMPILER} --cflags ${GABLE_WASM_MODE} OUTPUT_VARIABLE flags
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
find_program(GABLE_CLANG NAMES clang-14 clang REQUIRED)
foreach(language C CXX)
  set(CMAKE_${language}_COMPILE_OBJECT
      "${GABLE_CLANG} ${flags} <DEFINES> <INCLUDES> <FLAGS> -o <OBJECT> -c <SOURCE>")
endforeach()

set(CMAKE_POSITION_INDEPENDENT_CODE OFF)

# A page is fetched before it runs: only layers in whose loops derivations spend their time are compiled for speed.
foreach(layer builtins io)
  set(GABLE_WASM_OPTIONS_${layer} -Os)
endforeach()
foreach(layer program lang dialects language material city tiles engine cases json lsp studio)
  set(GABLE_WASM_OPTIONS_${layer} -Oz)
endforeach()
# Nothing asks for types at run time. Headers that are compiled before are equal where their
# texts are, for ccache.
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:-fno-rtti;SHELL:-Xclang -fno-pch-timestamp>")

# What files of all layers include, compiled once a layer: it is half of the work. The first adds what the library
# lacks of C++20.
set(GABLE_WASM_HEADERS ${PROJECT_SOURCE_DIR}/apps/gable_wasm/library/cxx20.h <algorithm> <array> <atomic> <cmath> <cstdint>
    <cstring> <filesystem> <functional> <limits> <map> <memory> <mutex> <numeric> <optional> <set> <span> <string>
    <string_view> <tuple> <unordered_map> <utility> <variant> <vector>)
set(GABLE_WASM_HEADERS_builtins ${PROJECT_SOURCE_DIR}/src/shape/op_call.h)
set(GABLE_WASM_HEADERS_runtime ${PROJECT_SOURCE_DIR}/src/shape/op_call.h ${PROJECT_SOURCE_DIR}/src/scene/flatten.h)

# Headers alone are taken from the system, each by name: its C library is another.
set(headers ${CMAKE_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${headers})
foreach(name nlohmann boost stb)
  file(CREATE_LINK /usr/include/${name} ${headers}/${name} SYMBOLIC)
endforeach()
include_directories(SYSTEM ${headers})

# The libraries of pictures, of the very versions that the native program has here: the same bytes.
set(GABLE_WASM_SOURCES ${PROJECT_SOURCE_DIR}/build/wasm-sources CACHE PATH "Sources of zlib, libpng and libjpeg")
if(NOT EXISTS ${GABLE_WASM_SOURCES}/zlib/deflate.c)
  message(FATAL_ERROR "The sources of zlib, libpng and libjpeg are missing: tools/playground.sh fetches them")
endif()

# gable_foreign(NAME FOLDER sources...): a C library from its sources, for those who link NAME.
function(gable_foreign name folder)
  list(TRANSFORM ARGN PREPEND ${GABLE_WASM_SOURCES}/${folder}/)
  string(REPLACE "::" "_" library ${name})
  add_library(${library} STATIC ${ARGN})
  add_library(${name} ALIAS ${library})
  target_include_directories(${library} SYSTEM PUBLIC ${GABLE_WASM_SOURCES}/${folder})
  target_compile_options(${library} PRIVATE -w)
endfunction()

gable_foreign(ZLIB::ZLIB zlib adler32.c compress.c crc32.c deflate.c inffast.c inflate.c inftrees.c trees.c zutil.c)

configure_file(${GABLE_WASM_SOURCES}/libpng/scripts/pnglibconf.h.prebuilt
               ${GABLE_WASM_SOURCES}/libpng/pnglibconf.h COPYONLY)
gable_foreign(PNG::PNG libpng png.c pngerror.c pngget.c pngmem.c pngpread.c pngread.c pngrio.c pngrtran.c pngrutil.c
              pngset.c pngtrans.c pngwio.c pngwrite.c pngwtran.c pngwutil.c)
target_link_libraries(PNG_PNG PUBLIC ZLIB::ZLIB)

# As Debian configures it, without code for one processor.
file(STRINGS ${GABLE_WASM_SOURCES}/libjpeg-turbo/CMakeLists.txt version REGEX "^set\\(VERSION [0-9.]+\\)")
string(REGEX MATCH "[0-9.]+" VERSION "${version}")
set(JPEG_LIB_VERSION 62)
set(LIBJPEG_TURBO_VERSION_NUMBER 2001005)
set(BITS_IN_JSAMPLE 8)
set(INLINE "inline")
set(SIZE_T 4)
set(C_ARITH_CODING_SUPPORTED 1)
set(D_ARITH_CODING_SUPPORTED 1)
set(MEM_SRCDST_SUPPORTED 1)
set(HAVE_BUILTIN_CTZL 1)
foreach(header jconfig.h jconfigint.h jversion.h)
  configure_file(${GABLE_WASM_SOURCES}/libjpeg-turbo/${header}.in ${GABLE_WASM_SOURCES}/libjpeg-turbo/${header})
endforeach()
gable_foreign(JPEG::JPEG libjpeg-turbo jcapimin.c jcapistd.c jccoefct.c jccolor.c jcdctmgr.c jchuff.c jcicc.c jcinit.c
              jcmainct.c jcmarker.c jcmaster.c jcomapi.c jcparam.c jcphuff.c jcprepct.c jcsample.c jctrans.c jdapimin.c
              jdapistd.c jdatadst.c jdatasrc.c jdcoefct.c jdcolor.c jddctmgr.c jdhuff.c jdicc.c jdinput.c jdmainct.c
              jdmarker.c jdmaster.c jdmerge.c jdphuff.c jdpostct.c jdsample.c jdtrans.c jerror.c jfdctflt.c jfdctfst.c
              jfdctint.c jidctflt.c jidctfst.c jidctint.c jidctred.c jquant1.c jquant2.c jutils.c jmemmgr.c jmemnobs.c
              jaricom.c jcarith.c jdarith.c jsimd_none.c)
