#!/usr/bin/python3
"""A tracker of one's own: steers for the point that the trajectory has a little ahead.

    rosrun otter_nav pursuit_tracker.py

Takes `trajectory` and `odom`, gives `thruster_command` and what the planner has to know of it in
`tracker_status` (docs/interfaces.md). Gains for the vessel otter_gazebo."""
import math
import rospy
from nav_msgs.msg import Odometry
from otter_nav.msg import ThrusterCommand, TrackerStatus, Trajectory

AHEAD_S, SPEED_GAIN, DRAG, YAW_GAIN, YAW_DAMPING, MOST_N = 1.5, 20.0, 10.0, 77.0, 38.0, 45.0
plan, status = Trajectory(), TrackerStatus(state=TrackerStatus.IDLE)


def on_trajectory(message):
    global plan
    plan, status.accepted_id = message, message.id  # said at once: the planner waits for it


def on_odometry(odometry):
    at, twist, q = odometry.pose.pose.position, odometry.twist.twist, odometry.pose.pose.orientation
    ahead, turn = -DRAG * twist.linear.x, -YAW_DAMPING * twist.angular.z  # N, each thruster
    t = (odometry.header.stamp - plan.header.stamp).to_sec()
    left_s = sum(piece.duration for piece in plan.pieces) - t
    status.state = "stopped" if not plan.pieces else "tracking" if left_s > 0.0 else "holding"
    status.trajectory_id, status.time_left, t = plan.id, max(left_s, 0.0), max(t + AHEAD_S, 0.0)
    for piece in plan.pieces:
        if t > piece.duration and piece is not plan.pieces[-1]:
            t -= piece.duration
            continue
        x, y = (sum(c * min(t, piece.duration)**k for k, c in enumerate(axis)) for axis in (piece.x, piece.y))
        away, course = math.hypot(x - at.x, y - at.y), math.atan2(y - at.y, x - at.x)
        off = math.remainder(course - 2.0 * math.atan2(q.z, q.w), 2.0 * math.pi) if away > 0.3 else 0.0
        ahead = SPEED_GAIN * (away / AHEAD_S * math.cos(off) - twist.linear.x) + DRAG * twist.linear.x
        turn = max(-MOST_N, min(MOST_N, turn + YAW_GAIN * off))
        break
    ahead = max(abs(turn) - MOST_N, min(MOST_N - abs(turn), ahead))
    status.header.stamp = odometry.header.stamp
    report.publish(status)
    odometry.header.frame_id = odometry.child_frame_id
    command.publish(ThrusterCommand(odometry.header, ahead - turn, ahead + turn))


rospy.init_node("pursuit_tracker")
command = rospy.Publisher("thruster_command", ThrusterCommand, queue_size=10)
report = rospy.Publisher("tracker_status", TrackerStatus, queue_size=10)
rospy.Subscriber("trajectory", Trajectory, on_trajectory)
rospy.Subscriber("odom", Odometry, on_odometry)
rospy.spin()
