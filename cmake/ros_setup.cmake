# The ROS side of the build: messages, and the catkin package around the core.
# Packages that look for Python themselves must find the interpreter catkin uses.
set(Python3_EXECUTABLE ${PYTHON_EXECUTABLE} CACHE FILEPATH "Python for ament" FORCE)
find_package(catkin REQUIRED COMPONENTS
  actionlib diagnostic_msgs diagnostic_updater dynamic_reconfigure geometry_msgs map_msgs
  message_generation move_base_msgs nav_msgs rosbag roscpp rosgraph_msgs sensor_msgs std_msgs std_srvs tf2 tf2_msgs
  tf2_ros topic_tools visualization_msgs xmlrpcpp)

# Messages are generated into the Python package of python/.
catkin_python_setup()
add_message_files(FILES
  ContactEvent.msg DisturbanceEstimate.msg Foreseen.msg GuidePath.msg NearObstacles.msg PlannerStatus.msg
  PlantState.msg Route.msg ThrusterCommand.msg Track.msg TrackerCycle.msg TrackerStatus.msg Tracks.msg Trajectory.msg TrajectoryPiece.msg)
add_service_files(FILES FindGuidePath.srv SaveMap.srv)
generate_messages(DEPENDENCIES geometry_msgs std_msgs)

catkin_package(
  INCLUDE_DIRS include
  CATKIN_DEPENDS geometry_msgs message_runtime std_msgs)
