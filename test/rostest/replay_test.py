#!/usr/bin/python3
"""Missions are recorded whole, and the tracker makes the same commands of what was recorded."""
import csv
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import unittest

import rosbag
import rospkg
import rostest
import yaml

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from mission_test import POND, Mission, free_port, processes_of, wait_until  # noqa: E402

PACKAGE = rospkg.RosPack().get_path("otter_nav")
SAME_N = 1e-9
COLUMNS = ["t", "left_recorded_n", "right_recorded_n", "left_recomputed_n", "right_recomputed_n"]

REWEIGH = """
import dynamic_reconfigure.client, rospy
rospy.init_node("reweigh")
dynamic_reconfigure.client.Client("/tracker_node", timeout=30).update_configuration({"position": 20.0})
"""

# Prints how many messages came on each topic, and the topics that are published.
WATCH = """
import json, rosgraph, rospy, sys, time
rospy.init_node("watch", disable_signals=True)
seen, end = {}, time.time() + 90.0
def took(topic):
    return lambda message: seen.__setitem__(topic, seen.get(topic, 0) + 1)
for topic in sys.argv[1:]:
    rospy.Subscriber(topic, rospy.AnyMsg, took(topic))
while time.time() < end and any(topic not in seen for topic in sys.argv[1:]):
    time.sleep(0.1)
print(json.dumps([seen, [topic for topic, _ in rosgraph.Master("/watch").getSystemState()[0]]]))
"""


