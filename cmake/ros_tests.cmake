# ROS tests: every test/ros/<name>.test is one rostest with a master of its own; <name>_test.py is what it runs.
find_package(catkin REQUIRED COMPONENTS roslaunch rostest)

roslaunch_add_file_check(launch IGNORE_UNSET_ARGS)

file(GLOB ros_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/ros/*.test)
foreach(test ${ros_tests})
  add_rostest(${test} DEPENDENCIES window_detector homography_pose ingress_navigator setpoint_guard world)
endforeach()
