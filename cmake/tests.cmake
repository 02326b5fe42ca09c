# One test program a layer, from the *_test.cpp files beside the sources.
find_package(GTest REQUIRED)
include(GoogleTest)

# Models that tests write go to this folder, empty at the start of a run; whatever lies there at the end
# must pass the Khronos validator. Tests reach it as GABLE_WRITTEN_DIR.
set(GABLE_WRITTEN_DIR ${PROJECT_BINARY_DIR}/written)

foreach(layer ${GABLE_LAYERS})
  get_property(tests GLOBAL PROPERTY gable_tests_${layer})
  if(tests)
    add_executable(test_${layer} ${tests})
    get_property(libraries GLOBAL PROPERTY gable_test_libraries_${layer})
    target_link_libraries(test_${layer} PRIVATE ${libraries} gable_${layer} GTest::gtest_main Threads::Threads)
    target_compile_definitions(test_${layer} PRIVATE GABLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                               GABLE_WRITTEN_DIR="${GABLE_WRITTEN_DIR}")
    if(layer MATCHES "^(io|engine)$")
      gtest_discover_tests(test_${layer} TEST_PREFIX ${layer}. DISCOVERY_MODE PRE_TEST
                           PROPERTIES FIXTURES_REQUIRED written)
    else()
      gtest_discover_tests(test_${layer} TEST_PREFIX ${layer}. DISCOVERY_MODE PRE_TEST)
    endif()
  endif()
endforeach()
if(EXISTS ${PROJECT_SOURCE_DIR}/tests/CMakeLists.txt)
  add_subdirectory(tests)
endif()
