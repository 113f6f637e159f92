"""scripts/mission.sh refuses what no node could take, before it installs or builds anything."""
import os
import subprocess
import unittest

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "scripts",
                      "mission.sh")


class MissionScriptTest(unittest.TestCase):
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
