"""scripts/mission.sh refuses what no node could take, before it installs or builds anything."""
import os
import shutil
import subprocess
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "scripts",
                      "mission.sh")


class MissionScriptTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name, text=None):
        path = os.path.join(self.folder, name)
        if text is not None:
            with open(path, "w") as file:
                file.write(text)
        return path

    def refusal(self, *arguments):
        run = subprocess.run([SCRIPT, *arguments, "--vessel", "no such vessel"], timeout=60, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertEqual(run.returncode, 2, run.stdout)
        return run.stdout

    def test_seed_is_checked(self):
        for seed in ("2147483648", "99999999999", "18446744073709551617", "-1", "1.5", ""):
            self.assertIn(f"--seed must be a whole number from 0 to 2147483647, got '{seed}'",
                          self.refusal("--seed", seed))
        for seed in ("0", "08", "2147483647"):
            self.assertIn("--vessel", self.refusal("--seed", seed))

    def test_mission_is_one_of_the_scenario(self):
        two = self.path("two.yaml", "missions:\n  - {}\n  - {}\n")
        for mission in ("2", "99", "000000009"):
            self.assertIn(f"--mission must be from 0 to 1 in '{two}', got '{mission}'",
                          self.refusal("--scenario", two, "--mission", mission))
        for mission in ("0", "1", "01"):
            self.assertIn("--vessel", self.refusal("--scenario", two, "--mission", mission))
        none = self.path("none.yaml", "missions: []\n")
        self.assertIn("--scenario: no missions", self.refusal("--scenario", none))

    def test_speed_is_within_what_the_nodes_take(self):
        for speed in ("1000.5", "1001", "5000", "-1", "1e3", "nan"):
            self.assertIn(f"--speed must be a number from 0 to 1000, got '{speed}'",
                          self.refusal("--speed", speed))
        for speed in ("0", "0.5", "999.9", "1000"):
            self.assertIn("--vessel", self.refusal("--speed", speed))

    def test_result_is_neither_a_folder_nor_its_track(self):
        track = self.path("mission.csv", "t,x,y\n")
        for result, why in ((self.folder, "folder"), (self.path("new/"), "folder"), (track, ".csv")):
            said = self.sail("--result", result)
            self.assertIn("--result must", said)
            self.assertIn(why, said)
        with open(track) as file:
            self.assertEqual(file.read(), "t,x,y\n")

    def test_recording_that_was_cut_off_stays(self):
        cut = self.path("run.bag.active", "#ROSBAG V2.0\n")
        self.assertIn(cut, self.sail("--record", self.path("run.bag")))
        self.assertIn("folder", self.sail("--record", self.folder))

    def sail(self, *arguments):
        """As refusal(), by what comes after the vessel's check."""
        run = subprocess.run([SCRIPT, "--no-build", *arguments], timeout=60, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertEqual(run.returncode, 2, run.stdout)
        return run.stdout

    def test_earlier_result_stays_until_there_is_another(self):
        for name in ("maps/demo/demo.yaml", "config/vessels/otter_gazebo.yaml",
                     "config/disturbances/paper.yaml"):
            os.makedirs(os.path.dirname(self.path(name)))
            self.path(name, "{}\n")
        os.makedirs(self.path("scripts"))
        os.makedirs(self.path("install"))
        script = shutil.copy(SCRIPT, self.path("scripts"))
        result = self.path("result.json", "earlier\n")

        def sail(launched):
            """With that in roslaunch's place."""
            self.path("install/setup.bash", f"roslaunch() {{ {launched}; }}\n")
            return subprocess.run([script, "--no-build", "--no-rviz", "--result", result], timeout=60,
                                  text=True, capture_output=True, check=False)
        failed = sail("false")
        self.assertEqual(failed.returncode, 1, failed.stderr)
        self.assertIn("without a result", failed.stderr)
        self.assertIn(f"{result} is of an earlier one", failed.stderr)
        with open(result) as file:
            self.assertEqual(file.read(), "earlier\n")
        ended = """echo '{"missions": []}' >"$result.part"; mv "$result.part" "$result\""""
        self.assertEqual(sail(ended).returncode, 1)  # none arrived
        with open(result) as file:
            self.assertIn("missions", file.read())
        os.remove(result)
        self.assertNotIn("earlier", sail("false").stderr)
