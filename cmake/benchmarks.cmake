# Measurements, never part of the tests: benchmark_<name> for each test/benchmark/<name>_benchmark.cpp, where Google
# Benchmark is installed. Run e.g. build/core/benchmark_detection --benchmark_filter=detector
find_package(benchmark QUIET)
if(benchmark_FOUND)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/benchmark/*_benchmark.cpp)
  foreach(source ${sources})
    get_filename_component(name ${source} NAME_WE)
    string(REPLACE _benchmark "" name ${name})
    add_executable(benchmark_${name} EXCLUDE_FROM_ALL ${source})
    target_link_libraries(benchmark_${name} ${PROJECT_NAME}_simulation benchmark::benchmark)
    target_include_directories(benchmark_${name} PRIVATE ${PROJECT_SOURCE_DIR}/test/support)
    target_compile_definitions(benchmark_${name} PRIVATE WINDOW_INGRESS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  endforeach()
endif()
