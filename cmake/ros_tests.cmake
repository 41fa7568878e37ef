# ROS tests: every test/ros/<name>.test is one rostest with a master of its own; <name>_test.py is what it runs.
find_package(catkin REQUIRED COMPONENTS roslaunch rostest)

roslaunch_add_file_check(launch IGNORE_UNSET_ARGS)

file(GLOB ros_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/ros/*.test)
foreach(test ${ros_tests})
  add_rostest(${test} DEPENDENCIES ${PROJECT_NAME}_window_detector ${PROJECT_NAME}_homography_pose
              ${PROJECT_NAME}_ingress_navigator ${PROJECT_NAME}_setpoint_guard ${PROJECT_NAME}_world)
endforeach()
