# src/adapters is the only folder that uses ROS. Each src/mains/<name>.cpp is the main of one node.

# add_adapters(name FOLDERS folders below src/adapters DEPENDS libs...)
function(add_adapters name)
  cmake_parse_arguments(ARG "" "" "FOLDERS;DEPENDS" ${ARGN})
  list(TRANSFORM ARG_FOLDERS REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/src/adapters/\\1/*.cpp")
  file(GLOB sources CONFIGURE_DEPENDS ${ARG_FOLDERS})
  add_library(${name} SHARED ${sources})
  target_compile_definitions(${name} PUBLIC ${ros_definitions})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  #catkin_lint: ignore_once external_directory external_interface_path
  target_include_directories(${name} SYSTEM PUBLIC
                             ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION} ${catkin_INCLUDE_DIRS})
  target_link_libraries(${name} PUBLIC ${ARG_DEPENDS} ${catkin_LIBRARIES})
  add_dependencies(${name} ${${PROJECT_NAME}_EXPORTED_TARGETS})
  install(TARGETS ${name} ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
          LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION} RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
endfunction()

add_adapters(${PROJECT_NAME}_adapters FOLDERS conversions guard inputs markers navigator pose runtime DEPENDS ${PROJECT_NAME}_core)
# Separate from the nodes that steer: OpenCV takes 14 MB per process. Its image file readers would take 39 MB more.
add_adapters(${PROJECT_NAME}_image_adapters FOLDERS images
             DEPENDS ${PROJECT_NAME}_adapters ${PROJECT_NAME}_vision JPEG::JPEG PNG::PNG)
# Separate from the nodes that fly: the renderer's libraries would take 46 MB per node.
add_adapters(${PROJECT_NAME}_world_adapters FOLDERS world DEPENDS ${PROJECT_NAME}_image_adapters ${PROJECT_NAME}_simulation)
add_adapters(${PROJECT_NAME}_bags FOLDERS bags DEPENDS ${PROJECT_NAME}_world_adapters ${PROJECT_NAME}_evaluation)

# Holds only the registration macros: a node that links the classes must not register plugins.
add_library(${PROJECT_NAME}_nodelets SHARED ${PROJECT_SOURCE_DIR}/src/adapters/nodelets.cpp)
target_link_libraries(${PROJECT_NAME}_nodelets PUBLIC ${PROJECT_NAME}_image_adapters -Wl,-z,defs)

file(GLOB node_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/mains/*.cpp)
foreach(source ${node_sources})
  get_filename_component(node ${source} NAME_WE)
  set(target ${PROJECT_NAME}_${node})
  add_executable(${target} ${source})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${node} PREFIX "")
  # Every node links all three; --as-needed drops those that it does not call.
  target_link_libraries(${target} PRIVATE ${PROJECT_NAME}_adapters ${PROJECT_NAME}_image_adapters ${PROJECT_NAME}_world_adapters)
  list(APPEND node_targets ${target})
  install(TARGETS ${target} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()

install(TARGETS ${PROJECT_NAME}_nodelets
        ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
        LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
        RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION} FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY msg/migration DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/msg)
install(FILES nodelets.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(DIRECTORY config launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
# Python programs: tools for users, and nodes. Their common modules are installed beside them.
file(GLOB python_programs CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tools/* ${PROJECT_SOURCE_DIR}/nodes/*.py)
list(FILTER python_programs EXCLUDE REGEX "/(ingress_tools|__pycache__)$")
catkin_install_python(PROGRAMS ${python_programs} scripts/ingress DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY tools/ingress_tools DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION} FILES_MATCHING PATTERN "*.py")
# ingress is on PATH once the workspace's setup.bash is sourced.
catkin_install_python(PROGRAMS scripts/ingress DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
install(FILES scripts/ingress_completion.bash DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(FILES scripts/ingress_completion.bash DESTINATION share/bash-completion/completions RENAME ingress)
