# src/adapters is the only folder that sees ROS; each src/nodes/<name>.cpp is the main of one node.
file(GLOB adapter_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/adapters/*.cpp)
file(GLOB node_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/nodes/*.cpp)
list(REMOVE_ITEM adapter_sources ${PROJECT_SOURCE_DIR}/src/adapters/nodelets.cpp)

add_library(window_ingress_adapters SHARED ${adapter_sources})
target_include_directories(window_ingress_adapters PUBLIC ${PROJECT_SOURCE_DIR}/src)
target_include_directories(window_ingress_adapters SYSTEM PUBLIC
                           ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION} ${catkin_INCLUDE_DIRS})
target_link_libraries(window_ingress_adapters PUBLIC window_ingress_evaluation window_ingress_simulation
                      window_ingress_core opencv_imgcodecs ${catkin_LIBRARIES})
add_dependencies(window_ingress_adapters ${${PROJECT_NAME}_EXPORTED_TARGETS})

# Only the registration macros: a node that links the classes must not register plugins.
add_library(window_ingress_nodelets SHARED ${PROJECT_SOURCE_DIR}/src/adapters/nodelets.cpp)
target_link_libraries(window_ingress_nodelets PUBLIC window_ingress_adapters -Wl,-z,defs)

foreach(source ${node_sources})
  get_filename_component(node ${source} NAME_WE)
  add_executable(${node} ${source})
  target_link_libraries(${node} PRIVATE window_ingress_adapters)
  install(TARGETS ${node} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()

install(TARGETS window_ingress_adapters window_ingress_nodelets
        ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
        LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
        RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION} FILES_MATCHING PATTERN "*.hpp")
install(FILES nodelets.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(DIRECTORY launch config DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
catkin_install_python(PROGRAMS scripts/plot_replay.py scripts/start_mission.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
