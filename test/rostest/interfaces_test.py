#!/usr/bin/python3
"""The examples of docs/interfaces.md sail: 20 m at no more than 1 m/s, and come to rest there."""
import copy
import math
import sys
import time
import unittest

import rospy
import rostest
from otter_nav.msg import PlantState, TrackerStatus, Trajectory

DISTANCE_M, SPEED_MPS, PATIENCE_S = 20.0, 1.0, 90.0


class Interfaces(unittest.TestCase):
    def setUp(self):
        self.truth, self.fastest, self.status, self.plan = None, 0.0, TrackerStatus(), None
        rospy.Subscriber("plant_state", PlantState, self.on_truth)
        rospy.Subscriber("tracker_status", TrackerStatus, lambda m: setattr(self, "status", m))
        rospy.Subscriber("trajectory", Trajectory, lambda m: setattr(self, "plan", self.plan or m))

    def on_truth(self, message):
        self.fastest = max(self.fastest, math.hypot(message.u, message.v))
        self.truth = message

    def until(self, done):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end and not done():
            time.sleep(0.05)
        return done()

    def test_sails_there(self):
        self.assertTrue(self.until(lambda: self.truth and self.plan), "no plant or no plan")
        self.assertTrue(self.until(lambda: self.status.accepted_id == self.plan.id), self.status)
        goal = self.plan.pieces[0].x[0] + DISTANCE_M, self.plan.pieces[0].y[0]
        self.assertTrue(self.until(lambda: math.hypot(self.truth.x - goal[0], self.truth.y - goal[1]) < 1.0
                                   and math.hypot(self.truth.u, self.truth.v) < 0.2), self.truth)
        self.assertGreater(self.fastest, 0.9 * SPEED_MPS)
        if rospy.get_param("~refusals", False):
            self.assertLess(self.fastest, 1.05 * SPEED_MPS)
            self.refusals()

    # A trajectory that nothing can follow is refused with the reason, and the one in force stays.
    def refusals(self):
        publisher = rospy.Publisher("trajectory", Trajectory, queue_size=1, latch=True)
        for number, (spoil, words) in enumerate([(self.too_fast, "m/s"), (self.torn, "begin"),
                                                 (self.not_a_number, "finite")]):
            bad = copy.deepcopy(self.plan)
            bad.id = 100 + number
            bad.header.stamp = rospy.Time.now() + rospy.Duration(1.0)
            spoil(bad)
            publisher.publish(bad)
            self.assertTrue(self.until(lambda: self.status.refused_id == bad.id), self.status)
            self.assertIn(words, self.status.refused_reason)
            self.assertEqual(self.status.accepted_id, self.plan.id)

    @staticmethod
    def too_fast(plan):
        for piece in plan.pieces:
            start = piece.x[0]
            piece.x = [9.0 * c for c in piece.x]
            piece.x = [9.0 * start] + list(piece.x[1:])

    @staticmethod
    def torn(plan):
        plan.pieces[1].x = [plan.pieces[1].x[0] + 1.0] + list(plan.pieces[1].x[1:])

    @staticmethod
    def not_a_number(plan):
        plan.pieces[0].y = [math.nan] + list(plan.pieces[0].y[1:])


if __name__ == "__main__":
    rospy.init_node("interfaces_test")
    rostest.rosrun("otter_nav", "interfaces_test", Interfaces, sys.argv)
