"""Times from a scan to the command that answers it."""
import contextlib
import io
import json
import os
import tempfile
import unittest
from types import SimpleNamespace

import synthetic

from otter_nav.latency import conflicts
from otter_nav.latency import main as latency


def said(name, stamp, when=None, **fields):
    header = SimpleNamespace(stamp=SimpleNamespace(to_sec=lambda: stamp))
    return name, SimpleNamespace(header=header, **fields), when or stamp


def status(stamp, state, plans, reason="", planning_ms=20.0):
    return said("planner_status", stamp, state=state, reason=reason, plans=plans,
                planning_ms=planning_ms)


class LatencyTest(unittest.TestCase):
    NEAR = "only 0.03 m clear at (1.0 m, 2.0 m) on the way"

    def test_a_plan_a_stop_and_a_way_among_others(self):
        found, wall_ms = conflicts([
            status(0.9, "sailing", 1),
            said("map_updates", 0.93), status(1.02, "replanning", 1, self.NEAR),
            said("map_updates", 1.0, 1.01),
            said("map_updates", 1.07), status(1.08, "replanning", 2, self.NEAR, 5.0),
            said("tracker_cycle", 1.085, trajectory_taken=1),
            status(1.11, "sailing", 3),
            said("trajectory", 1.3, 1.12, id=2), said("tracker_cycle", 1.12, trajectory_taken=2),
            said("map_updates", 2.0), status(2.01, "replanning", 3, self.NEAR),
            said("trajectory", 2.01, 2.4, id=3), status(2.4, "stopping", 3, self.NEAR),
            said("tracker_cycle", 2.41, trajectory_taken=2),
            said("tracker_cycle", 2.42, trajectory_taken=3),
            status(2.9, "sailing", 4), said("map_updates", 3.0),
            status(3.01, "replanning", 4, self.NEAR), said("trajectory", 3.1, 3.05, id=4),
            status(3.06, "evading", 4), said("tracker_cycle", 3.07, trajectory_taken=4),
        ])
        self.assertEqual([c["kind"] for c in found], ["plan", "stop", "way among others"])
        self.assertEqual([c["plans"] for c in found], [2, 0, 0])
        self.assertEqual([(c["scan"], c["decision"], c["answer"], c["command"]) for c in found],
                         [(1.0, 1.02, 1.11, 1.12), (2.0, 2.01, 2.4, 2.42),
                          (3.0, 3.01, 3.06, 3.07)])
        self.assertEqual(sorted(wall_ms), [5.0, 20.0, 20.0, 20.0])

    def test_what_is_no_conflict_or_goes_by_itself_does_not_count(self):
        found, _ = conflicts([
            status(0.9, "sailing", 1), said("map_updates", 1.0),
            status(1.0, "replanning", 1, "new goal"), said("trajectory", 1.3, 1.1, id=2),
            status(1.1, "sailing", 2), said("tracker_cycle", 1.1, trajectory_taken=2),
            status(2.0, "replanning", 2, self.NEAR), status(2.1, "sailing", 2),
            said("trajectory", 3.0, id=3), said("tracker_cycle", 3.1, trajectory_taken=3),
        ])
        self.assertEqual(found, [])

    def test_bag_and_json_that_make_no_sense_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "run.bag")
            synthetic.write_bag(bag)
            with open(bag, "rb") as file:
                recorded = file.read()
            self.refused(f"--json {bag}: would be written over", bag, "--json", bag)
            self.refused(f"--json {folder}: is a folder", bag, "--json", folder)
            self.refused("Not a directory", bag, "--json", os.path.join(bag, "new", "times.json"))
            with open(bag, "rb") as file:
                self.assertEqual(file.read(), recorded)
            out = os.path.join(folder, "new", "times.json")
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(latency([bag, "--json", out]), 0)
            with open(out) as file:
                self.assertEqual(json.load(file)["conflicts"], [])
            synthetic.damage(bag)
            self.refused(f"{bag}: damaged after 1", bag)

    def refused(self, word, *arguments):
        said = io.StringIO()
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(latency(arguments), 1)
        self.assertIn(word, said.getvalue())


if __name__ == "__main__":
    unittest.main()
