# Debian package of everything that is installed; dev/build_deb configures with prefix /usr and runs cpack.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME window-ingress)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "flies a small quadrotor through a rectangular window (ROS 1)")
set(CPACK_PACKAGE_DESCRIPTION "Finds a window in the images of one forward camera, estimates where it is, and steers a vehicle with PX4 or ArduPilot\n\
through it. Brings a simulated world, tools for calibration and measurement, and the messages.")
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
    python3:any python3-geometry-msgs python3-matplotlib python3-nav-msgs python3-numpy python3-opencv python3-rosbag
    python3-rosgraph-msgs python3-roslaunch python3-rosmaster python3-rosnode python3-rospy python3-rosservice
    python3-rostopic python3-sensor-msgs python3-std-msgs python3-std-srvs python3-visualization-msgs
    python3-yaml rosbash rosout topic-tools)
list(JOIN run_dependencies ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
# tf2-tools has static_transform_publisher; ingress campaign needs parallel, ingress evaluate envelope python3-deap.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "rviz, tf2-tools, parallel, python3-deap")

# What dpkg and Debian's policy ask for: licence, changelog, the linker's cache, bytecode made on the user's computer.
set(folder ${PROJECT_BINARY_DIR}/debian)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${folder}/changelog "${CPACK_PACKAGE_NAME} (${PROJECT_VERSION}) unstable; urgency=medium\n\n\
  * Built from the sources; see their CHANGELOG.rst.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")
execute_process(COMMAND gzip -9nf ${folder}/changelog)
file(WRITE ${folder}/triggers "activate-noawait ldconfig\n")
file(WRITE ${folder}/postinst "#!/bin/sh\nset -e\n[ \"$1\" != configure ] || py3compile -p ${CPACK_PACKAGE_NAME}\n")
file(WRITE ${folder}/prerm "#!/bin/sh\nset -e\npy3clean -p ${CPACK_PACKAGE_NAME}\n")
file(WRITE ${folder}/without_bytecode.cmake
     "file(GLOB_RECURSE found LIST_DIRECTORIES ON \${CPACK_TEMPORARY_DIRECTORY}/*/__pycache__)\n\
list(FILTER found INCLUDE REGEX __pycache__\$)\nif(found)\n  file(REMOVE_RECURSE \${found})\nendif()\n")
set(CPACK_PRE_BUILD_SCRIPTS ${folder}/without_bytecode.cmake)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${folder}/triggers ${folder}/postinst ${folder}/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
  #catkin_lint: ignore_once missing_file
  install(FILES ${folder}/changelog.gz DESTINATION share/doc/${CPACK_PACKAGE_NAME})
  install(FILES LICENSE DESTINATION share/doc/${CPACK_PACKAGE_NAME} RENAME copyright)
endif()
include(CPack)
