"""Situations of ships as scenarios of small vessels."""
import importlib.util
import json
import os
import subprocess
import tempfile
import unittest

import numpy as np
import yaml

SCRIPT = os.path.join(os.path.dirname(__file__), "..", "..", "scripts", "traffic_situations.py")
SPEC = importlib.util.spec_from_file_location("traffic_situations", SCRIPT)
situations = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(situations)

NORTH_DEG = np.degrees(1.0 / situations.EARTH_M)  # a metre


def ship(knots, *places):
    """From a place at 60 deg north, where a degree of longitude is half as long; metres."""
    return {"waypoints": [{"position": {"lon": 10.0 + 2.0 * NORTH_DEG * east, "lat": 60.0 + NORTH_DEG * north},
                           "leg": {"sog": knots}} for east, north in places]}


class TrafficSituations(unittest.TestCase):
    def test_keeps_what_the_situation_is(self):
        """Own way to the east, 8 km at 10 kn; she crosses its middle at the same moment, at 5 kn."""
        situation = {"ownShip": ship(10.0, (0.0, 0.0), (8000.0, 0.0)),
                     "targetShips": [ship(5.0, (4000.0, -2000.0), (4000.0, 1000.0))]}
        made = yaml.safe_load(situations.scenario(situation, "water.yaml", 400.0, 2.0))
        self.assertEqual((made["chart"], made["missions"][0]["speed_mps"]), ("water.yaml", 2))
        np.testing.assert_allclose(made["missions"][0]["start"][:2], [0.0, -200.0])
        she = made["vessels"][0]
        self.assertEqual(she["speeds_mps"], [1.0])
        np.testing.assert_allclose(she["waypoints"], [[100.0, 0.0], [-350.0, 0.0]], atol=0.1)

    def test_names_a_file_that_is_none(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wrong.json")
            for text in ("no JSON", "[]", json.dumps({"ownShip": ship(1.0, (0.0, 0.0))})):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                done = subprocess.run(["/usr/bin/python3", SCRIPT, "--out", folder, "--chart", "water.yaml", path],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 1)
                self.assertIn(path, done.stderr)
                self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
