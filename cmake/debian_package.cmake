# Debian package of everything that is installed; dev/build_deb configures with prefix /usr and runs cpack.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME window-ingress)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "flies a small quadrotor through a rectangular window (ROS 1)")
set(CPACK_PACKAGE_CONTACT "The ${PROJECT_NAME} developers <window-ingress@example.com>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# dpkg-shlibdeps finds the libraries; this list is what scripts and launch files call. roslaunch needs the package.xml
# of topic_tools, which Debian ships with the headers.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/devel/lib)
set(run_dependencies
    libnodeletlib-tools libtopic-tools-dev python3-actionlib python3-diagnostic-msgs python3-dynamic-reconfigure
    python3-geometry-msgs python3-matplotlib python3-nav-msgs python3-numpy python3-opencv python3-rosbag
    python3-rosgraph-msgs python3-roslaunch python3-rosmaster python3-rosnode python3-rospy python3-rosservice
    python3-rostopic python3-sensor-msgs python3-std-msgs python3-std-srvs python3-visualization-msgs
    python3-yaml rosbash rosout topic-tools)
list(JOIN run_dependencies ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
# tf2-tools has static_transform_publisher; ingress campaign needs parallel, ingress evaluate envelope python3-deap.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "rviz, tf2-tools, parallel, python3-deap")
include(CPack)
