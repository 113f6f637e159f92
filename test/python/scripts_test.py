"""Scripts say what they are for, and refuse what they don't know, before they do anything."""
import os
import shutil
import subprocess
import tempfile
import unittest

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "scripts")
NAMES = ("build.sh", "check_style.sh", "identify_otter.sh", "install_dependencies.sh", "man_pages.sh",
         "mission.sh", "package.sh", "reproduce.sh", "test.sh", "test_sanitized.sh", "tracking_table.sh")


class ScriptsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def run_alone(self, name, *arguments):
        """In a tree that holds nothing else, where it could do no harm."""
        script = os.path.join(self.folder, "scripts", name)
        os.makedirs(os.path.dirname(script), exist_ok=True)
        shutil.copy(os.path.join(SCRIPTS, name), script)
        run = subprocess.run([script, *arguments], timeout=60, text=True, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, cwd=self.folder, check=False)
        self.assertEqual(os.listdir(self.folder), ["scripts"], run.stdout)
        return run.returncode, run.stdout

    def refused(self, word, name, *arguments):
        code, said = self.run_alone(name, *arguments)
        self.assertEqual(code, 2, said)
        self.assertIn(word, said)

    def test_help(self):
        for name in NAMES:
            for option in ("--help", "-h"):
                with self.subTest(name=name, option=option):
                    code, said = self.run_alone(name, option)
                    self.assertEqual(code, 0, said)
                    self.assertIn(name, said)

    def test_unknown_options_are_refused(self):
        for name in NAMES:
            with self.subTest(name=name):
                self.refused("'--nonsense'", name, "--nonsense")
        self.refused("'quick'", "test.sh", "quick")
        self.refused("'--nonsense'", "reproduce.sh", "out", "--nonsense")
        self.refused("'b'", "reproduce.sh", "a", "b")
        self.refused("'--nonsense'", "test_sanitized.sh", "build", "--nonsense")

    def test_what_is_missing_is_named(self):
        self.refused("--seeds needs a value", "tracking_table.sh", "--seeds")
        for seeds in ("", "one", "1,2", "-1"):
            self.refused(f"--seeds must be whole numbers from 0, got '{seeds}'", "tracking_table.sh",
                         "--seeds", seeds)
        self.refused("no program 'nowhere/benchmark'", "tracking_table.sh", "nowhere/benchmark")
        self.refused("no folder 'nowhere'", "identify_otter.sh", "nowhere")
        out = os.path.join(self.folder, "otter.yaml")
        self.refused("no program excitation_run", "identify_otter.sh", "scripts", out)
        self.refused("'nowhere'", "reproduce.sh", "--build", "nowhere")
        self.refused("--build needs a folder", "reproduce.sh", "--build")


if __name__ == "__main__":
    unittest.main()
