# Unit tests: unit_<folder> is built from every *_test.cpp below test/unit/<folder>.
find_package(GTest REQUIRED)

# Larger batches and -O1 cut the tests' compile time by three tenths. The libraries are optimised as for flight.
function(compile_quickly target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 16)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

file(GLOB unit_folders RELATIVE ${PROJECT_SOURCE_DIR}/test/unit CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/unit/*)
foreach(folder ${unit_folders})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/unit/${folder}/*_test.cpp)
  if(NOT sources OR (folder MATCHES "adapters|tools" AND WINDOW_INGRESS_CORE_ONLY))
    continue()
  endif()
  set(target unit_${folder})
  if(WINDOW_INGRESS_CORE_ONLY)
    add_executable(${target} ${sources} ${PROJECT_SOURCE_DIR}/test/support/gtest_main.cpp)
    target_link_libraries(${target} GTest::GTest)
    add_test(NAME ${target} COMMAND ${target} --gtest_output=xml:${PROJECT_BINARY_DIR}/test_results/${target}.xml)
  else()
    catkin_add_gtest(${target} ${sources} ${PROJECT_SOURCE_DIR}/test/support/gtest_main.cpp)
  endif()
  compile_quickly(${target})
  target_link_libraries(${target} ${PROJECT_NAME}_evaluation yaml-cpp nlohmann_json::nlohmann_json opencv_imgcodecs)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/test/support)
  target_compile_definitions(${target} PRIVATE WINDOW_INGRESS_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                               WINDOW_INGRESS_BINARY_DIR="${PROJECT_BINARY_DIR}")
  if(folder MATCHES "adapters|tools")
    target_link_libraries(${target} ${PROJECT_NAME}_bags)
  elseif(folder STREQUAL simulation AND with_OSMESA AND with_EGL)  # the library has one renderer; the test compares both
    target_sources(${target} PRIVATE ${OFFSCREEN_EXCLUDED})
    target_link_libraries(${target} ${OFFSCREEN_OTHER_LIBRARY})
    target_compile_definitions(${target} PRIVATE WINDOW_INGRESS_WITH_OSMESA_AND_EGL)
  endif()
endforeach()

# The example of doc/ros_api.md, run by test/tools/ros2_test.py.
set(target ${PROJECT_NAME}_flies_without_ros)
add_executable(${target} EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/test/install/without_ros/main.cpp)
set_target_properties(${target} PROPERTIES OUTPUT_NAME flies_without_ros PREFIX "")
target_link_libraries(${target} PRIVATE ${PROJECT_NAME}_vision)
if(NOT WINDOW_INGRESS_CORE_ONLY)
  add_dependencies(tests ${target})
endif()

# One program for the rows of test/faults/rows.yaml that need no node, and for the fuzzers' findings.
if(NOT WINDOW_INGRESS_CORE_ONLY)
  file(GLOB fault_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/faults/unit/*_test.cpp ${PROJECT_SOURCE_DIR}/test/fuzz/*.cpp)
  list(FILTER fault_sources EXCLUDE REGEX libfuzzer_main)
  foreach(shared invariants motion/setpoint_limiter)  # rows that the navigator's own tests cover
    list(APPEND fault_sources ${PROJECT_SOURCE_DIR}/test/unit/navigation/${shared}_test.cpp)
  endforeach()
  catkin_add_gtest(faults ${fault_sources} ${PROJECT_SOURCE_DIR}/test/support/gtest_main.cpp)
  compile_quickly(faults)
  target_link_libraries(faults ${PROJECT_NAME}_bags yaml-cpp opencv_imgcodecs)
  target_include_directories(faults PRIVATE ${PROJECT_SOURCE_DIR}/test/support ${PROJECT_SOURCE_DIR}/test/fuzz)
  target_compile_definitions(faults PRIVATE WINDOW_INGRESS_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                            WINDOW_INGRESS_COMPILER="${CMAKE_CXX_COMPILER}"
                                            WINDOW_INGRESS_EIGEN="${EIGEN3_INCLUDE_DIR}")
endif()

if(WINDOW_INGRESS_CORE_ONLY)
  add_test(NAME core_is_free_of_ros
           COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/dev/check_core_is_free_of_ros.py
                   ${PROJECT_BINARY_DIR}/compile_commands.json)
else()
  include(${PROJECT_SOURCE_DIR}/cmake/ros_tests.cmake)
endif()
