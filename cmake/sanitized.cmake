# Fuzzers, and the unit tests with the same sanitizers. dev/fuzz and dev/sanitize configure with clang, sanitizer flags and
# WINDOW_INGRESS_SANITIZED. They build fuzz_<target>, unit_<folder> and faults. Only what a target needs is compiled.
find_package(GTest REQUIRED)
set(fuzz_folder ${PROJECT_SOURCE_DIR}/test/fuzz)
set(source_root ${PROJECT_SOURCE_DIR}/src)

# add_sanitized_library(name FILES globs... LIBRARIES libs...)
function(add_sanitized_library name)
  cmake_parse_arguments(ARG "" "" "FILES;LIBRARIES" ${ARGN})
  set(sources "")
  foreach(pattern ${ARG_FILES})
    file(GLOB_RECURSE found CONFIGURE_DEPENDS ${pattern})
    list(APPEND sources ${found})
  endforeach()
  list(REMOVE_ITEM sources ${OFFSCREEN_EXCLUDED})
  add_library(${name} STATIC EXCLUDE_FROM_ALL ${sources})
  target_include_directories(${name} PRIVATE ${source_root})
  target_include_directories(${name} SYSTEM PUBLIC ${EIGEN3_INCLUDE_DIRS} ${OpenCV_INCLUDE_DIRS} ${OFFSCREEN_INCLUDE_DIR})
  target_link_libraries(${name} PUBLIC ${ARG_LIBRARIES})
endfunction()

set(core_files "")
foreach(stage text geometry parameters detection openness estimation facade perception navigation configuration)
  list(APPEND core_files ${source_root}/${stage}/*.cpp)
endforeach()
add_sanitized_library(fuzz_core FILES ${core_files}
                      LIBRARIES opencv_core opencv_imgproc opencv_video opencv_calib3d opencv_imgcodecs yaml-cpp)
add_sanitized_library(fuzz_world FILES ${source_root}/simulation/*.cpp LIBRARIES fuzz_core ${OFFSCREEN_LIBRARY})
add_sanitized_library(fuzz_evaluation FILES ${source_root}/evaluation/*.cpp
                      LIBRARIES fuzz_world nlohmann_json::nlohmann_json Threads::Threads)

# Only those adapters that need no node.
add_sanitized_library(fuzz_messages FILES ${source_root}/adapters/conversions/*.cpp ${fuzz_folder}/any_image.cpp
                      ${source_root}/adapters/images/image_conversion.cpp ${source_root}/adapters/images/image_files.cpp
                      LIBRARIES fuzz_core JPEG::JPEG PNG::PNG ${catkin_LIBRARIES})
target_include_directories(fuzz_messages PUBLIC ${source_root})
target_include_directories(fuzz_messages SYSTEM PUBLIC ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION}
                           ${catkin_INCLUDE_DIRS})
add_dependencies(fuzz_messages ${${PROJECT_NAME}_EXPORTED_TARGETS})
set(bags bag_check bag_reading replay replay_output)
list(TRANSFORM bags PREPEND ${source_root}/adapters/bags/)
list(TRANSFORM bags APPEND .cpp)
add_sanitized_library(fuzz_bags FILES ${bags} ${source_root}/adapters/images/reference_source.cpp LIBRARIES fuzz_messages fuzz_evaluation)

# add_fuzzer(name libraries...)
function(add_fuzzer name)
  add_executable(fuzz_${name} EXCLUDE_FROM_ALL ${fuzz_folder}/${name}.cpp ${fuzz_folder}/libfuzzer_main.cpp)
  target_compile_definitions(fuzz_${name} PRIVATE FUZZ_TARGET=${name})
  target_link_libraries(fuzz_${name} PRIVATE ${ARGN} -fsanitize=fuzzer)
endfunction()
foreach(target image detection camera_info corners)
  add_fuzzer(${target} fuzz_messages)
endforeach()
add_fuzzer(bag fuzz_bags)
add_fuzzer(scenario fuzz_world)
add_fuzzer(parameters fuzz_core)

# add_sanitized_test(name libraries... FILES globs...)
function(add_sanitized_test name)
  cmake_parse_arguments(ARG "" "" "FILES;LIBRARIES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${ARG_FILES})
  list(FILTER sources EXCLUDE REGEX "libfuzzer_main|test/fuzz/any_image")
  add_executable(${name} EXCLUDE_FROM_ALL ${sources} ${PROJECT_SOURCE_DIR}/test/support/gtest_main.cpp)
  target_include_directories(${name} PRIVATE ${source_root} ${PROJECT_SOURCE_DIR}/test/support ${fuzz_folder})
  target_compile_definitions(${name} PRIVATE
    WINDOW_INGRESS_SOURCE_DIR="${PROJECT_SOURCE_DIR}" WINDOW_INGRESS_BINARY_DIR="${PROJECT_BINARY_DIR}"
    WINDOW_INGRESS_COMPILER="${CMAKE_CXX_COMPILER}" WINDOW_INGRESS_EIGEN="${EIGEN3_INCLUDE_DIR}")
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} nlohmann_json::nlohmann_json GTest::GTest)
endfunction()
foreach(stage text geometry parameters detection facade navigation)
  add_sanitized_test(unit_${stage} FILES ${PROJECT_SOURCE_DIR}/test/unit/${stage}/*_test.cpp LIBRARIES fuzz_core)
endforeach()
foreach(stage openness estimation simulation evaluation)
  add_sanitized_test(unit_${stage} FILES ${PROJECT_SOURCE_DIR}/test/unit/${stage}/*_test.cpp LIBRARIES fuzz_evaluation)
endforeach()
add_sanitized_test(faults FILES ${PROJECT_SOURCE_DIR}/test/faults/unit/*_test.cpp ${fuzz_folder}/*.cpp
                   ${PROJECT_SOURCE_DIR}/test/unit/navigation/invariants_test.cpp
                   ${PROJECT_SOURCE_DIR}/test/unit/navigation/motion/setpoint_limiter_test.cpp LIBRARIES fuzz_bags)
