"""Bags into arrays: what is read, and what is said of bags that cannot be."""
import os
import tempfile
import unittest

import numpy
import rosbag
import synthetic
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import String

from otter_nav.bag import read_bag
from otter_nav.errors import RecordingError
from otter_nav.tum import main as bag_to_tum


class BagTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.path = os.path.join(self.folder, "run.bag")

    def read(self, **options):
        synthetic.write_bag(self.path, **options)
        runs = read_bag(self.path)
        self.assertEqual(len(runs), 1)
        return runs[0]

    def refused(self, path, *words, **options):
        with self.assertRaises(RecordingError) as caught:
            read_bag(path, **options)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_columns_are_what_was_recorded(self):
        run = self.read()
        rows = round((synthetic.END_S - synthetic.START_S) / synthetic.STEP_S) + 1
        self.assertEqual(len(run.truth), rows)
        self.assertEqual(len(run.odometry), rows)
        self.assertEqual(len(run.commands), rows)
        self.assertAlmostEqual(run.truth.t[0], synthetic.START_S)
        x, y = synthetic.pose(run.truth.t[-1])
        self.assertAlmostEqual(run.truth.x[-1], x)
        self.assertAlmostEqual(run.odometry.y[-1], y)
        self.assertAlmostEqual(run.odometry.psi[0], synthetic.HEADING)
        self.assertEqual(run.commands.left[0], synthetic.LEFT_N)
        self.assertEqual(run.tracker.force_y[0], -4.0)
        self.assertEqual(run.wind.y[0], 3.0)
        self.assertEqual([t.id for t in run.trajectories], [1, 2])
        self.assertEqual([plan.planning_ms for plan in run.plans], [20.0, 40.0])
        self.assertEqual([state for _, state, _ in run.planner_states],
                         ["planning", "sailing", "arrived"])
        self.assertEqual(len(run.contacts), 1)

    def test_error_is_along_and_to_port(self):
        run = self.read()
        sailing = (run.error.t >= synthetic.SAILS_S) & (run.error.t <= synthetic.ARRIVES_S)
        numpy.testing.assert_allclose(run.error.along[sailing], synthetic.ALONG_M, atol=1e-6)
        numpy.testing.assert_allclose(run.error.cross[sailing], synthetic.CROSS_M, atol=1e-6)
        before = run.error.t < synthetic.SAILS_S - 1e-6
        self.assertTrue(numpy.all(numpy.isnan(run.error.distance[before])))
        self.assertTrue(numpy.all(run.reference.part[run.error.t > 109.01] == 1))

    def test_figures_are_of_the_window_from_first_trajectory_to_arrival(self):
        figures = self.read().figures()
        self.assertEqual(figures["outcome"], "arrived")
        self.assertAlmostEqual(figures["window_from_s"], synthetic.SAILS_S)
        self.assertAlmostEqual(figures["duration_s"], synthetic.ARRIVES_S - synthetic.SAILS_S, 6)
        self.assertAlmostEqual(figures["mission_duration_s"],
                               synthetic.ARRIVES_S - synthetic.START_S, 6)
        self.assertAlmostEqual(figures["tracking_error_mean_m"], 0.5, 6)
        self.assertAlmostEqual(figures["tracking_error_max_m"], 0.5, 6)
        rms = numpy.sqrt((synthetic.LEFT_N**2 + synthetic.RIGHT_N**2) / 2)
        self.assertAlmostEqual(figures["thrust_rms_n"], rms)
        self.assertEqual(figures["thrust_saturated_share"], 1.0)
        self.assertEqual(figures["replans"], 1)
        self.assertEqual(figures["planning_ms_max"], 40.0)
        # It comes after arrival and changes nothing.
        self.assertEqual(figures["contacts"], 1)
        self.assertAlmostEqual(figures["min_clearance_m"], 1.3, 2)

    def test_a_mission_ends_where_the_hull_touches_something(self):
        figures = self.read(contact=110.0).figures()
        self.assertEqual(figures["outcome"], "collided")
        self.assertAlmostEqual(figures["window_to_s"], 110.0)

    def test_any_namespace(self):
        run = self.read(prefix="/fleet/otter1")
        self.assertEqual(len(run.trajectories), 2)
        self.assertEqual(len(read_bag(self.path, namespace="fleet/otter1")), 1)
        self.refused(self.path, "no motion under '/other'", namespace="other")

    def test_two_vessels_need_a_choice(self):
        with rosbag.Bag(self.path, "w") as bag:
            for prefix in ("/a", "/b"):
                for name, message, _ in synthetic.messages():
                    bag.write(f"{prefix}/{name}", message, message.header.stamp)
        self.refused(self.path, "several vessels", "'/a'", "'/b'")
        self.assertEqual(len(read_bag(self.path, namespace="b")), 1)

    def test_time_set_back_splits_runs(self):
        synthetic.write_bag(self.path, runs=3)
        runs = read_bag(self.path)
        self.assertEqual(len(runs), 3)
        for run in runs:
            self.assertEqual(len(run.trajectories), 2)
            self.assertTrue(numpy.all(numpy.diff(run.truth.t) > 0.0))
            self.assertAlmostEqual(run.figures()["tracking_error_mean_m"], 0.5, 6)

    def test_stamps_set_back_split_runs_recorded_by_the_wall_clock(self):
        with rosbag.Bag(self.path, "w") as bag:
            for k in range(2):
                for name, message, t in synthetic.messages():
                    bag.write("/" + name, message, synthetic.stamp(1e9 + 100.0 * k + t))
        self.assertEqual(len(read_bag(self.path)), 2)

    def test_a_real_vessel_has_odometry_alone(self):
        run = self.read(truth=False, contact=None)
        self.assertFalse(run.motion_is_true)
        figures = run.figures()
        self.assertEqual(figures["position_source"], "odometry")
        self.assertAlmostEqual(figures["tracking_error_mean_m"], 0.5, 6)
        self.assertIsNone(figures["min_clearance_m"])

    def test_thrust_a_little_inside_its_limit_is_saturated(self):
        run = self.read()
        run.commands.left[:] = -49.9
        self.assertTrue(numpy.all(run.saturated))
        run.commands.left[:] = 49.0
        self.assertFalse(numpy.any(run.saturated))

    def test_chart_in_the_bag(self):
        synthetic.write_bag(self.path)
        grid = OccupancyGrid(data=[-1, 0, 100, 0, 0, 0])
        grid.info.width, grid.info.height, grid.info.resolution = 3, 2, 0.5
        grid.info.origin.position.x = -10.0
        with rosbag.Bag(self.path, "a") as bag:
            bag.write("/map", grid, synthetic.stamp(synthetic.END_S))
        chart = read_bag(self.path)[0].chart
        self.assertEqual(chart.occupied.tolist(), [[False, False, True], [False, False, False]])
        self.assertEqual(chart.extent, (-10.0, -8.5, 0.0, 1.0))

    def test_missing_empty_and_foreign_files(self):
        self.refused(os.path.join(self.folder, "none.bag"), "no such file")
        open(self.path, "w").close()
        self.refused(self.path, "empty")
        with open(self.path, "w") as file:
            file.write("t,x,y\n" * 1000)
        self.refused(self.path, "not a ROS bag")
        with rosbag.Bag(self.path, "w"):
            pass
        self.refused(self.path, "holds no messages")
        with rosbag.Bag(self.path, "w") as bag:
            bag.write("/chatter", String(data="hello"))
        self.refused(self.path, "neither otter_nav/PlantState nor nav_msgs/Odometry",
                     "/chatter (std_msgs/String)")

    def test_cut_off_bag_is_read_in_part_if_asked(self):
        with rosbag.Bag(self.path, "w", chunk_threshold=20000) as bag:
            for name, message, t in synthetic.messages():
                bag.write("/" + name, message, synthetic.stamp(t))
        size = os.path.getsize(self.path)
        with open(self.path, "r+b") as file:
            file.truncate(int(0.6 * size))
        self.refused(self.path, self.path)
        run = read_bag(self.path, partial=True)[0]
        self.assertGreater(len(run.truth), 100)
        self.assertLess(run.truth.t[-1], synthetic.END_S - 1.0)
        self.assertEqual(os.path.getsize(self.path), int(0.6 * size))

    def test_damaged_bag_is_named_and_read_up_to_there_if_asked(self):
        synthetic.write_bag(self.path)
        synthetic.damage(self.path)
        self.refused(self.path, f"{self.path}: damaged after 1", "--partial reads what is before")
        self.assertGreater(len(read_bag(self.path, partial=True)[0].truth), 100)

    def test_tum_files_are_what_evo_reads(self):
        synthetic.write_bag(self.path)
        out = os.path.join(self.folder, "tum")
        self.assertEqual(bag_to_tum(["--bag", self.path, "--out", out, "--window"]), 0)
        truth = numpy.loadtxt(os.path.join(out, "truth.tum"))
        reference = numpy.loadtxt(os.path.join(out, "reference.tum"))
        self.assertEqual(truth.shape[1], 8)
        numpy.testing.assert_allclose(truth[:, 0], reference[:, 0])
        gap = numpy.hypot(*(truth[:, 1:3] - reference[:, 1:3]).T)
        numpy.testing.assert_allclose(gap, 0.5, atol=1e-6)
        numpy.testing.assert_allclose(numpy.linalg.norm(truth[:, 4:], axis=1), 1.0)
        self.assertEqual(bag_to_tum(["--bag", self.path, "--out", out, "--run", "7"]), 1)


if __name__ == "__main__":
    unittest.main()
