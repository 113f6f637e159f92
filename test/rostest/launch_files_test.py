#!/usr/bin/python3
"""Every shipped launch file: sound for roslaunch-check, its arguments documented, its files there."""
import glob
import os
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import rospkg
import roslaunch.config
import roslaunch.rlutil
import rostest

PACKAGE = rospkg.RosPack().get_path("otter_nav")
LAUNCH_FILES = sorted(glob.glob(os.path.join(PACKAGE, "launch", "*.launch")))
# Arguments without a default need a value to be loaded with.
ARGUMENTS = {"collect.launch": ["bag:=/tmp/none.bag"], "record.launch": ["file:=/tmp/none.bag"],
             "replay.launch": ["bag:=/tmp/none.bag"]}


class LaunchFiles(unittest.TestCase):
    def test_there_are_some(self):
        names = {os.path.basename(path) for path in LAUNCH_FILES}
        self.assertLessEqual({"mission.launch", "sail.launch", "map.launch", "planning.launch", "tracking.launch",
                              "plant.launch", "rviz.launch", "record.launch", "replay.launch"}, names)

    def test_roslaunch_check(self):
        for path in LAUNCH_FILES:
            self.assertIsNone(roslaunch.rlutil.check_roslaunch(path, ignore_unset_args=True), path)

    def test_nodes_and_parameters_load(self):
        for path in LAUNCH_FILES:
            arguments = ARGUMENTS.get(os.path.basename(path), [])
            config = roslaunch.config.load_config_default([(path, arguments)], None)
            self.assertEqual(config.config_errors, [], path)
            self.assertTrue(config.nodes, path)

    def test_arguments_are_documented(self):
        for path in LAUNCH_FILES:
            for argument in ElementTree.parse(path).getroot().findall("arg"):
                self.assertTrue(argument.get("doc"), f"{path}: {argument.get('name')}")

    def test_a_mission_is_what_waits_for_goals_and_no_less(self):
        def started(name):
            path = os.path.join(PACKAGE, "launch", name)
            config = roslaunch.config.load_config_default([(path, [])], None)
            return {node.name: sorted(node.remap_args) for node in config.nodes}

        mission = started("mission.launch")
        del mission["mission_node"]
        self.assertEqual(started("sail.launch"), mission)
        self.assertIn("traffic_node", mission)

    def test_frames_and_parameter_folders_can_be_given(self):
        for path in LAUNCH_FILES:
            name = os.path.basename(path)
            names = {argument.get("name") for argument in ElementTree.parse(path).getroot().findall("arg")}
            # These two take the frames as they come.
            if name not in ("record.launch", "replay.launch"):
                self.assertIn("frames", names, path)
            with open(path, encoding="utf-8") as file:
                if ".yaml" in file.read():
                    self.assertIn("config", names, path)


if __name__ == "__main__":
    rostest.rosrun("otter_nav", "launch_files_test", LaunchFiles, sys.argv)
