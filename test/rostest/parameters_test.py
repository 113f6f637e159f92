#!/usr/bin/python3
"""Wrong parameters, charts and scenarios stop a node with a message that names the offender."""
import os
import subprocess
import sys
import tempfile
import unittest

import rospkg
import rostest
import yaml

PACKAGE = rospkg.RosPack().get_path("otter_nav")
CONFIG = os.path.join(PACKAGE, "config")
DATA = os.path.join(PACKAGE, "test", "rostest", "data")
PATIENCE_S = 60

# What launch/*.launch loads for each node: files below the node's namespace.
FILES = {
    "map_node": {"": "map_node", "map": "map"},
    "topology_node": {"": "topology_node", "topology": "topology"},
    "planner_node": {"": "planner_node", "planner": "planner", "topology": "topology",
                     "+": "mission"},
    "tracker_node": {"": "tracker_node", "tracker": "tracker"},
    "plant_node": {"": "plant_node", "plant": "plant"},
    "traffic_node": {"": "traffic_node", "traffic": "traffic"},
    "mission_node": {"": "mission_node"},
}


def parameters(node):
    values = {}
    for key, name in FILES[node].items():
        with open(os.path.join(CONFIG, name + ".yaml")) as file:
            content = yaml.safe_load(file)
        if key in ("", "+"):
            values.update(content)
        else:
            values[key] = content
    return values


class Parameters(unittest.TestCase):
    def outcome(self, node, values):
        """Output of the node started with the parameters under a name of its own."""
        name = f"{node}_{self._testMethodName}"
        with tempfile.NamedTemporaryFile("w", suffix=".launch") as launch:
            launch.write(f'<launch><node pkg="otter_nav" type="{node}" name="{name}" '
                         'output="screen" required="true"><rosparam>\n'
                         f"{yaml.safe_dump(values)}</rosparam></node></launch>")
            launch.flush()
            return self.launched(launch.name)

    def launched(self, path):
        run = subprocess.run(["roslaunch", path], timeout=PATIENCE_S, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        return run.stdout

    def assert_refused(self, node, change, *words):
        values = parameters(node)
        change(values)
        output = self.outcome(node, values)
        self.assertIn("exit code 1", output)
        for word in words:
            self.assertIn(word, output)

    def test_unknown_parameter(self):
        for node in FILES:
            self.assert_refused(node, lambda v: v.update(sped=1.0), "unknown parameter 'sped'")

    def test_missing_parameter(self):
        self.assert_refused("tracker_node", lambda v: v.pop("speed"), "'speed' is missing")

    def test_parameter_out_of_range(self):
        self.assert_refused("plant_node", lambda v: v.update(control_period_s=5.0),
                            "'control_period_s'", "allowed range [0.001, 0.1]")
        self.assert_refused("planner_node", lambda v: v["planner"].update(sigma=-1.0),
                            "planner", "'sigma'", "allowed range")

    def test_parameter_of_wrong_type(self):
        self.assert_refused("planner_node", lambda v: v.update(seed="some"), "'seed'")

    def test_speed_zero_without_lockstep(self):
        self.assert_refused("plant_node", lambda v: v.update(speed=0.0, lockstep=False), "'speed'")

    def test_chart_that_is_not_there(self):
        self.assert_refused("map_node", lambda v: v.update(chart="/nowhere/chart.yaml"),
                            "/nowhere/chart.yaml")

    def test_neither_chart_nor_scenario(self):
        self.assert_refused("map_node", lambda v: None, "'chart'", "'scenario'")

    def test_scenario_without_that_mission(self):
        scenario = os.path.join(DATA, "pond.yaml")
        self.assert_refused("plant_node", lambda v: v.update(scenario=scenario, mission=7),
                            "mission", "7")

    def test_result_that_is_its_own_track(self):
        scenario = os.path.join(DATA, "pond.yaml")
        self.assert_refused("mission_node", lambda v: v.update(scenario=scenario, result="/tmp/a.csv"),
                            "'result'", "/tmp/a.csv")

    def test_topic_that_is_none(self):
        output = self.outcome("recorder_node", {"file": "/tmp/otter_nav_never.bag", "topics": ["odom,scan"],
                                                "paced": []})
        self.assertIn("'odom,scan'", output)
        self.assertNotIn("InvalidName", output)

    def test_frames_of_the_same_name(self):
        with tempfile.NamedTemporaryFile("w", suffix=".launch") as launch:
            launch.write('<launch><group ns="crowded"><rosparam param="frames">'
                         "{map: a, odom: world_odom, base: a}</rosparam>"
                         '<node pkg="otter_nav" type="topology_node" name="topology_node" '
                         'output="screen" required="true"/></group></launch>')
            launch.flush()
            output = self.launched(launch.name)
        self.assertIn("exit code 1", output)
        self.assertIn("'/crowded/frames': base and map are both 'a'", output)

    def test_unknown_vessel_and_disturbance(self):
        self.assert_refused("tracker_node", lambda v: v.update(vessel="raft"), "raft")
        self.assert_refused("plant_node", lambda v: v.update(disturbance="flood"), "flood")


if __name__ == "__main__":
    rostest.rosrun("otter_nav", "parameters_test", Parameters, sys.argv)
