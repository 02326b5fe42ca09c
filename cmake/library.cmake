# The library that other programs link, and what `cmake --install` puts in place. The layers are static
# libraries of their own for tests; libgable.so and libgable.a are made of their objects.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(objects $<TARGET_OBJECTS:gable_polyclipping>)
foreach(layer ${GABLE_LAYERS})
  get_target_property(type gable_${layer} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    list(APPEND objects $<TARGET_OBJECTS:gable_${layer}>)
  endif()
endforeach()

# What the layers stand on. A package that links libgable.a has to name them again.
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(TIFF REQUIRED)
find_package(LibArchive REQUIRED)
set(foreign PNG::PNG JPEG::JPEG TIFF::TIFF LibArchive::LibArchive Threads::Threads
    $<BUILD_INTERFACE:${WEBP_LIBRARY}> $<INSTALL_INTERFACE:webp>)
set(foreign_flags "-lpng -ljpeg -ltiff -lwebp -larchive -pthread")
if(EMBREE_LIBRARY)
  list(APPEND foreign $<BUILD_INTERFACE:${EMBREE_LIBRARY}> $<INSTALL_INTERFACE:embree3>)
  string(PREPEND foreign_flags "-lembree3 ")
endif()
find_package(meshoptimizer QUIET)
if(TARGET meshoptimizer::meshoptimizer)
  list(APPEND foreign $<BUILD_INTERFACE:meshoptimizer::meshoptimizer> $<INSTALL_INTERFACE:meshoptimizer>)
  string(PREPEND foreign_flags "-lmeshoptimizer ")
endif()

foreach(kind shared static)
  string(TOUPPER ${kind} upper)
  add_library(gable_${kind} ${upper} ${objects})
  target_link_libraries(gable_${kind} PRIVATE ${foreign})
  target_include_directories(gable_${kind} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(gable_${kind} INTERFACE cxx_std_20)
  set_target_properties(gable_${kind} PROPERTIES OUTPUT_NAME gable EXPORT_NAME ${kind} LINKER_LANGUAGE CXX)
endforeach()
# Before version 1 any release may change the interface.
set_target_properties(gable_shared PROPERTIES VERSION ${PROJECT_VERSION}
                      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
# Nothing but the public interface can be seen from outside.
set(exports ${PROJECT_SOURCE_DIR}/cmake/exports.map)
target_link_options(gable_shared PRIVATE LINKER:--version-script=${exports} LINKER:--no-undefined)
set_target_properties(gable_shared PROPERTIES LINK_DEPENDS ${exports})

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/gable)
install(TARGETS gable_shared EXPORT gableTargets LIBRARY COMPONENT library NAMELINK_COMPONENT development)
install(TARGETS gable_static EXPORT gableTargets COMPONENT development)
# With --strip the static library loses what is for debuggers alone.
install(CODE "if(CMAKE_INSTALL_DO_STRIP)
    execute_process(COMMAND ${CMAKE_STRIP} --strip-debug --enable-deterministic-archives
                    \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/libgable.a\")
  endif()" COMPONENT development)
install(EXPORT gableTargets NAMESPACE gable:: DESTINATION ${package} COMPONENT development)
configure_package_config_file(cmake/gableConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/gableConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/gableConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gableConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/gableConfigVersion.cmake DESTINATION ${package}
        COMPONENT development)
file(RELATIVE_PATH pc_to_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/gable.pc.in ${CMAKE_CURRENT_BINARY_DIR}/gable.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gable.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/gable DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT development)

# The program looks for its page and its examples in ../share/gable, seen from where it lies.
install(TARGETS gable COMPONENT program)
install(CODE "if(NOT EXISTS ${PROJECT_SOURCE_DIR}/build/studio/index.html)
    message(NOTICE \"The studio's page is not built, so 'gable studio' has none here: './run studio' builds it.\")
  endif()" COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/studio DESTINATION share/gable COMPONENT program OPTIONAL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION share/gable COMPONENT program)
# The guide and the reference beside them, with links that hold there; and the add-on for Blender,
# which is installed from a zip.
find_package(Python3 QUIET COMPONENTS Interpreter)
if(Python3_Interpreter_FOUND)
  install(CODE "execute_process(COMMAND \"${Python3_EXECUTABLE}\" -B \"${PROJECT_SOURCE_DIR}/tools/install_docs.py\"
      \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/gable\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT program)
  install(CODE "execute_process(COMMAND \"${Python3_EXECUTABLE}\" -B \"${PROJECT_SOURCE_DIR}/tools/pack_blender.py\"
      \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/gable/gable_blender.zip\" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)" COMPONENT program)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/cmake/debian/copyright DESTINATION share/doc/gable
        COMPONENT license)
