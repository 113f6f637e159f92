"""Scenarios, charts and vessel files that are none: named, with what is wrong."""
import os
import tempfile
import unittest

from otter_nav.chart import load_scenario
from otter_nav.errors import RecordingError
from otter_nav.vessel import load_vessel

CHART = b"{image: chart.png, resolution: 1, origin: [0, 0, 0]}"


class FilesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def refused(self, load, text, *words):
        path = os.path.join(self.folder, "given.yaml")
        with open(path, "wb") as file:
            file.write(text)
        with self.assertRaises(RecordingError) as caught:
            load(path)
        for word in (*words, self.folder):
            self.assertIn(word, str(caught.exception))

    def test_scenarios(self):
        for text, why in ((b"\xff\xfe\xff", "codec"), (b"\x00", "special characters"), (b"", "neither"),
                          (b"missions: []", "no 'chart'"), (b"chart: 5", "'chart' is no file's name: 5"),
                          (b"{chart: null}", "'chart' is no file's name: None"),
                          (b"{chart: a.yaml, world: [b.yaml]}", "'world' is no file's name"),
                          (b"chart: none.yaml", "none.yaml")):
            self.refused(load_scenario, text, why)

    def test_charts(self):
        # The last: a PNG that breaks off.
        for image in (None, b"", b"P5\n12", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\0\0\0\0"):
            if image is not None:
                with open(os.path.join(self.folder, "chart.png"), "wb") as file:
                    file.write(image)
            self.refused(load_scenario, CHART, "chart")
        self.refused(load_scenario, b"{image: 5, resolution: 1, origin: [0, 0]}", "chart")

    def test_vessels(self):
        self.refused(load_vessel, b"name: \xff", "codec")
        self.refused(load_vessel, b"name: [", "vessel file")
        self.refused(load_vessel, b"", "vessel file")


if __name__ == "__main__":
    unittest.main()
