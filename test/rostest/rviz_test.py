#!/usr/bin/python3
"""rviz itself with the shipped configuration, in a virtual screen and fed by topics: the chart's colours,
the heads-up display and the panel are to be seen. OTTER_NAV_RVIZ_PICTURE keeps the screenshot."""
import math
import os
import subprocess
import sys
import time
import unittest

import numpy
import rospkg
import rospy
import rostest
import tf2_msgs.msg
from geometry_msgs.msg import TransformStamped, Vector3Stamped
from map_msgs.msg import OccupancyGridUpdate
from nav_msgs.msg import OccupancyGrid, Odometry
from otter_nav.msg import PlannerStatus, ThrusterCommand, TrackerStatus
from PIL import ImageGrab
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String

PACKAGE = rospkg.RosPack().get_path("otter_nav")
PATIENCE_S = 150.0
CELLS = 240  # a side, of 0.25 m
# src/rviz/nautical_palette.hpp and look.hpp.
COLOURS = {"land": (0xd8, 0xc4, 0x8a), "charted": (0xa9, 0xcb, 0xe0), "seen": (0xe6, 0xf3, 0xf8),
           "sensed": (0xd0, 0x34, 0x2c), "port": (226, 86, 66), "sailing": (25, 118, 192)}


def grid():
    message = OccupancyGrid()
    message.header.frame_id = "map"
    message.info.resolution = 0.25
    message.info.width = message.info.height = CELLS
    message.info.origin.position.x = message.info.origin.position.y = -30.0
    message.info.origin.orientation.w = 1.0
    cells = numpy.zeros((CELLS, CELLS), dtype=numpy.int8)
    cells[150:200, 150:200] = 100
    message.data = cells.ravel().tolist()
    return message


class Screen:
    """A virtual screen of its own number."""

    def __enter__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "+extension", "GLX",
             "-nolisten", "tcp"], pass_fds=[write], stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as numbers:
            self.name = ":" + numbers.readline().strip()
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


def count(image, colour, slack=12):
    near = numpy.abs(image.astype(int) - numpy.array(colour)).max(axis=2) <= slack
    return int(near.sum())


class Rviz(unittest.TestCase):
    def setUp(self):
        latched = {"queue_size": 1, "latch": True}
        self.chart = rospy.Publisher("chart", OccupancyGrid, **latched)
        self.map = rospy.Publisher("map", OccupancyGrid, **latched)
        self.updates = rospy.Publisher("map_updates", OccupancyGridUpdate, **latched)
        self.vessel = rospy.Publisher("vessel", String, **latched)
        self.often = {name: rospy.Publisher(name, kind, queue_size=10) for name, kind in (
            ("/tf", tf2_msgs.msg.TFMessage), ("scan", LaserScan), ("odom", Odometry),
            ("planner_status", PlannerStatus), ("tracker_status", TrackerStatus),
            ("thruster_command", ThrusterCommand), ("wind", Vector3Stamped))}

    def publish_state(self):
        now = rospy.Time.now()
        transforms = []
        for parent, child in (("map", "odom"), ("odom", "base_link"), ("base_link", "lidar")):
            transform = TransformStamped()
            transform.header.frame_id, transform.header.stamp = parent, now
            transform.child_frame_id = child
            transform.transform.rotation.w = 1.0
            transforms.append(transform)
        scan = LaserScan(angle_min=-math.pi, angle_increment=math.pi / 180, range_min=0.1,
                         range_max=9.0, ranges=[math.inf] * 361)
        scan.header.frame_id, scan.header.stamp = "lidar", now
        odometry = Odometry()
        odometry.header.frame_id, odometry.child_frame_id = "odom", "base_link"
        odometry.pose.pose.orientation.w = 1.0
        odometry.twist.twist.linear.x = 2.5
        planner = PlannerStatus(state="sailing", plans=3, length=41.0, duration=17.0, clearance=1.6)
        tracker = TrackerStatus(state="tracking", position_error=0.08, time_left=65.0)
        tracker.header.stamp = now
        command = ThrusterCommand(left=50.0, right=30.0)
        command.header.stamp = now
        wind = Vector3Stamped()
        wind.vector.y = 6.0
        for name, message in (("/tf", tf2_msgs.msg.TFMessage(transforms)), ("scan", scan),
                              ("odom", odometry), ("planner_status", planner),
                              ("tracker_status", tracker), ("thruster_command", command),
                              ("wind", wind)):
            self.often[name].publish(message)

    def seen(self, screen):
        image = numpy.asarray(ImageGrab.grab(xdisplay=screen.name).convert("RGB"))
        return {name: count(image, colour) for name, colour in COLOURS.items()}

    def test_the_picture(self):
        self.chart.publish(grid())
        self.map.publish(grid())
        with open(os.path.join(PACKAGE, "config", "vessels", "otter_gazebo.yaml")) as file:
            self.vessel.publish(file.read())
        # Sent again and again: the first may come before the map that it changes.
        self.update = OccupancyGridUpdate(x=140, y=112, width=8, height=16, data=[100] * 128)
        self.update.header.frame_id = "map"
        environment = dict(os.environ, LIBGL_ALWAYS_SOFTWARE="1")
        environment.pop("QT_QPA_PLATFORM", None)
        with Screen() as screen:
            environment["DISPLAY"] = screen.name
            rviz = subprocess.Popen(
                ["rviz", "-d", os.path.join(PACKAGE, "rviz", "mission.rviz")],
                env=environment)
            try:
                self.watch(screen, rviz)
            finally:
                rviz.terminate()
                rviz.wait()

    def watch(self, screen, rviz):
        wanted = {"land": 1500, "charted": 20000, "seen": 20000, "sensed": 200, "port": 800,
                  "sailing": 1500}
        end = time.monotonic() + PATIENCE_S
        seen = {}
        while time.monotonic() < end:
            self.assertIsNone(rviz.poll(), "rviz ended")
            self.updates.publish(self.update)
            for _ in range(10):
                self.publish_state()
                time.sleep(0.05)
            seen = self.seen(screen)
            if all(seen[name] >= least for name, least in wanted.items()):
                break
        if os.environ.get("OTTER_NAV_RVIZ_PICTURE"):
            ImageGrab.grab(xdisplay=screen.name).save(os.environ["OTTER_NAV_RVIZ_PICTURE"])
        for name, least in wanted.items():
            self.assertGreaterEqual(seen[name], least, f"{name}: {seen}")


if __name__ == "__main__":
    rospy.init_node("rviz_test")
    rostest.rosrun("otter_nav", "rviz_test", Rviz, sys.argv)
