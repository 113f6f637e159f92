"""The judge of encounters on tracks whose figures are known."""
import argparse
import contextlib
import importlib.util
import io
import json
import math
import os
import tempfile
import unittest
from unittest import mock

import numpy as np

SCRIPT = os.path.join(os.path.dirname(__file__), "..", "..", "scripts", "judge_encounters.py")
SPEC = importlib.util.spec_from_file_location("judge_encounters", SCRIPT)
judge = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(judge)

MISSION = {"start": [0.0, -200.0, math.pi / 2], "goal": [0.0, 200.0, math.pi / 2], "speed_mps": 2.0}


def sail(*legs):
    """Own track from (0, -200): course in degrees to starboard of north, speed, duration."""
    t, x, y, psi = [0.0], [0.0], [-200.0], [math.pi / 2]
    for turn, speed, duration in legs:
        course = math.pi / 2 - math.radians(turn)
        for _ in range(int(duration / 0.1)):
            t.append(t[-1] + 0.1)
            x.append(x[-1] + 0.1 * speed * math.cos(course))
            y.append(y[-1] + 0.1 * speed * math.sin(course))
            psi.append(course)
    return judge.Track(np.array(t), np.array(x), np.array(y), np.array(psi))


def meet(own, heading, speed=2.0, told_s=0.0):
    """One vessel that is at the origin after 100 s, and whose track begins at `told_s`."""
    h = math.radians(heading)
    course = np.array([math.sin(h), math.cos(h)]) * speed
    vessel = {"id": 1, "length_m": 6.0, "beam_m": 2.0, "speeds_mps": [speed],
              "waypoints": [list(-100.0 * course), list(300.0 * course)]}
    t = np.arange(told_s, own.t[-1] + 0.1, 0.1)
    run = judge.Run(own, MISSION, [(vessel, judge.scripted(vessel, t))], (2.0, 1.08))
    return run.encounters[0]


def broken(encounter):
    return {rule for rule, kept in encounter.rules if not kept}


