# Packages, by `cpack` in the build folder: `cpack -G DEB` makes gable, libgable, libgable-dev and
# python3-gable, `cpack -G TGZ` one archive that runs from any folder of a Linux of this kind.
# tools/packages.sh builds them and tries them.
set(GABLE_CONTACT "The Gable authors <maintainers@gable.invalid>" CACHE STRING "Who answers for the packages")

# What Debian wants of each package, in place of the licence that others get.
set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(library_package libgable${abi})
set(package_of_program gable)
set(package_of_library ${library_package})
set(package_of_development libgable-dev)
set(package_of_python python3-gable)
# With SOURCE_DATE_EPOCH the same packages from the same sources.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/debian/changelog.in debian/changelog @ONLY)
find_program(GABLE_GZIP gzip)
if(GABLE_GZIP)
  execute_process(COMMAND ${GABLE_GZIP} -9nkf ${PROJECT_BINARY_DIR}/debian/changelog)
endif()
foreach(part program library development python)
  set(doc share/doc/${package_of_${part}})
  install(FILES cmake/debian/copyright DESTINATION ${doc} COMPONENT debian_${part} EXCLUDE_FROM_ALL)
  install(FILES ${PROJECT_BINARY_DIR}/debian/changelog.gz DESTINATION ${doc} COMPONENT debian_${part}
          EXCLUDE_FROM_ALL OPTIONAL)
endforeach()

# The libraries that the programs need, beside them: everything but the C library.
cmake_policy(SET CMP0087 NEW)
set(programs $<TARGET_FILE:gable> $<TARGET_FILE:gable-convert>)
if(TARGET gable-maps)
  list(APPEND programs $<TARGET_FILE:gable-maps>)
endif()
install(CODE "set(programs \"${programs}\")
  set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")" COMPONENT bundle EXCLUDE_FROM_ALL)
install(SCRIPT cmake/bundle.cmake COMPONENT bundle EXCLUDE_FROM_ALL)

set(CPACK_PACKAGE_NAME gable)
set(CPACK_PACKAGE_VENDOR "The Gable authors")
set(CPACK_PACKAGE_CONTACT "${GABLE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Open engine for shape grammars")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/cpack_options.cmake)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(about "Gable turns rules into places: shape grammars (CGA) in,
textured 3D models out.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gable)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Open engine for shape grammars: the program
${about} This package has the command line,
the page of its studio, examples, man pages and completion for shells.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "gdal-bin")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "Open engine for shape grammars: the library
${about} This package has the library
with its interfaces in C++ and C.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgable-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} (= ${PROJECT_VERSION})")
# What linking with libgable.a asks for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS
    "libpng-dev, libjpeg-dev, libtiff-dev, libwebp-dev, libarchive-dev, libembree-dev, libmeshoptimizer-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "Open engine for shape grammars: for building programs
${about} This package has the headers,
the static library and what CMake and pkg-config ask for.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-gable)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
if(TARGET gable_python)
  find_package(Python3 3.9 QUIET COMPONENTS Interpreter)
  # Its package is made where the module is built.
  set(CPACK_GABLE_PYTHON_MODULES ${PROJECT_BINARY_DIR}/python/gable)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${next}), python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-shapely, python3-geopandas")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Open engine for shape grammars: the module for Python
${about} This package has the module
gable, which derives rules and gives their models as arrays.")
include(CPack)

# A package is made of its part and of what Debian wants with it.
foreach(part program library development python)
  string(TOUPPER ${part} PART)
  cpack_add_component_group(${part})
  cpack_add_component(${part} GROUP ${part})
  cpack_add_component(debian_${part} GROUP ${part})
endforeach()
cpack_add_component(debian GROUP program)
cpack_add_component(bundle GROUP program)
cpack_add_component(license GROUP program)
