#!/usr/bin/python3
"""A planner of one's own in thirty lines: from where the vessel lies straight ahead, at a steady speed.

    rosrun otter_nav constant_speed_planner.py _distance_m:=20 _speed_mps:=1.0

Publishes one `trajectory` (docs/interfaces.md) of a ramp, a steady stretch and a ramp down to rest,
and waits until the tracker says that it took it."""
import math
import sys

import rospy
from nav_msgs.msg import Odometry
from otter_nav.msg import TrackerStatus, Trajectory, TrajectoryPiece

RAMP_S = 6.0
# Way over one ramp as a share of speed * time: the integral of 10 t^3 - 15 t^4 + 6 t^5, t from 0 to 1.
UP = [0.0, 0.0, 0.0, 0.0, 2.5, -3.0, 1.0, 0.0]


def piece(start_m, ramp, speed, duration, heading, origin):
    """Metres along the heading: start + speed * (linear * t + share * UP(t / duration) * duration)."""
    linear, share = ramp
    along = [share * speed * duration * c / duration ** k for k, c in enumerate(UP)]
    along[0] += start_m
    along[1] += linear * speed
    return TrajectoryPiece(kind=TrajectoryPiece.SAIL, duration=duration,
                           x=[math.cos(heading) * a + (origin.x if k == 0 else 0.0) for k, a in enumerate(along)],
                           y=[math.sin(heading) * a + (origin.y if k == 0 else 0.0) for k, a in enumerate(along)])


def main():
    rospy.init_node("constant_speed_planner")
    distance, speed = rospy.get_param("~distance_m", 20.0), rospy.get_param("~speed_mps", 1.0)
    odometry = rospy.wait_for_message("odom", Odometry)
    q, at = odometry.pose.pose.orientation, odometry.pose.pose.position
    heading = 2.0 * math.atan2(q.z, q.w)
    plan = Trajectory(id=rospy.get_param("~id", 1), speed_max=speed)
    plan.header.frame_id = rospy.get_param("~map_frame", "map")
    plan.header.stamp = rospy.Time.now() + rospy.Duration(0.5)
    ramp_m, steady_s = 0.5 * speed * RAMP_S, distance / speed - RAMP_S
    plan.pieces = [piece(0.0, (0, 1), speed, RAMP_S, heading, at),
                   piece(ramp_m, (1, 0), speed, steady_s, heading, at),
                   piece(distance - ramp_m, (1, -1), speed, RAMP_S, heading, at)]
    publisher = rospy.Publisher("trajectory", Trajectory, queue_size=1, latch=True)
    publisher.publish(plan)
    status = TrackerStatus()
    while not rospy.is_shutdown() and plan.id not in (status.accepted_id, status.refused_id):
        status = rospy.wait_for_message("tracker_status", TrackerStatus)
    if status.refused_id == plan.id:
        sys.exit("refused: " + status.refused_reason)
    rospy.spin()


if __name__ == "__main__":
    main()