class Judge(unittest.TestCase):
    def test_distance_of_rectangles(self):
        still = judge.Track(np.array([0.0, 1.0]), np.zeros(2), np.zeros(2), np.zeros(2))
        other = judge.Track(np.array([0.0, 1.0]), np.array([10.0, 10.0]), np.zeros(2),
                            np.full(2, math.pi / 2))
        t = np.array([0.5])
        self.assertAlmostEqual(
            judge.outline_distance(still, (2, 1), other, (6, 2), t)[0], 10 - 1 - 1)
        # Corner to corner, and one within the other.
        aside = judge.Track(other.t, np.full(2, 5.0), np.full(2, 6.5), np.zeros(2))
        self.assertAlmostEqual(judge.outline_distance(still, (2, 1), aside, (2, 4), t)[0],
                               math.hypot(3.0, 4.0))
        self.assertEqual(judge.outline_distance(still, (2, 1), still, (6, 2), t)[0], 0.0)

    def test_files_that_make_no_sense_are_named(self):
        entry = {"scenario": "sea", "mission": 0, "track": "/elsewhere/own.csv", "outcome": "arrived"}
        scenario = {"missions": [MISSION]}
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(SystemExit, "/elsewhere/own.csv"):
                judge.judge_mission(entry, scenario, folder, (2.0, 1.08))
            os.mkdir(os.path.join(folder, "tracks"))
            track = os.path.join(folder, "tracks", "own.csv")
            for rows in ("", "t,x,y,psi\n", "t,x,y,psi\n0,0,-200,1.57\n", "t,x,y,psi\n0,0\n1,0\n", "t,x,y\n"):
                with open(track, "w") as file:
                    file.write(rows)
                with self.assertRaisesRegex(SystemExit, track):
                    judge.judge_mission(entry, scenario, folder, (2.0, 1.08))
            with open(track, "w") as file:
                file.write("t,x,y,psi\n0,0,-200,1.57\n200,0,-199,1.57\n")
            arrived = judge.judge_mission(entry, scenario, folder, (2.0, 1.08))[1]
            self.assertTrue(arrived)
            for mission in (1, -1, "0", None):
                with self.assertRaisesRegex(SystemExit, f"mission {mission} of sea, which has 1"):
                    judge.judge_mission({**entry, "mission": mission}, scenario, folder, (2.0, 1.08))
            vessel = {"id": 7, "length_m": 6.0, "beam_m": 2.0, "speeds_mps": [2.0],
                      "waypoints": [[0, 0], [10, 0]]}
            met = os.path.join(folder, "tracks", "met.csv")
            with open(met, "w") as file:
                file.write("id,t,x,y,psi\n6,0,0,0,0\n")
            with self.assertRaisesRegex(SystemExit, f"{met}: no rows of vessel 7"):
                judge.judge_mission({**entry, "vessels": "met.csv"}, {**scenario, "vessels": [vessel]},
                                    folder, (2.0, 1.08))

    def test_values_that_are_no_numbers_are_no_clear_water(self):
        scenario = {"missions": [MISSION]}
        with tempfile.TemporaryDirectory() as folder:
            track = os.path.join(folder, "own.csv")
            entry = {"scenario": "sea", "mission": 0, "track": track, "outcome": "arrived"}
            for column in range(4):
                for value in ("nan", "inf"):
                    row = ["100", "0", "-100", "1.57"]
                    row[column] = value
                    with open(track, "w") as file:
                        file.write("t,x,y,psi\n0,0,-200,1.57\n" + ",".join(row) + "\n")
                    name = "t x y psi".split()[column]
                    with self.assertRaisesRegex(SystemExit, f"{track}: row 2: {name} is {value}"):
                        judge.judge_mission(entry, scenario, folder, (2.0, 1.08))

    def test_scenarios_that_are_none_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "sea.yaml")
            for text, why in ((b"", "no missions"), (b"missions: 3\n", "no missions"), (b"\xff", "utf-8"),
                              (b"missions: [{start: [0, 0, 0]}]\n", r"missions\[0\] without goal"),
                              (b"missions: [5]\n", r"missions\[0\] without goal, start"),
                              (b"missions: []\nvessels: [{id: 1}]\n", r"vessels\[0\] without beam_m")):
                with open(path, "wb") as file:
                    file.write(text)
                with self.assertRaisesRegex(SystemExit, f"{path}.*{why}"):
                    judge.read_scenario(folder, "sea")

    def test_hull_is_two_lengths(self):
        self.assertEqual(judge.hull_of("2.0,1.08"), (2.0, 1.08))
        for text in ("2.0", "abc", "2,1,3", "2,nan", "0,1", "2,-1", "inf,1", ""):
            with self.assertRaisesRegex(argparse.ArgumentTypeError, f"got '{text}'"):
                judge.hull_of(text)

    def test_judges_the_tracks_beside_the_result(self):
        entry = {"scenario": "sea", "mission": 0, "seed": 1, "vessel": "otter", "outcome": "arrived",
                 "track": "run/own.csv"}
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "sea.yaml"), "w") as file:
                json.dump({"missions": [MISSION]}, file)
            results = []
            for name, end in (("a", 0), ("b", 200)):
                os.mkdir(os.path.join(folder, name))
                with open(os.path.join(folder, name, "own.csv"), "w") as file:
                    file.write("t,x,y,psi\n" + "".join(f"{t},0,{end * t / 200 - 200},1.57\n"
                                                       for t in range(401)))
                results.append(os.path.join(folder, name, "result.json"))
                with open(results[-1], "w") as file:
                    json.dump({"missions": [entry]}, file)
            claims = ["arrival claimed" in self.say(folder, result) for result in results]
            self.assertEqual(claims, [True, False])
            # Of two of that name below it, either may be another's.
            above = os.path.join(folder, "above.json")
            with open(above, "w") as file:
                json.dump({"missions": [entry]}, file)
            for result in (above, os.path.join(folder, "none.json"), os.path.join(folder, "sea.yaml")):
                with self.assertRaisesRegex(SystemExit, "several" if result == above else result):
                    self.say(folder, result)
            with self.assertRaisesRegex(SystemExit, "elsewhere/sea.yaml"):
                self.say(os.path.join(folder, "elsewhere"), results[0])

    @staticmethod
    def say(scenarios, result):
        said = io.StringIO()
        with contextlib.redirect_stdout(said), mock.patch("sys.argv", [
                "judge_encounters.py", "--scenarios", scenarios, "--json", result]):
            judge.main()
        return said.getvalue()

    def test_scores(self):
        for r, score in ((12, 1.0), (10, 1.0), (6, 0.625), (3, 0.0), (8, 0.8125), (0, 0.0)):
            self.assertAlmostEqual(judge.range_score(r), score)

    def test_straight_on_is_contact(self):
        for heading, situation in ((180, "head-on"), (270, "crossing give-way")):
            encounter = meet(sail((0, 2.0, 200)), heading)
            self.assertEqual(encounter.situation, situation)
            self.assertEqual(encounter.r, 0.0)
            self.assertLessEqual({"8a", "8b", "8d"}, broken(encounter))

    def test_head_on(self):
        good = meet(sail((0, 2.0, 20), (40, 2.0, 15), (0, 2.0, 160)), 180)
        self.assertEqual(broken(good), set())
        self.assertGreater(good.r, 10.0)
        port = meet(sail((0, 2.0, 20), (-40, 2.0, 15), (0, 2.0, 160)), 180)
        self.assertEqual(broken(port), {"14"})
        timid = meet(sail((0, 2.0, 20), (15, 2.0, 40), (0, 2.0, 140)), 180)
        self.assertEqual(broken(timid), {"8b"})
        late = meet(sail((0, 2.0, 82), (60, 2.0, 12), (0, 2.0, 100)), 180)
        self.assertEqual(broken(late), {"8a"})

    def test_crossing(self):
        self.assertEqual(broken(meet(sail((0, 2.0, 20), (0, 0.9, 30), (0, 2.0, 170)), 270)), set())
        ahead = meet(sail((0, 2.0, 20), (-40, 2.0, 25), (0, 2.0, 170)), 270)
        self.assertIn("15", broken(ahead))

    def test_standing_on(self):
        self.assertEqual(meet(sail((0, 2.0, 200)), 67.5).situation, "crossing stand-on")
        self.assertEqual(broken(meet(sail((0, 2.0, 200)), 67.5)), {"17b"})
        self.assertEqual(broken(meet(sail((0, 2.0, 76), (0, 0.5, 30), (0, 2.0, 120)), 67.5)), set())
        early = broken(meet(sail((0, 2.0, 40), (0, 0.5, 30), (0, 2.0, 120)), 67.5))
        self.assertEqual(early, {"17a"})
        port = meet(sail((0, 2.0, 76), (-60, 2.0, 20), (0, 2.0, 100)), 67.5)
        self.assertIn("17c", broken(port))

    def test_a_track_that_begins_a_moment_later(self):
        for told_s in (0.01, 0.05):
            late = meet(sail((0, 2.0, 200)), 67.5, told_s=told_s)
            self.assertEqual((late.since, broken(late)), (0, {"17b"}))


if __name__ == "__main__":
    unittest.main()
