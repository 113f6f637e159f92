#!/usr/bin/python3
"""A goal that comes with the node, before map and odometry, waits for them."""
import os
import signal
import subprocess
import sys
import time
import unittest

import rospkg
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus, GoalStatusArray
from move_base_msgs.msg import MoveBaseActionGoal

LAUNCH = os.path.join(rospkg.RosPack().get_path("otter_nav"), "launch", "planning.launch")
PATIENCE_S = 20.0
WAITS_S = 3.0


class WaitingGoal(unittest.TestCase):
    def setUp(self):
        self.states = []
        rospy.Subscriber("move_base/status", GoalStatusArray,
                         lambda m: self.states.extend(goal.status for goal in m.status_list))
        goal = MoveBaseActionGoal()
        goal.goal_id.id = "early"
        goal.goal.target_pose.header.frame_id = "map"
        goal.goal.target_pose.pose.orientation.w = 1.0
        self.publisher = rospy.Publisher("move_base/goal", MoveBaseActionGoal, queue_size=1, latch=True)
        self.publisher.publish(goal)
        self.launch = subprocess.Popen(["roslaunch", LAUNCH])
        self.addCleanup(self.launch.wait)
        self.addCleanup(self.launch.send_signal, signal.SIGINT)

    def test_waits(self):
        end = time.monotonic() + PATIENCE_S
        while not self.states and time.monotonic() < end:
            time.sleep(0.02)
        time.sleep(WAITS_S)
        self.assertEqual(set(self.states), {GoalStatus.PENDING})


if __name__ == "__main__":
    rospy.init_node("waiting_goal_test")
    rostest.rosrun("otter_nav", "waiting_goal_test", WaitingGoal, sys.argv)
