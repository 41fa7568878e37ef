# Benchmarks, not part of the package or its tests. scripts/bench builds (target `benchmarks`) and runs them. A benchmark
# whose library is not installed is left out with a message.
#   benchmark_draw_frames  draws the images that need no recordings
#   benchmark_detection    detection times, with Google Benchmark
#   benchmark_pose         times of a pose from one image, with Google Benchmark
#   benchmark_instructions detection instructions, counted under callgrind
#   benchmark_allocations  allocations per image, by caller
#   benchmark_memory       memory over an hour's worth of images
set(folder ${PROJECT_SOURCE_DIR}/test/benchmark)

add_library(benchmark_support STATIC EXCLUDE_FROM_ALL ${folder}/frame_set.cpp ${folder}/subjects.cpp ${folder}/stages.cpp
            ${folder}/marker_subjects.cpp)
target_include_directories(benchmark_support PUBLIC ${folder} ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/test/support)
target_link_libraries(benchmark_support PUBLIC ${PROJECT_NAME}_vision opencv_imgcodecs nlohmann_json::nlohmann_json)

find_path(APRILTAG_INCLUDE_DIR apriltag/apriltag.h)
find_library(APRILTAG_LIBRARY apriltag)
if(APRILTAG_INCLUDE_DIR AND APRILTAG_LIBRARY)
  target_include_directories(benchmark_support SYSTEM PRIVATE ${APRILTAG_INCLUDE_DIR})
  target_compile_definitions(benchmark_support PRIVATE WINDOW_INGRESS_WITH_APRILTAG)
  target_link_libraries(benchmark_support PRIVATE ${APRILTAG_LIBRARY})
else()
  message(STATUS "benchmarks: without AprilTag (libapriltag-dev is not installed)")
endif()

# OpenCV 4.7 moved ArUco from the contrib module into objdetect.
find_path(ARUCO_INCLUDE_DIR NAMES opencv2/objdetect/aruco_detector.hpp opencv2/aruco.hpp PATHS ${OpenCV_INCLUDE_DIRS})
if(ARUCO_INCLUDE_DIR AND TARGET opencv_aruco)
  target_compile_definitions(benchmark_support PRIVATE WINDOW_INGRESS_WITH_ARUCO)
  target_link_libraries(benchmark_support PRIVATE opencv_aruco)
elseif(ARUCO_INCLUDE_DIR AND TARGET opencv_objdetect AND NOT OpenCV_VERSION VERSION_LESS 4.7)
  target_compile_definitions(benchmark_support PRIVATE WINDOW_INGRESS_WITH_ARUCO)
  target_link_libraries(benchmark_support PRIVATE opencv_objdetect)
else()
  message(STATUS "benchmarks: without ArUco (libopencv-contrib-dev is not installed)")
endif()

add_custom_target(benchmarks)

# add_benchmark(name libraries...)
function(add_benchmark name)
  add_executable(benchmark_${name} EXCLUDE_FROM_ALL ${folder}/${name}.cpp)
  target_link_libraries(benchmark_${name} benchmark_support ${ARGN})
  target_compile_definitions(benchmark_${name} PRIVATE WINDOW_INGRESS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  add_dependencies(benchmarks benchmark_${name})
endfunction()

add_benchmark(draw_frames ${PROJECT_NAME}_simulation)
add_benchmark(memory)
add_benchmark(allocations ${CMAKE_DL_LIBS})
target_sources(benchmark_allocations PRIVATE ${folder}/allocation_recorder.cpp)
set_target_properties(benchmark_allocations PROPERTIES ENABLE_EXPORTS ON)
find_package(benchmark QUIET)
if(benchmark_FOUND)
  add_benchmark(detection benchmark::benchmark)
  add_benchmark(pose ${PROJECT_NAME}_evaluation benchmark::benchmark)
else()
  message(STATUS "benchmarks: without times (libbenchmark-dev is not installed)")
endif()

find_path(VALGRIND_INCLUDE_DIR valgrind/callgrind.h)
if(VALGRIND_INCLUDE_DIR)
  add_benchmark(instructions)
  target_include_directories(benchmark_instructions SYSTEM PRIVATE ${VALGRIND_INCLUDE_DIR})
else()
  message(STATUS "benchmarks: without instructions (valgrind is not installed)")
endif()
