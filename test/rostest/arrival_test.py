#!/usr/bin/python3
"""An arrival counts by the true place; on another heading only with the reason why the goal's can't be held."""
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest

import actionlib
import rospkg
import rospy
import rostest
import yaml
from move_base_msgs.msg import MoveBaseAction
from otter_nav.msg import PlannerStatus, PlantState

PACKAGE = rospkg.RosPack().get_path("otter_nav")
SCENARIO = os.path.join(PACKAGE, "maps", "demo", "demo.yaml")
PATIENCE_S = 20.0
WHY = "wind and current would set the vessel aside on it"


class Arrival(unittest.TestCase):
    def outcome(self, away_m, turned_rad, reason):
        """Of a mission whose planner says that it has arrived, with the vessel there."""
        with open(SCENARIO, encoding="utf-8") as file:
            x, y, psi = yaml.safe_load(file)["missions"][0]["goal"]
        state = rospy.Publisher("plant_state", PlantState, queue_size=10)
        status = rospy.Publisher("planner_status", PlannerStatus, queue_size=10)
        with tempfile.TemporaryDirectory() as folder:
            result = os.path.join(folder, "result.json")
            node = subprocess.Popen(
                ["rosrun", "otter_nav", "mission_node", "_scenario:=" + SCENARIO, "_mission:=0", "_seed:=1",
                 "_vessel:=otter_gazebo", "_disturbance:=hard", "_result:=" + result, "_timeout_s:=900.0",
                 "_recorded:=false"])
            end = time.monotonic() + PATIENCE_S
            stamp = 0.0
            while node.poll() is None and time.monotonic() < end:
                stamp += 0.1
                there = PlantState(x=x + away_m, y=y, yaw=psi + turned_rad, clearance=5.0)
                there.header.stamp = rospy.Time.from_sec(stamp)
                state.publish(there)
                if self.goals:
                    arrived = PlannerStatus(state=PlannerStatus.ARRIVED, reason=reason)
                    arrived.header.stamp = rospy.Time.from_sec(stamp)
                    status.publish(arrived)
                time.sleep(0.05)
            self.assertIsNotNone(node.poll(), "the mission did not end")
            with open(result, encoding="utf-8") as file:
                return json.load(file)["missions"][0]

    def setUp(self):
        self.goals = []
        self.server = actionlib.ActionServer("move_base", MoveBaseAction, self.goals.append, lambda goal: None,
                                             auto_start=False)
        self.server.start()

    def test_arrivals(self):
        self.assertEqual(self.outcome(0.3, 0.1, "")["outcome"], "arrived")
        self.goals.clear()
        elsewhere = self.outcome(0.3, 1.2, WHY)
        self.assertEqual((elsewhere["outcome"], elsewhere["reason"]), ("arrived", WHY))
        self.goals.clear()
        self.assertEqual(self.outcome(0.3, 1.2, "")["outcome"], "stopped")
        self.goals.clear()
        self.assertEqual(self.outcome(3.4, 0.0, WHY)["outcome"], "stopped")


if __name__ == "__main__":
    rospy.init_node("arrival_test", disable_rostime=True)
    rostest.rosrun("otter_nav", "arrival_test", Arrival, sys.argv)
