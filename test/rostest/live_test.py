#!/usr/bin/python3
"""Nodes that were there before the plant sail on its clock; a speed limit set under way is kept."""
import math
import subprocess
import sys
import time
import unittest

import rospkg
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import PoseStamped
from otter_nav.msg import PlannerStatus, PlantState, Trajectory
from rosgraph_msgs.msg import Log

PATIENCE_S = 100.0
LIMIT_MPS = 1.0


class Live(unittest.TestCase):
    def setUp(self):
        self.planner = self.truth = self.plan = None
        self.log = []
        rospy.Subscriber("rosout", Log, lambda m: self.log.append(m.msg))
        rospy.Subscriber("planner_status", PlannerStatus, lambda m: setattr(self, "planner", m))
        rospy.Subscriber("plant_state", PlantState, lambda m: setattr(self, "truth", m))
        rospy.Subscriber("trajectory", Trajectory, lambda m: setattr(self, "plan", m))
        self.plant = None

    def tearDown(self):
        if self.plant:
            self.plant.terminate()
            self.plant.wait()

    def until(self, done):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end and not done():
            time.sleep(0.05)
        return done()

    def speed(self):
        return math.hypot(self.truth.u, self.truth.v)

    def test_live(self):
        time.sleep(3.0)  # on the computer's clock
        package = rospkg.RosPack().get_path("otter_nav")
        scenario = package + "/maps/demo/demo.yaml"
        self.plant = subprocess.Popen(["roslaunch", package + "/launch/plant.launch", "disturbance:=none",
                                       "scenario:=" + scenario])
        self.assertTrue(self.until(lambda: self.truth), "no plant")
        self.assertTrue(self.until(lambda: sum("starts anew" in line for line in self.log) >= 2), self.log)
        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position.x, goal.pose.position.y, goal.pose.orientation.w = 22.0, 8.0, 1.0
        publisher = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1, latch=True)
        publisher.publish(goal)
        self.assertTrue(self.until(lambda: self.speed() > 1.5), (self.planner, self.log[-5:]))

        client = Client("planner_node", timeout=30)
        told = client.update_configuration({"speed_max_mps": LIMIT_MPS})
        self.assertEqual(told["speed_max_mps"], LIMIT_MPS)
        self.assertTrue(self.until(lambda: 0.0 < self.plan.speed_max <= LIMIT_MPS), self.planner)
        self.assertTrue(self.until(lambda: self.speed() < 1.03 * LIMIT_MPS), self.truth)
        end = time.monotonic() + 8.0
        fastest = 0.0
        while time.monotonic() < end and self.planner.state == PlannerStatus.SAILING:
            fastest = max(fastest, self.speed())
            time.sleep(0.05)
        self.assertLess(fastest, 1.05 * LIMIT_MPS)

        # Below what a vessel can steer by: refused, and the old value stays.
        self.assertEqual(client.update_configuration({"speed_max_mps": 0.1})["speed_max_mps"], LIMIT_MPS)
        # On the parameter server it works as well, and what has no effect is said.
        rospy.set_param("planner_node/supervisor/speed_max_mps", 1.5)
        self.assertTrue(self.until(lambda: any("speed_max_mps: 1.5" in line for line in self.log)), self.log[-5:])
        rospy.set_param("planner_node/planner/sigma", 20.0)
        self.assertTrue(self.until(lambda: any("planner/sigma" in line and "no effect" in line for line in self.log)),
                        self.log[-5:])
        # Nor does it come along with, or stand in the way of, what is changed later.
        rospy.set_param("planner_node/planner/sigma", -1.0)
        self.assertTrue(self.until(lambda: sum("planner/sigma" in line and "no effect" in line
                                               for line in self.log) >= 2), self.log[-5:])
        self.assertEqual(client.update_configuration({"speed_max_mps": 1.4})["speed_max_mps"], 1.4)
        rospy.set_param("planner_node/speed_max_mps", 1.2)
        self.assertTrue(self.until(lambda: any("'speed_max_mps'" in line and "no effect" in line
                                               and "supervisor/speed_max_mps" in line for line in self.log)),
                        self.log[-5:])
        # In place of a list, under an index that is none: said, and sailed on.
        rospy.set_param("planner_node/supervisor/side_clearances_m/99999999999", 0.1)
        self.assertTrue(self.until(lambda: any("side_clearances_m/99999999999" in line for line in self.log)),
                        self.log[-5:])
        self.assertEqual(client.update_configuration({"speed_max_mps": 1.3})["speed_max_mps"], 1.3)
        weights = Client("tracker_node", timeout=30)
        self.assertEqual(weights.update_configuration({"position": 150.0})["position"], 150.0)


if __name__ == "__main__":
    rospy.init_node("live_test", disable_rostime=True)
    rostest.rosrun("otter_nav", "live_test", Live, sys.argv)
