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
from actionlib_msgs.msg import GoalStatus
from move_base_msgs.msg import MoveBaseAction
from otter_nav.msg import PlannerStatus, PlantState

PACKAGE = rospkg.RosPack().get_path("otter_nav")
SCENARIO = os.path.join(PACKAGE, "maps", "demo", "demo.yaml")
PATIENCE_S = 20.0
WHY = "wind and current would set the vessel aside on it"


class Arrival(unittest.TestCase):
    def told(self, goal_s):
        """The planner's state so long after the goal came (before it: less than 0); it arrives at once."""
        return PlannerStatus.IDLE if goal_s < 0.0 else PlannerStatus.ARRIVED

    def ends(self, goal_s):
        """Whether the action has ended."""
        return goal_s >= 0.0

    def end(self, goal):
        """How."""
        goal.set_succeeded()

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
            stamp = goal_at = 0.0
            while node.poll() is None and time.monotonic() < end:
                stamp += 0.1
                there = PlantState(x=x + away_m, y=y, yaw=psi + turned_rad, clearance=5.0)
                there.header.stamp = rospy.Time.from_sec(stamp)
                state.publish(there)
                if not self.goals:
                    goal_at = stamp
                elif self.goals[0].get_goal_status().status == GoalStatus.PENDING:
                    self.goals[0].set_accepted()
                goal_s = stamp - goal_at if self.goals else -1.0
                planner = PlannerStatus(state=self.told(goal_s), reason=reason)
                planner.header.stamp = rospy.Time.from_sec(stamp)
                status.publish(planner)
                if self.ends(goal_s) and self.goals[0].get_goal_status().status == GoalStatus.ACTIVE:
                    self.end(self.goals[0])
                time.sleep(0.05)
            self.assertIsNotNone(node.poll(), "the mission did not end")
            with open(result, encoding="utf-8") as file:
                return json.load(file)["missions"][0]

    @classmethod
    def setUpClass(cls):
        cls.goals = []
        cls.server = actionlib.ActionServer("move_base", MoveBaseAction, lambda goal: cls.goals.append(goal),
                                            lambda goal: None, auto_start=False)
        cls.server.start()

    def setUp(self):
        self.goals.clear()

    def test_arrivals(self):
        self.assertEqual(self.outcome(0.3, 0.1, "")["outcome"], "arrived")
        self.goals.clear()
        elsewhere = self.outcome(0.3, 1.2, WHY)
        self.assertEqual((elsewhere["outcome"], elsewhere["reason"]), ("arrived", WHY))
        self.goals.clear()
        self.assertEqual(self.outcome(0.3, 1.2, "")["outcome"], "stopped")
        self.goals.clear()
        self.assertEqual(self.outcome(3.4, 0.0, WHY)["outcome"], "stopped")

    def test_arrival_of_the_goal_before(self):
        """Beside a vessel that lies at its goal the planner says so until it has taken the new one, and a while
        longer here, as a message that comes late does."""
        late_s, arrives_s = 1.0, 3.5
        self.told = lambda goal_s: (PlannerStatus.SAILING if late_s < goal_s < arrives_s else PlannerStatus.ARRIVED)
        self.ends = lambda goal_s: goal_s >= arrives_s
        mission = self.outcome(0.3, 0.1, "")
        self.assertEqual(mission["outcome"], "arrived")
        # It counts from the first state that it hears, which may be a step or two later than the goal's here.
        self.assertGreater(mission["duration_s"], arrives_s - 0.5)

    def test_stop_by_the_operator(self):
        """Ends the mission, but not before the vessel has come to rest."""
        sails_s, brakes_until_s, why = 1.0, 7.0, "stopped by the operator"
        self.told = lambda goal_s: (PlannerStatus.IDLE if goal_s < 0.0 or goal_s > brakes_until_s
                                    else PlannerStatus.SAILING if goal_s < sails_s else PlannerStatus.STOPPING)
        self.ends = lambda goal_s: goal_s >= sails_s
        self.end = lambda goal: goal.set_aborted(text=why)
        mission = self.outcome(3.4, 0.0, "")
        self.assertEqual((mission["outcome"], mission["reason"]), ("stopped", why))
        self.assertGreater(mission["duration_s"], brakes_until_s - 0.5)


if __name__ == "__main__":
    rospy.init_node("arrival_test", disable_rostime=True)
    rostest.rosrun("otter_nav", "arrival_test", Arrival, sys.argv)
