"""The programs find their package by themselves, wherever they are installed."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PYTHON = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "python")
PROGRAMS = sorted(os.listdir(os.path.join(PYTHON, "programs")))


def tell_usage(program):
    """Of a shell in which nothing was sourced."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return subprocess.run([sys.executable, program, "--help"], timeout=60, text=True, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)


class ProgramsTest(unittest.TestCase):
    def assert_runs(self, program):
        with self.subTest(program=program):
            run = tell_usage(program)
            self.assertEqual(run.returncode, 0, run.stdout)
            self.assertIn("usage:", run.stdout)

    def test_there_are_some(self):
        self.assertIn("report", PROGRAMS)

    def test_from_the_source_tree(self):
        for name in PROGRAMS:
            self.assert_runs(os.path.join(PYTHON, "programs", name))

    def test_from_a_prefix_that_was_not_sourced(self):
        with tempfile.TemporaryDirectory() as prefix:
            shutil.copytree(os.path.join(PYTHON, "programs"), os.path.join(prefix, "lib/otter_nav"))
            shutil.copytree(os.path.join(PYTHON, "otter_nav"),
                            os.path.join(prefix, "lib/python3/dist-packages/otter_nav"))
            for name in PROGRAMS:
                self.assert_runs(os.path.join(prefix, "lib/otter_nav", name))


if __name__ == "__main__":
    unittest.main()
