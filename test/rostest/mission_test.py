#!/usr/bin/python3
"""Whole missions through mission.launch: arrival, the same run twice, and nothing left behind."""
import csv
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import rosbag
import rospkg
import rostest

PACKAGE = rospkg.RosPack().get_path("otter_nav")
POND = os.path.join(PACKAGE, "test", "rostest", "data", "pond.yaml")
# By its path: beside an installed package of the same name, the name alone means two files.
LAUNCH = os.path.join(PACKAGE, "launch", "mission.launch")
NODES = ("map_node", "topology_node", "planner_node", "tracker_node", "plant_node", "mission_node")
PATIENCE_S = 240


def free_port():
    with socket.socket() as listener:
        listener.bind(("", 0))
        return listener.getsockname()[1]


def processes_of(port):
    """Processes with the ROS master of this port in their environment, the launch's own too."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/environ", "rb") as environment:
                variables = environment.read().decode(errors="replace").split("\0")
        except OSError:
            continue
        master = next((v for v in variables if v.startswith("ROS_MASTER_URI=")), "")
        if master.rstrip("/").endswith(f":{port}"):
            found.append(int(pid))
    return found


def wait_until(done, patience_s):
    end = time.monotonic() + patience_s
    while time.monotonic() < end:
        if done():
            return True
        time.sleep(0.1)
    return done()


def frames_in(message):
    """Of a message's headers, whatever is inside, and of transforms the children."""
    for slot in getattr(message, "__slots__", ()):
        value = getattr(message, slot)
        if slot in ("frame_id", "child_frame_id"):
            yield value
        elif isinstance(value, list):
            for entry in value[:5]:
                yield from frames_in(entry)
        else:
            yield from frames_in(value)


class Mission(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def start(self, **arguments):
        port = free_port()
        launch = subprocess.Popen(
            ["roslaunch", "-p", str(port), LAUNCH]
            + [f"{key}:={value}" for key, value in arguments.items()],
            env={**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}"}, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, start_new_session=True)
        self.addCleanup(self.kill, launch, port)
        return launch, port

    @staticmethod
    def kill(launch, port):
        """What a failed test left; roslaunch starts its nodes in sessions of their own."""
        if launch.poll() is None:
            os.killpg(launch.pid, signal.SIGKILL)
            launch.wait()
        for pid in processes_of(port):
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                continue

    def sail(self, name, **arguments):
        """The result of a mission, its track, and that nothing runs on after it."""
        result = os.path.join(self.folder.name, name + ".json")
        launch, port = self.start(result=result, speed=0, **arguments)
        output, _ = launch.communicate(timeout=PATIENCE_S)
        self.assertTrue(os.path.exists(result), output)
        self.assertTrue(wait_until(lambda: not processes_of(port), 20), processes_of(port))
        with open(result) as file:
            mission = json.load(file)["missions"][0]
        with open(mission["track"]) as file:
            track = list(csv.DictReader(file))
        return mission, track, output

    def test_arrives_and_is_the_same_twice(self):
        first, track, output = self.sail("first", scenario=POND)
        self.assertEqual(first["outcome"], "arrived", output)
        self.assertGreater(first["min_clearance_m"], 0.0)
        self.assertGreater(first["distance_m"], 44.0)
        self.assertAlmostEqual(float(track[0]["x"]), -22.0, delta=0.1)
        self.assertLess(abs(float(track[-1]["x"]) - 22.0), 1.0)
        self.assertLess(abs(float(track[-1]["y"]) - 8.0), 1.0)

        second, again, _ = self.sail("second", scenario=POND)
        for key in ("outcome", "duration_s", "distance_m", "min_clearance_m",
                    "tracking_error_mean_m", "tracking_error_max_m", "replans",
                    "replans_for_weather"):
            self.assertEqual(first[key], second[key], key)
        self.assertEqual(track, again)

    def test_frames_by_other_names(self):
        """`frames` names them for every node: none is called as shipped any more."""
        names = {"map": "world", "odom": "world_odom", "base": "otter1/hull", "lidar": "otter1/eye"}
        bag = os.path.join(self.folder.name, "renamed.bag")
        mission, _, output = self.sail("renamed", scenario=POND, frames=json.dumps(names), record=bag)
        self.assertEqual(mission["outcome"], "arrived", output)
        seen, typed = set(), {}
        with rosbag.Bag(bag) as recorded:
            for topic, message, _ in recorded.read_messages():
                found = set(frames_in(message)) - {""}
                typed.setdefault(topic, set()).update(found)
                seen |= found
        self.assertEqual(seen, set(names.values()), {t: f for t, f in typed.items() if f - set(names.values())})
        self.assertEqual(typed["/tf"], {"world_odom", "otter1/hull"})

    def test_killed_launch_leaves_no_process(self):
        launch, port = self.start(scenario=POND, speed=0.2)
        self.assertTrue(wait_until(lambda: self.running(port) == set(NODES), 60), self.running(port))
        launch.send_signal(signal.SIGINT)
        launch.communicate(timeout=60)
        self.assertTrue(wait_until(lambda: not processes_of(port), 20), processes_of(port))

    def test_another_goal_ends_the_mission_but_not_the_launch(self):
        result = os.path.join(self.folder.name, "replaced.json")
        launch, port = self.start(scenario=POND, result=result, speed=0.3)
        environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}"}
        self.assertTrue(wait_until(lambda: self.running(port) == set(NODES), 60), self.running(port))
        subprocess.run(["rostopic", "echo", "-n", "1", "/trajectory/id"], env=environment, timeout=60,
                       check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["rostopic", "pub", "-1", "/move_base_simple/goal", "geometry_msgs/PoseStamped",
                        "{header: {frame_id: map}, pose: {position: {x: -2, y: -8},"
                        " orientation: {w: 1}}}"],
                       env=environment, timeout=60, check=True, stdout=subprocess.DEVNULL)
        self.assertTrue(wait_until(lambda: os.path.exists(result), 30))
        with open(result) as file:
            mission = json.load(file)["missions"][0]
        self.assertEqual(mission["outcome"], "stopped")
        self.assertIn("another goal was sent", mission["reason"])
        time.sleep(3.0)
        self.assertIsNone(launch.poll())
        self.assertEqual(self.running(port), set(NODES))
        launch.send_signal(signal.SIGINT)
        output, _ = launch.communicate(timeout=60)
        self.assertIn("the vessel sails on", output)

    @staticmethod
    def running(port):
        names = set()
        for pid in processes_of(port):
            try:
                names.add(os.path.basename(os.readlink(f"/proc/{pid}/exe")))
            except OSError:
                continue
        return names & set(NODES)


if __name__ == "__main__":
    rostest.rosrun("otter_nav", "mission_test", Mission, sys.argv)
