#!/usr/bin/python3
"""Two goals, one after another, for the vessel of sail.launch; the second while the first is sailed, beside another
vessel that is tracked."""
import math
import sys
import threading
import time
import unittest

import actionlib
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import Odometry
from otter_nav.msg import PlannerStatus, PlantState, Tracks

PATIENCE_S = 150.0


def pose(x, y):
    goal = PoseStamped()
    goal.header.frame_id = "map"
    goal.pose.position.x = x
    goal.pose.position.y = y
    goal.pose.orientation.w = 1.0
    return goal


class Sail(unittest.TestCase):
    def setUp(self):
        self.lock = threading.Lock()
        self.planner = None
        self.truth = None
        self.touched = False
        self.tracked = False
        rospy.Subscriber("planner_status", PlannerStatus, self.on_planner)
        rospy.Subscriber("plant_state", PlantState, self.on_truth)
        rospy.Subscriber("tracks", Tracks, self.on_tracks)

    def on_planner(self, message):
        with self.lock:
            self.planner = message

    def on_truth(self, message):
        with self.lock:
            self.truth = message
            self.touched = self.touched or bool(message.in_contact)

    def on_tracks(self, message):
        with self.lock:
            # She is the only one in the north, and sails east.
            self.tracked = self.tracked or any(
                abs(track.position.y - 16.0) < 1.0 and abs(track.velocity.x - 0.3) < 0.1
                for track in message.tracks)

    def until(self, done):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            with self.lock:
                if self.planner and self.truth and done():
                    return True
            time.sleep(0.05)
        return False

    def test_two_goals(self):
        rospy.wait_for_message("odom", Odometry, 60.0)
        self.assertTrue(self.until(lambda: math.hypot(self.truth.u, self.truth.v) < 0.05))
        start = self.truth.x, self.truth.y

        client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        # The clock is the plant's; until it is here, no time passes.
        self.assertTrue(client.wait_for_server(rospy.Duration(60.0)))
        client.send_goal(MoveBaseGoal(target_pose=pose(22.0, 8.0)))
        self.assertTrue(self.until(
            lambda: math.hypot(self.truth.x - start[0], self.truth.y - start[1]) > 3.0))
        self.assertEqual(client.get_state(), GoalStatus.ACTIVE)

        simple = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1, latch=True)
        simple.publish(pose(-2.0, -8.0))
        self.assertTrue(self.until(lambda: client.get_state() == GoalStatus.PREEMPTED))
        self.assertIn("another goal", client.get_goal_status_text())

        self.assertTrue(self.until(lambda: self.planner.state == PlannerStatus.ARRIVED), self.planner)
        self.assertLess(math.hypot(self.truth.x + 2.0, self.truth.y + 8.0), 1.0)
        self.assertFalse(self.touched)
        self.assertTrue(self.tracked)


if __name__ == "__main__":
    rospy.init_node("sail_test")
    rostest.rosrun("otter_nav", "sail_test", Sail, sys.argv)
