#!/usr/bin/python3
"""A tracker of one's own in thirty lines: steers for the point that the trajectory has a little ahead.

    rosrun otter_nav pursuit_tracker.py

Takes `trajectory` and `odom`, gives `thruster_command` and what the planner has to know of it in
`tracker_status` (docs/interfaces.md). Gains for the vessel otter_gazebo."""
import math

import rospy
from nav_msgs.msg import Odometry
from otter_nav.msg import ThrusterCommand, TrackerStatus, Trajectory

AHEAD_S, SURGE_GAIN, DRAG, YAW_GAIN, YAW_DAMPING, LEVER_M, MOST_N = 1.5, 40.0, 20.0, 60.0, 30.0, 0.39, 45.0


class Pursuit:
    def __init__(self):
        self.plan, self.status = None, TrackerStatus(state=TrackerStatus.IDLE)
        self.command = rospy.Publisher("thruster_command", ThrusterCommand, queue_size=10)
        self.report = rospy.Publisher("tracker_status", TrackerStatus, queue_size=10)
        rospy.Subscriber("trajectory", Trajectory, self.on_trajectory)
        rospy.Subscriber("odom", Odometry, self.on_odometry)

    def on_trajectory(self, plan):
        self.plan = plan
        self.status.accepted_id = plan.id  # else the planner waits for it

    def target(self, t):
        """Where the trajectory is t seconds after its start, and how long it lasts."""
        for k, piece in enumerate(self.plan.pieces):
            if t < piece.duration or k + 1 == len(self.plan.pieces):
                t = min(max(t, 0.0), piece.duration)
                return sum(c * t ** i for i, c in enumerate(piece.x)), sum(c * t ** i for i, c in enumerate(piece.y))
            t -= piece.duration
        return None

    def on_odometry(self, odometry):
        at, twist, q = odometry.pose.pose.position, odometry.twist.twist, odometry.pose.pose.orientation
        surge, moment = -DRAG * twist.linear.x, -YAW_DAMPING * twist.angular.z
        now = odometry.header.stamp
        self.status.state = TrackerStatus.STOPPED
        if self.plan and self.plan.pieces and now >= self.plan.header.stamp:
            t = (now - self.plan.header.stamp).to_sec()
            x, y = self.target(t + AHEAD_S)
            east, north = x - at.x, y - at.y
            off = math.atan2(north, east) - 2.0 * math.atan2(q.z, q.w)
            off = math.atan2(math.sin(off), math.cos(off))
            away = math.hypot(east, north)
            if away > 0.3:  # nearer, the course says nothing
                surge = SURGE_GAIN * (away / AHEAD_S * math.cos(off) - twist.linear.x) + DRAG * twist.linear.x
                moment += YAW_GAIN * off
            left = sum(p.duration for p in self.plan.pieces) - t
            self.status.state = TrackerStatus.TRACKING if left > 0.0 else TrackerStatus.HOLDING
            self.status.trajectory_id, self.status.time_left = self.plan.id, max(left, 0.0)
        command = ThrusterCommand(header=odometry.header)
        command.header.frame_id = "base_link"
        turn = max(-MOST_N, min(MOST_N, 0.5 * moment / LEVER_M))
        mean = max(abs(turn) - MOST_N, min(MOST_N - abs(turn), 0.5 * surge))
        command.left, command.right = mean - turn, mean + turn
        self.command.publish(command)
        self.status.header.stamp, self.status.header.frame_id = now, "map"
        self.report.publish(self.status)


if __name__ == "__main__":
    rospy.init_node("pursuit_tracker")
    Pursuit()
    rospy.spin()
