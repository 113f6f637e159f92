# What roslaunch and rosrun find after `colcon build` (programs install themselves).
foreach(folder config launch maps rviz)
  install(DIRECTORY ${folder}/ DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/${folder})
endforeach()
if(EXISTS ${PROJECT_SOURCE_DIR}/scenarios)
  install(DIRECTORY scenarios/ DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scenarios)
endif()
catkin_install_python(PROGRAMS python/programs/animate python/programs/bag_to_tum python/programs/report
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