class Replay(unittest.TestCase):
    start = Mission.start
    kill = staticmethod(Mission.kill)

    def setUp(self):
        Mission.setUp(self)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def record(self, name, under_way=None, **arguments):
        bag = self.path(name)
        launch, port = self.start(scenario=POND, record=bag, result=bag + ".json", **arguments)
        if under_way:
            under_way({**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}"})
        output, _ = launch.communicate(timeout=300)
        self.assertTrue(os.path.exists(bag), output)
        self.assertTrue(wait_until(lambda: not processes_of(port), 20), processes_of(port))
        with open(bag + ".json") as file:
            self.assertEqual(json.load(file)["missions"][0]["outcome"], "arrived", output)
        return bag

    def replay(self, bag, *options):
        out = self.path("out")
        done = subprocess.run(["rosrun", "otter_nav", "replay_tracker", "--bag", bag, "--out", out,
                               *options], capture_output=True, text=True, timeout=120)
        if done.returncode != 0:
            return done, None, None
        with open(os.path.join(out, "replay.json")) as file:
            figures = json.load(file)
        with open(os.path.join(out, "replay.csv")) as file:
            rows = list(csv.DictReader(file))
        return done, figures, rows

    def assert_whole(self, bag, period_s):
        """Every stamp of the odometry is there, and what a replay needs beside it."""
        with rosbag.Bag(bag) as recorded:
            stamps = {}
            for topic in ("/odom", "/tracker_cycle", "/thruster_command"):
                seen = {m.header.stamp.to_sec() for _, m, _ in recorded.read_messages(topics=[topic])}
                stamps[topic] = sorted(seen - {0.0})
                gaps = [b - a for a, b in zip(stamps[topic], stamps[topic][1:])
                        if b - a > 1.5 * period_s]
                self.assertEqual(gaps, [], topic)
            topics = set(recorded.get_type_and_topic_info().topics)
            lost = [m.data for _, m, _ in recorded.read_messages(topics=["/recording_gaps"])]
        self.assertEqual(lost, [])
        self.assertGreater(len(stamps["/odom"]), 1000)
        for topic in ("/chart", "/map", "/map_updates", "/tf", "/tf_static", "/trail", "/trajectory",
                      "/near_obstacles",
                      "/trajectory_markers", "/tree_markers", "/guide_path_markers", "/vessel",
                      "/tracker_node/parameters", "/planner_status", "/plant_state", "/scan"):
            self.assertIn(topic, topics)

    def assert_same(self, bag):
        done, figures, rows = self.replay(bag)
        self.assertIsNotNone(figures, done.stderr)
        self.assertLess(figures["difference_max_n"], SAME_N, done.stdout)
        self.assertEqual(list(rows[0])[:5], COLUMNS)
        self.assertGreater(max(abs(float(row["left_recorded_n"])) for row in rows), 10.0)
        worst = max(abs(float(row[f"{side}_recorded_n"]) - float(row[f"{side}_recomputed_n"]))
                    for row in rows for side in ("left", "right"))
        self.assertLess(worst, SAME_N)
        with rosbag.Bag(bag) as recorded:
            commands = {m.header.stamp.to_nsec(): (m.left, m.right) for _, m, _ in
                        recorded.read_messages(topics=["/thruster_command"])}
        matched = 0
        for row in rows:
            told = commands.get(round(float(row["t"]) * 1e9))
            if told is not None:
                matched += 1
                self.assertLess(abs(told[0] - float(row["left_recomputed_n"])), SAME_N)
                self.assertLess(abs(told[1] - float(row["right_recomputed_n"])), SAME_N)
        self.assertGreater(matched, 0.9 * len(rows))
        return rows

    def assert_near_obstacles_count(self, bag):
        """The steps take what was near by the recording: with something else they command otherwise."""
        other, without = self.path("other.bag"), self.path("without.bag")
        hull = (0.0, 0.0, 0.0)
        with rosbag.Bag(bag) as source, rosbag.Bag(other, "w") as moved, \
                rosbag.Bag(without, "w") as cut:
            for topic, message, t, header in source.read_messages(return_connection_header=True):
                if topic == "/odom":
                    pose = message.pose.pose
                    hull = (pose.position.x, pose.position.y,
                            2.0 * math.atan2(pose.orientation.z, pose.orientation.w))
                elif topic == "/near_obstacles":  # a wall at either side of the hull
                    x, y, psi = hull
                    wall = [(0.25 * k, side) for k in range(-4, 30) for side in (0.6, -0.6)]
                    message.x = [x + a * math.cos(psi) - b * math.sin(psi) for a, b in wall]
                    message.y = [y + a * math.sin(psi) + b * math.cos(psi) for a, b in wall]
                if topic != "/near_obstacles":
                    cut.write(topic, message, t, connection_header=header)
                moved.write(topic, message, t, connection_header=header)
        done, figures, _ = self.replay(other)
        self.assertIsNotNone(figures, done.stderr)
        self.assertGreater(figures["difference_max_n"], 0.01, done.stdout)
        done, _, _ = self.replay(without)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("near obstacles", done.stderr)

    def test_lockstep(self):
        bag = self.record("lockstep.bag", speed=0)
        self.assert_whole(bag, 0.01)
        rows = self.assert_same(bag)
        self.assert_report(bag)
        self.assert_near_obstacles_count(bag)

        done, figures, part = self.replay(bag, "--from", rows[500]["t"], "--to", rows[600]["t"])
        self.assertEqual(len(part), 101, done.stderr)
        self.assertEqual(part[0], rows[500])

        done, figures, _ = self.replay(bag, "--set", "tracker.horizon_s=3")
        self.assertGreater(figures["difference_max_n"], 0.01, done.stdout)
        self.assertIn("options changed", done.stdout)

        for wrong in ("tracker.horizn_s=3", "tracker.horizon_s=300", "horizon_s=3"):
            done, _, _ = self.replay(bag, "--set", wrong)
            self.assertNotEqual(done.returncode, 0, wrong)
            self.assertIn("horiz", done.stderr)

        done, figures, _ = self.replay(bag, "--closed-loop", "--try", "tracker.flatness.position=1")
        self.assertIsNotNone(figures, done.stderr)
        self.assertIn("Simulated, not what the vessel did", done.stdout)
        first, other = figures["settings"]
        self.assertLess(first["tracking_error_mean_m"], 0.3, done.stdout)
        self.assertGreater(other["tracking_error_mean_m"], first["tracking_error_mean_m"])

        self.damaged(bag)
        self.plays(bag)

    def assert_report(self, bag):
        """The report's figures, and the mission's own, are what the messages say."""
        out = self.path("report.html")
        subprocess.run([sys.executable, os.path.join(PACKAGE, "python", "programs", "report"), "--bag", bag,
                        "--out", out], check=True, timeout=120, stdout=subprocess.DEVNULL)
        with open(self.path("report.json")) as file:
            report = json.load(file)
        with open(bag + ".json") as file:
            mission = json.load(file)["missions"][0]
        states, orders, commands, arrived = [], [], {}, None
        with rosbag.Bag(bag) as recorded:
            for topic, m, _ in recorded.read_messages(
                    topics=["/plant_state", "/trajectory", "/thruster_command", "/planner_status"]):
                t = m.header.stamp.to_sec()
                if topic == "/plant_state":
                    states.append((t, m.x, m.y))
                elif topic == "/trajectory":
                    orders.append((t, m))
                elif topic == "/thruster_command":
                    commands[t] = (m.left**2 + m.right**2) / 2
                elif m.state == "arrived":
                    arrived = min(t, arrived or t)
        begin = min(t for t, order in orders if order.pieces)
        places = [((x, y), self.place(orders, t)) for t, x, y in sorted(set(states))
                  if begin - 1e-6 <= t <= arrived + 1e-6]
        errors = [math.dist(true, place) for true, place in places if place]
        squares = [n for t, n in commands.items() if begin - 1e-6 <= t <= arrived + 1e-6]
        for key, value in (("tracking_error_mean_m", sum(errors) / len(errors)),
                           ("tracking_error_max_m", max(errors)), ("duration_s", arrived - begin),
                           ("thrust_rms_n", math.sqrt(sum(squares) / len(squares)))):
            self.assertAlmostEqual(report[key], value, delta=0.005 * value, msg=key)
            if key.startswith("tracking"):
                self.assertAlmostEqual(mission[key], value, delta=0.005 * value, msg=key)

    @staticmethod
    def place(orders, t):
        """Where the last trajectory that has begun is at t; None while one is an order to stop."""
        start, order = max(((s, o) for s, o in orders if s <= t + 1e-9), key=lambda one: (one[0], one[1].id))
        if not order.pieces:
            return None
        left = min(t - start, sum(piece.duration for piece in order.pieces))
        for piece in order.pieces[:-1]:
            if left <= piece.duration:
                break
            left -= piece.duration
        else:
            piece = order.pieces[-1]
        left = min(max(left, 0.0), piece.duration)
        return [sum(c * left**k for k, c in enumerate(axis)) for axis in (piece.x, piece.y)]

    def plays(self, bag):
        """Everything rviz shows is there, also from the middle; nothing is commanded."""
        port = free_port()
        environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}"}
        launch = subprocess.Popen(
            ["roslaunch", "-p", str(port), os.path.join(PACKAGE, "launch", "replay.launch"),
             f"bag:={bag}", "rviz:=false", "rate:=0.5", "start:=8"], env=environment,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)
        self.addCleanup(self.kill, launch, port)
        shown = ["/clock", "/tf", "/tf_static", "/chart", "/map", "/map_updates", "/scan", "/trail",
                 "/guide_path_markers", "/tree_markers", "/trajectory_markers", "/predicted_path",
                 "/replayed/thruster_command", "/planner_status", "/tracker_status", "/vessel", "/odom",
                 "/track_markers", "/wind"]
        watch = subprocess.run([sys.executable, "-c", WATCH, *shown], env=environment, timeout=120,
                               capture_output=True, text=True)
        launch.send_signal(signal.SIGINT)
        output, _ = launch.communicate(timeout=60)
        self.assertEqual(watch.returncode, 0, watch.stderr)
        seen, published = json.loads(watch.stdout.splitlines()[-1])
        self.assertEqual(sorted(seen), sorted(shown), output)
        for order in ("/thruster_command", "/trajectory"):
            self.assertNotIn(order, published)

    def until(self, name, bag, **ends):
        """What was sent by then, of the topics named."""
        path = self.path(name)
        with rosbag.Bag(bag) as source, rosbag.Bag(path, "w") as target:
            for topic, message, t, header in source.read_messages(return_connection_header=True):
                end = ends.get(topic[1:], math.inf)
                if not message._has_header or message.header.stamp.to_sec() <= end:
                    target.write(topic, message, t, connection_header=header)
        return path

    def damaged(self, bag):
        with open(bag, "rb") as file:
            whole = file.read()
        cut = self.path("cut.bag")
        with open(cut, "wb") as file:
            file.write(whole[:len(whole) * 2 // 3])
        done, _, _ = self.replay(cut)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("cut off", done.stderr)
        done, figures, rows = self.replay(cut, "--partial")
        self.assertIsNotNone(figures, done.stderr)
        self.assertGreater(len(rows), 500)
        self.assertLess(figures["difference_max_n"], SAME_N)
        self.assertIn("cut off", done.stdout)

        # The recorder had the last two steps before the odometry that they were made with.
        early = self.until("early.bag", bag, odom=5.004, tracker_cycle=5.024)
        done, figures, rows = self.replay(early)
        self.assertIn("the last 2 steps are left out", done.stdout, done.stderr)
        self.assertLess(figures["difference_max_n"], SAME_N)
        with open(early, "rb+") as file:
            file.truncate(os.path.getsize(early) - 1000)
        done, figures, rows = self.replay(early, "--partial")
        self.assertIn("the last 2 steps are left out", done.stdout)
        self.assertLess(figures["difference_max_n"], SAME_N)
        # Odometry that ends seconds before the steps do is a hole.
        done, _, _ = self.replay(self.until("blind.bag", bag, odom=5.004, tracker_cycle=7.0))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("at 5.010 s", done.stderr)

        hole = self.path("hole.bag")
        with rosbag.Bag(bag) as source, rosbag.Bag(hole, "w") as target:
            for topic, message, t, header in source.read_messages(return_connection_header=True):
                if topic == "/odom" and abs(message.header.stamp.to_sec() - 5.0) < 0.004:
                    continue
                target.write(topic, message, t, connection_header=header)
        done, _, _ = self.replay(hole)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("at 5.000 s", done.stderr)
        done, figures, _ = self.replay(hole, "--partial")
        self.assertIn("1 holes", done.stdout)

    def test_real_time(self):
        """The weights changed under way as well: the steps after that are made with the new ones."""
        bag = self.record("free.bag", self.reweigh, speed=1, lockstep="false")
        self.assert_whole_in_real_time(bag)
        self.assert_same(bag)
        with rosbag.Bag(bag) as recorded:
            told = [yaml.safe_load(m.data)["tracker"]["flatness"]["position"] for _, m, _ in
                    recorded.read_messages(topics=["/tracker_node/parameters"])]
            used = [m.weights[0] for _, m, _ in recorded.read_messages(topics=["/tracker_cycle"])
                    if m.cycle > 0]
        self.assertEqual(told, [100.0, 20.0])
        self.assertEqual((used[0], used[-1]), (100.0, 20.0))
        done, figures, rows = self.replay(bag, "--set", "tracker.flatness.position=100")
        self.assertGreater(figures["difference_max_n"], 0.01, done.stdout)
        first = next(row["t"] for row, weight in zip(rows, used) if weight != 100.0)
        done, figures, _ = self.replay(bag, "--set", "tracker.flatness.position=100", "--to",
                                       str(float(first) - 0.02))
        self.assertLess(figures["difference_max_n"], SAME_N, done.stdout)

    @staticmethod
    def reweigh(environment):
        wait_until(lambda: subprocess.run(["rostopic", "echo", "-n", "1", "/trajectory/id"], env=environment,
                                          timeout=60, capture_output=True).returncode == 0, 60)
        subprocess.run([sys.executable, "-c", REWEIGH], env=environment, timeout=60, check=True)

    def assert_whole_in_real_time(self, bag):
        with rosbag.Bag(bag) as recorded:
            cycles = [m.cycle for _, m, _ in recorded.read_messages(topics=["/tracker_cycle"])]
        self.assertEqual(sorted(set(cycles)), list(range(max(cycles) + 1)))

    def test_interrupted_launch_leaves_a_whole_bag(self):
        bag = self.path("interrupted.bag")
        launch, _ = self.start(scenario=POND, record=bag, speed=1)
        self.assertTrue(wait_until(lambda: self.size(bag) > 400000, 60), self.size(bag))
        launch.send_signal(signal.SIGINT)
        output, _ = launch.communicate(timeout=60)
        self.assertTrue(os.path.exists(bag), output)
        self.assertFalse(os.path.exists(bag + ".active"))
        self.assert_same(bag)

    def test_recorder_ends_while_the_vessel_sails_on(self):
        bag = self.path("beside.bag")
        _, port = self.start(scenario=POND, speed=0.5, lockstep="false")
        self.assertTrue(wait_until(lambda: "plant_node" in Mission.running(port), 60))
        recorder = subprocess.Popen(
            ["roslaunch", "-p", str(port), os.path.join(PACKAGE, "launch", "record.launch"), f"file:={bag}"],
            env={**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}"}, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        self.addCleanup(self.kill, recorder, port)
        self.assertTrue(wait_until(lambda: self.size(bag) > 250000, 60), self.size(bag))
        recorder.send_signal(signal.SIGINT)
        output, _ = recorder.communicate(timeout=60)
        self.assertTrue(os.path.exists(bag), output)
        self.assertFalse(os.path.exists(bag + ".active"))
        with rosbag.Bag(bag) as recorded:
            self.assertGreater(recorded.get_message_count("/odom"), 100)

    @staticmethod
    def size(bag):
        return os.path.getsize(bag + ".active") if os.path.exists(bag + ".active") else 0

    def test_says_what_is_no_recording(self):
        empty = self.path("empty.bag")
        open(empty, "w").close()
        text = self.path("text.bag")
        with open(text, "w") as file:
            file.write("not a bag\n")
        foreign = self.path("foreign.bag")
        from std_msgs.msg import String
        with rosbag.Bag(foreign, "w") as bag:
            bag.write("/chatter", String(data="hello"))
        nothing = self.path("nothing.bag")
        rosbag.Bag(nothing, "w").close()
        for bag, why in ((empty, "is empty"), (text, "is not a ROS bag"), (foreign, "/chatter"),
                         (nothing, "no messages"), (self.path("none.bag"), "no such file")):
            done, _, _ = self.replay(bag)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(why, done.stderr)
            self.assertIn(bag, done.stderr)


if __name__ == "__main__":
    rostest.rosrun("otter_nav", "replay_test", Replay, sys.argv)
