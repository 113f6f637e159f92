# What roslaunch and rosrun find after `colcon build` (programs install themselves).
foreach(folder config launch maps rviz)
  install(DIRECTORY ${folder}/ DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/${folder})
endforeach()
if(EXISTS ${PROJECT_SOURCE_DIR}/scenarios)
  install(DIRECTORY scenarios/ DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scenarios)
endif()
# `otter_nav PROGRAM`, with its completion in bash.
install(PROGRAMS scripts/otter_nav DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
install(FILES packaging/otter_nav.bash
  DESTINATION ${CATKIN_GLOBAL_SHARE_DESTINATION}/bash-completion/completions RENAME otter_nav)
# Of rosrun and roslaunch with the workspace's setup.bash; a Debian package finds rosbash's own.
if(NOT CATKIN_BUILD_BINARY_PACKAGE)
  catkin_add_env_hooks(50.ros_completion SHELLS bash DIRECTORY ${PROJECT_SOURCE_DIR}/packaging)
endif()
install(FILES plugin_description.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
catkin_install_python(PROGRAMS examples/constant_speed_planner.py examples/pursuit_tracker.py
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
catkin_install_python(PROGRAMS python/programs/animate python/programs/bag_to_tum python/programs/latency python/programs/replay_bag
  python/programs/report
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
