#!/usr/bin/python3
"""A planner of one's own: from where the vessel lies straight ahead, up to a speed and down to rest.

    rosrun otter_nav constant_speed_planner.py _distance_m:=20 _speed_mps:=1.0

Publishes one `trajectory` (docs/interfaces.md), and waits until the tracker says that it took it."""
import math
import sys
import rospy
from nav_msgs.msg import Odometry
from otter_nav.msg import TrackerStatus, Trajectory, TrajectoryPiece

rospy.init_node("constant_speed_planner")
distance, v, ramp_s = rospy.get_param("~distance_m", 20.0), rospy.get_param("~speed_mps", 1.0), 6.0
pose = rospy.wait_for_message("odom", Odometry).pose.pose
heading = 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)


def piece(duration, *ahead):
    """Of the metres ahead of here, the coefficients of 1, t, t^2, ..."""
    ahead = list(ahead) + [0.0] * (8 - len(ahead))
    x, y = ([pull * a for a in ahead] for pull in (math.cos(heading), math.sin(heading)))
    x[0], y[0] = x[0] + pose.position.x, y[0] + pose.position.y
    return TrajectoryPiece(kind=TrajectoryPiece.SAIL, duration=duration, x=x, y=y)


plan = Trajectory(id=rospy.get_param("~id", 1), speed_max=v)
plan.header.frame_id = rospy.get_param("frames/map", "map")
plan.header.stamp = rospy.Time.now() + rospy.Duration(0.5)
up = [c * v / ramp_s**k for c, k in ((2.5, 3), (-3.0, 4), (1.0, 5))]  # jerk is 0 at both ends
plan.pieces = [piece(ramp_s, 0.0, 0.0, 0.0, 0.0, *up),
               piece(distance / v - ramp_s, 0.5 * v * ramp_s, v),
               piece(ramp_s, distance - 0.5 * v * ramp_s, v, 0.0, 0.0, *(-c for c in up))]
publisher = rospy.Publisher("trajectory", Trajectory, queue_size=1, latch=True)
publisher.publish(plan)
status = TrackerStatus()
while not rospy.is_shutdown() and plan.id not in (status.accepted_id, status.refused_id):
    status = rospy.wait_for_message("tracker_status", TrackerStatus)
if status.refused_id == plan.id:
    sys.exit("refused: " + status.refused_reason)
rospy.spin()
