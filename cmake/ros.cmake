# src/adapters is the only folder that sees ROS; each src/nodes/<name>.cpp is the main of one node.
file(GLOB adapter_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/adapters/*.cpp)
file(GLOB node_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/nodes/*.cpp)
