# ROS tests: each <name>.test in test/ros and test/faults/ros is one rostest with its own master. It runs <name>_test.py; its
# attribute time-limit is the test's [s].
find_package(catkin REQUIRED COMPONENTS roslaunch rostest)

# The excluded files need an optional driver or arguments; test/tools/launch_files_test.py checks them.
file(GLOB launch_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/launch/*.launch)
list(FILTER launch_files EXCLUDE REGEX "(usb_cam|rehearse|mavros|px4|ardupilot).launch$")
foreach(launch_file ${launch_files})
  roslaunch_add_file_check(${launch_file} IGNORE_UNSET_ARGS)
endforeach()

# The program that one_flight_test.py compares the nodes with.
set(target ${PROJECT_NAME}_one_flight)
add_executable(${target} ${PROJECT_SOURCE_DIR}/test/ros/one_flight.cpp)
set_target_properties(${target} PROPERTIES OUTPUT_NAME one_flight PREFIX "")
target_link_libraries(${target} PRIVATE ${PROJECT_NAME}_bags)
install(TARGETS ${target} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})

file(GLOB ros_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/ros/*.test
     ${PROJECT_SOURCE_DIR}/test/faults/ros/*.test)
foreach(test ${ros_tests})
  add_rostest(${test} DEPENDENCIES ${PROJECT_NAME}_window_detector ${PROJECT_NAME}_homography_pose
              ${PROJECT_NAME}_ingress_navigator ${PROJECT_NAME}_setpoint_guard ${PROJECT_NAME}_world
              ${PROJECT_NAME}_camera_mounting ${PROJECT_NAME}_image_compressor ${PROJECT_NAME}_replay_bag
              ${PROJECT_NAME}_one_flight)
endforeach()
install(DIRECTORY test/ros DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/test USE_SOURCE_PERMISSIONS)
