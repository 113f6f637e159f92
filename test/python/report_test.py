"""Pages made of recordings: self-contained, readable by a parser, and their figures beside them."""
import html.parser
import io
import json
import os
import re
import shutil
import tempfile
import unittest
from unittest import mock

import synthetic

from otter_nav.report import main as report


class Reader(html.parser.HTMLParser):
    """Text, headings and ids of a page; complains of tags that do not close."""
    VOID = {"meta", "link", "br", "img"}

    def __init__(self, text):
        super().__init__()
        self.open, self.text, self.headings, self.ids, self.pictures = [], [], [], [], 0
        self.feed(text)
        if self.open:
            raise AssertionError(f"never closed: {self.open}")

    def handle_starttag(self, tag, attributes):
        self.pictures += tag == "svg"
        self.ids += [value for name, value in attributes if name == "id"]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if self.open.pop() != tag:
            raise AssertionError(f"</{tag}> closes another")

    def handle_data(self, data):
        if self.open and self.open[-1] == "h2":
            self.headings.append(data)
        if self.open and self.open[-1] != "style":
            self.text.append(data)


class ReportTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.out = os.path.join(self.folder, "pages", "report.html")

    def make(self, *arguments):
        self.assertEqual(report([*arguments, "--out", self.out]), 0)
        with open(self.out) as file:
            text = file.read()
        with open(os.path.join(self.folder, "pages", "report.json")) as file:
            return text, Reader(text), json.load(file)

    def check_alone(self, text, page):
        """Nothing is fetched, in either look nothing keeps a stand-in's colour."""
        links = re.findall(r'(?:src|href)="([^"]*)"', text) + re.findall(r"url\(([^)]*)\)", text)
        self.assertEqual([x for x in links if not x.startswith(("#", "data:"))], [])
        self.assertNotIn("<script", text)
        self.assertNotIn("<link", text)
        self.assertEqual(re.findall(r"#01(?:02|03)[0-9a-f]{2}\b", text), [])
        self.assertEqual(len(page.ids), len(set(page.ids)))
        self.assertIn("prefers-color-scheme:dark", text)
        self.assertIn("@media print", text)

    def test_page_of_a_bag(self):
        bag = os.path.join(self.folder, "run.bag")
        synthetic.write_bag(bag)
        text, page, figures = self.make("--bag", bag)
        self.check_alone(text, page)
        for heading in ("Track", "Tracking error", "Speed", "Thrusts", "Clearance",
                        "Wind, current and force", "Planning", "Tracker", "Events",
                        "Versions and parameters"):
            self.assertIn(heading, page.headings)
        self.assertGreaterEqual(page.pictures, 8)
        words = " ".join(page.text)
        for word in ("0.500", "contact begins", "sailing → arrived", "speed, m/s", "saturated"):
            self.assertIn(word, words)
        self.assertAlmostEqual(figures["tracking_error_mean_m"], 0.5, 6)
        self.assertAlmostEqual(figures["duration_s"], 16.0, 6)

    def test_vessel_of_a_bag_is_the_weakest_that_can_give_its_commands(self):
        bag = os.path.join(self.folder, "run.bag")
        for thrust, name in ((50.0, "otter_gazebo"), (100.0, "otter"), (500.0, "wam_v")):
            with mock.patch("synthetic.LEFT_N", thrust):
                synthetic.write_bag(bag)
            text, _, _ = self.make("--bag", bag)
            self.assertIn(f"vessel {name} (assumed", text)
        text, _, _ = self.make("--bag", bag, "--vessel", "otter")
        self.assertIn("vessel otter<", text)

    def test_page_of_a_result_states_the_missions_own_figures(self):
        path = synthetic.write_result(self.folder, 2)
        text, page, figures = self.make("--result", path, "--run", "2")
        self.check_alone(text, page)
        self.assertAlmostEqual(figures["tracking_error_mean_m"], 0.11)
        self.assertEqual(figures["outcome"], "stopped")
        self.assertAlmostEqual(figures["cross_error_rms_m"], 0.1, 3)
        self.assertAlmostEqual(figures["along_error_rms_m"], 0.0, 3)
        self.assertAlmostEqual(figures["window_from_s"], 1.0)
        self.assertIn("no way <left>", " ".join(page.text))
        self.assertIn("no way &lt;left&gt;", text)

    def test_says_what_is_missing(self):
        path = synthetic.write_result(self.folder)
        os.remove(os.path.join(self.folder, "tracks", "pond_0.csv"))
        for arguments in (["--result", path], ["--bag", path], ["--result", self.folder],
                          ["--result", path, "--run", "5"], ["--campaign", self.folder + "/none"]):
            self.assertEqual(report([*arguments, "--out", self.out]), 1, arguments)
            self.assertFalse(os.path.exists(self.out))

    def test_takes_no_other_missions_track(self):
        path = synthetic.write_result(self.folder, 2)
        track = os.path.join(self.folder, "tracks", "pond_0.csv")
        os.mkdir(os.path.join(self.folder, "other"))
        shutil.copy(track, os.path.join(self.folder, "other"))
        self.assertEqual(report(["--result", path, "--out", self.out]), 1)
        _, _, figures = self.make("--campaign", self.folder)
        self.assertEqual(figures["missions"]["count"], 2)
        shutil.move(track, self.folder)
        self.assertEqual(report(["--result", path, "--out", self.out]), 0)

    def test_never_writes_over_its_source(self):
        path = synthetic.write_result(self.folder)
        before = open(path).read()
        self.assertEqual(report(["--result", path, "--out", path[:-5] + ".html"]), 1)
        self.assertEqual(open(path).read(), before)

    def test_campaign_of_missions(self):
        synthetic.write_result(self.folder, 3)
        text, page, figures = self.make("--campaign", self.folder)
        self.check_alone(text, page)
        self.assertEqual(figures["missions"]["count"], 3)
        self.assertEqual(figures["missions"]["arrived"], 2)
        self.assertAlmostEqual(figures["missions"]["tracking_error_max_m"], 0.3)
        self.assertIn("no way <left>", " ".join(page.text))

    def test_campaign_with_a_mission_of_which_nothing_was_measured(self):
        path = synthetic.write_result(self.folder, 2)
        with open(path) as file:
            result = json.load(file)
        result["missions"][1].update(tracking_error_max_m=None, min_clearance_m=None)
        with open(path, "w") as file:
            json.dump(result, file)
        self.make("--campaign", self.folder)

    def test_campaign_leaves_out_missions_without_figures(self):
        good = synthetic.write_result(self.folder, 2)
        with open(good) as file:
            whole = json.load(file)["missions"]
        bad = {"other.json": ([{"scenario": 3}], "tracking_error_mean_m, tracking_error_max_m"),
               "half.json": ([whole[0], {**whole[1], "replans": "few"}], "mission 1 has no number for replans"),
               "nan.json": ([{**whole[0], "duration_s": float("nan")}], "duration_s"),
               "list.json": ([3], "mission 0 is no mapping")}
        for name, (missions, _) in bad.items():
            with open(os.path.join(self.folder, name), "w") as file:
                json.dump({"missions": missions}, file)
        with mock.patch("sys.stderr", new_callable=io.StringIO) as told:
            _, _, figures = self.make("--campaign", self.folder)
        self.assertEqual(figures["missions"]["count"], 2)
        lines = told.getvalue().splitlines()
        for name, (_, missing) in bad.items():
            line = [line for line in lines if os.path.join(self.folder, name) in line]
            self.assertEqual(len(line), 1, lines)
            self.assertIn(missing, line[0])

    @staticmethod
    def plans():
        """What planner_benchmark writes; the last failed."""
        cases = [{"scenario": "pond", "mission": k, "kind": "cross", "seed": 1, "method": "proposed",
                  "success": k != 3, "reason": "time up" if k == 3 else "",
                  "first_solution_ms": None if k == 3 else 4.0, "total_ms": 10.0 * (k + 1),
                  "length_m": 100.0, "duration_s": 30.0, "cost": 300.0, "node_utilization": 0.4,
                  "shortest_m": 95.0, "dump": f"way_{k}.csv"} for k in range(4)]
        summary = {"cases": 4, "success_rate_100ms": 0.75, "success_rate_1s": 0.75,
                   "length_m_mean": 100.0, "duration_s_mean": 30.0, "cost_mean": 300.0,
                   "node_utilization_mean": 0.4, "total_ms_mean": 25.0, "total_ms_median": 20.0,
                   "total_ms_p95": 40.0, "first_solution_ms_median": 4.0, "mean_speed_mps": 3.3,
                   "length_ratio_median": 1.05}
        return {"vessel": "otter", "map": "world", "budget_ms": 1000.0, "cases": cases,
                "summary": {"cross": {"proposed": summary}}}

    def test_campaign_leaves_out_benchmarks_without_figures(self):
        bad = {name: (self.plans(), missing) for name, missing in (
            ("time.json", "case 1 has no number for total_ms"), ("null.json", "case 0 has no number for length_m"),
            ("label.json", "case 2 has no scenario"), ("list.json", "case 3 is no mapping"),
            ("row.json", "its summary of cross proposed has no number for cost_mean"),
            ("summary.json", "its summary is no mapping"), ("kind.json", "its summary of cross"))}
        del bad["time.json"][0]["cases"][1]["total_ms"]
        bad["null.json"][0]["cases"][0]["length_m"] = None
        del bad["label.json"][0]["cases"][2]["scenario"]
        bad["list.json"][0]["cases"][3] = 3
        del bad["row.json"][0]["summary"]["cross"]["proposed"]["cost_mean"]
        bad["summary.json"][0]["summary"] = None
        bad["kind.json"][0]["summary"]["cross"] = None
        bad["tracking.json"] = ({"mean_error_m": None, "path": "eight", "vessel": "otter"}, "mean_error_m")
        for name, (data, _) in {"good.json": (self.plans(), ""), **bad}.items():
            with open(os.path.join(self.folder, name), "w") as file:
                json.dump(data, file)
        with mock.patch("sys.stderr", new_callable=io.StringIO) as told:
            _, _, figures = self.make("--campaign", self.folder)
        self.assertEqual(figures["plans"]["count"], 4)
        lines = told.getvalue().splitlines()
        for name, (_, missing) in bad.items():
            line = [line for line in lines if os.path.join(self.folder, name) in line]
            self.assertEqual(len(line), 1, lines)
            self.assertIn(missing, line[0])

    def test_campaign_of_benchmarks(self):
        dumps = ["", "t,x,y,u,v\n", "t,x,y,u,v\n0,0,0,0,0\n"]
        for k, content in enumerate(dumps):  # without a way to draw
            with open(os.path.join(self.folder, f"way_{k}.csv"), "w") as file:
                file.write(content)
        with open(os.path.join(self.folder, "planner.json"), "w") as file:
            json.dump(self.plans(), file)
        with open(os.path.join(self.folder, "tracking.json"), "w") as file:
            json.dump({"vessel": "otter", "path": "eight", "disturbance": "paper", "method": "flatness",
                       "seed": 1, "mean_error_m": 0.05, "max_error_m": 0.2, "mean_speed": 2.0,
                       "max_speed": 3.0, "yaw_rate_integral": 0.9, "thrust_rms_n": 60.0,
                       "saturation_share": 0.01, "solver_us": {"median": 40.0, "p99": 90.0}}, file)
        text, page, figures = self.make("--campaign", self.folder)
        self.check_alone(text, page)
        self.assertEqual(figures["plans"]["count"], 4)
        self.assertEqual(figures["plans"]["solved"], 3)
        self.assertAlmostEqual(figures["tracking"]["mean_error_m"], 0.05)
        words = " ".join(page.text)
        for word in ("Table I", "Table II", "time up"):
            self.assertIn(word, words)


if __name__ == "__main__":
    unittest.main()
