#!/usr/bin/python3
"""What goes wrong round a planner under way: its clock, the stamps it gets, its lidar, an operator's stop."""
import math
import sys
import threading
import time
import unittest

import actionlib
import rospy
import rostest
import tf2_ros
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import TransformStamped
from map_msgs.msg import OccupancyGridUpdate
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import Odometry
from otter_nav.msg import PlannerStatus, Trajectory
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Trigger

PATIENCE_S = 30.0
START = (-22.0, -8.0)
BLIND = "no scan comes into the map any more"


class Vessel:
    """Its clock, its place and its scans, which the test may change."""

    def __init__(self):
        self.now_s = 1000.0
        self.tells_odometry = self.tells_scans = False
        self.range_m = 20.0
        self.clock = rospy.Publisher("clock", Clock, queue_size=1)
        self.odometry = rospy.Publisher("odom", Odometry, queue_size=10)
        self.scans = rospy.Publisher("scan", LaserScan, queue_size=10)
        self.transforms = tf2_ros.TransformBroadcaster()
        self.runs = True
        self.lock = threading.Lock()
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        step = 0
        while self.runs and not rospy.is_shutdown():
            self.jump(0.02)
            stamp = rospy.Time.from_sec(self.now_s)
            self.clock.publish(Clock(clock=stamp))
            if self.tells_odometry:
                self.tell_odometry(stamp)
            if self.tells_scans and step % 5 == 0:
                self.tell_scan(stamp)
            step += 1
            time.sleep(0.02)

    def jump(self, by_s):
        with self.lock:
            self.now_s += by_s

    def tell_odometry(self, stamp):
        message = Odometry()
        message.header.stamp = stamp
        message.header.frame_id, message.child_frame_id = "odom", "base_link"
        message.pose.pose.position.x, message.pose.pose.position.y = START
        message.pose.pose.orientation.w = 1.0
        self.odometry.publish(message)

    def tell_scan(self, stamp):
        transforms = []
        for parent, child, place in (("map", "base_link", START), ("base_link", "lidar", (0.0, 0.0))):
            transform = TransformStamped()
            transform.header.stamp, transform.header.frame_id, transform.child_frame_id = stamp, parent, child
            transform.transform.translation.x, transform.transform.translation.y = place
            transform.transform.rotation.w = 1.0
            transforms.append(transform)
        self.transforms.sendTransform(transforms)
        scan = LaserScan()
        scan.header.stamp, scan.header.frame_id = stamp, "lidar"
        scan.angle_min, scan.angle_increment = -0.02, 0.004
        scan.range_min, scan.range_max = 0.2, 25.0
        scan.ranges = [self.range_m] * 10
        self.scans.publish(scan)


class Faults(unittest.TestCase):
    def setUp(self):
        self.vessel = Vessel()
        self.trajectories, self.statuses, self.updates = [], [], []
        rospy.Subscriber("trajectory", Trajectory, self.trajectories.append)
        rospy.Subscriber("planner_status", PlannerStatus, self.statuses.append)
        rospy.Subscriber("map_updates", OccupancyGridUpdate, self.updates.append)
        self.goals = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        self.until(lambda: self.goals.action_client.wait_for_server(rospy.Duration(0.1)))
        rospy.wait_for_service("planner_node/stop")
        self.stop = rospy.ServiceProxy("planner_node/stop", Trigger)

    def until(self, done, patience_s=PATIENCE_S):
        end = time.monotonic() + patience_s
        while not (holds := done()) and time.monotonic() < end:
            time.sleep(0.05)
        return holds

    def send_goal(self):
        goal = MoveBaseGoal()
        goal.target_pose.header.frame_id = "map"
        goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = 22.0, 8.0
        goal.target_pose.pose.orientation.w = 1.0
        self.goals.send_goal(goal)

    def sails(self, patience_s=PATIENCE_S):
        """Whether a way is sent to the tracker."""
        return self.until(lambda: any(trajectory.pieces for trajectory in self.trajectories), patience_s)

    def state(self):
        return self.goals.get_state()

    def test_faults(self):
        # A goal waits for the vessel's place; the operator changes his mind.
        self.assertTrue(self.until(lambda: self.vessel.clock.get_num_connections() >= 2))
        self.send_goal()
        self.assertTrue(self.until(lambda: self.state() == GoalStatus.PENDING))
        self.assertTrue(self.until(lambda: self.stop().success), "the goal that waited was not dropped")
        self.vessel.tells_odometry = True
        self.assertFalse(self.sails(3.0), "sails to a goal that was stopped")
        self.assertEqual(self.state(), GoalStatus.REJECTED)

        # A stamp beyond any clock is refused.
        self.vessel.tell_odometry(rospy.Time(4294967295, 0))
        self.send_goal()
        self.assertTrue(self.sails(), "no plan")

        # The clock is set back, and odometry comes late.
        self.trajectories.clear()
        self.vessel.tells_odometry = False
        self.vessel.jump(-300.0)
        self.assertTrue(self.until(lambda: self.state() == GoalStatus.ABORTED), self.state())
        self.assertEqual(self.goals.get_goal_status_text(), "the clock was set back")
        self.assertTrue(self.until(lambda: any(not t.pieces for t in self.trajectories)), "no order to stop")
        self.assertFalse(any(t.pieces for t in self.trajectories))
        self.send_goal()
        self.assertFalse(self.sails(0.5), "sails from where it was before")
        self.vessel.tells_odometry = True
        self.assertTrue(self.sails(), ("no plan on the new clock", self.state(), self.statuses[-1]))
        self.goals.cancel_goal()

        # The lidar begins to tell nonsense.
        self.vessel.tells_scans = True
        self.assertTrue(self.until(lambda: any(update.data for update in self.updates)))
        self.vessel.range_m = -1.0
        self.assertTrue(self.until(lambda: not self.updates[-1].data), "a refused scan changes the map")
        time.sleep(3.0)
        self.trajectories.clear()
        self.send_goal()
        self.assertTrue(self.until(lambda: self.statuses[-1].reason == BLIND), self.statuses[-1])
        self.assertFalse(any(t.pieces for t in self.trajectories), "sets out blind")
        self.vessel.range_m = math.nan
        self.assertFalse(self.sails(2.0), "sets out by a scan that shows nothing")
        self.vessel.range_m = math.inf
        self.send_goal()
        self.assertTrue(self.sails(), "does not go on once the scans make sense")


if __name__ == "__main__":
    rospy.init_node("faults_test")
    rostest.rosrun("otter_nav", "faults_test", Faults, sys.argv)
