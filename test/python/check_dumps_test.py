"""The maps that the check of dumps reads: those of the scenarios, and what is none."""
import importlib.util
import os
import tempfile
import unittest

import numpy as np

from otter_nav.chart import load_grid

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir)
SPEC = importlib.util.spec_from_file_location("check_dumps", os.path.join(TOP, "scripts", "check_dumps.py"))
check_dumps = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check_dumps)


class Maps(unittest.TestCase):
    def test_scenarios_maps_are_read(self):
        path = os.path.join(TOP, "scenarios", "archipelago", "archipelago_001_world.yaml")
        np.testing.assert_array_equal(check_dumps.Map(path).occupied, load_grid(path).occupied)

    def test_pgm_is_read_from_the_top(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "map.yaml")
            with open(path, "w") as file:
                file.write("{image: map.pgm, resolution: 0.5, origin: [1, 2, 0], negate: 0,"
                           " occupied_thresh: 0.65}\n")
            with open(os.path.join(folder, "map.pgm"), "wb") as file:
                file.write(b"P5\n# a comment\n3 2\n255\n" + bytes([0, 254, 254, 254, 254, 205]))
            self.assertEqual(check_dumps.Map(path).occupied.tolist(),
                             [[False, False, False], [True, False, False]])

    def test_images_that_are_cut_off_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "map.pgm")
            for text in (b"", b"P5", b"P5\n12", b"P5\n3 2\n255\n\0\0", b"\x89PNG\r\n\x1a\n\0\0"):
                with open(path, "wb") as file:
                    file.write(text)
                with self.assertRaisesRegex(SystemExit, path):
                    check_dumps.read_image(path)


if __name__ == "__main__":
    unittest.main()
