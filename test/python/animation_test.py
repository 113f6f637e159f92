"""Moving pictures of recordings."""
import os
import tempfile
import unittest
from unittest import mock

import numpy
import synthetic
from PIL import Image

from otter_nav.animation import _UNCHARTED, _UNSEEN, _WATER, Film, frame_times, main as animate
from otter_nav.bag import read_bag
from otter_nav.run import Scan


class AnimationTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.bag = os.path.join(self.folder, "run.bag")
        synthetic.write_bag(self.bag)

    def make(self, name, *arguments):
        out = os.path.join(self.folder, name)
        return animate([*arguments, "--out", out]), out

    def test_gif_of_a_bag(self):
        code, out = self.make("run.gif", "--bag", self.bag, "--speed", "6", "--rate", "5",
                              "--width", "400")
        self.assertEqual(code, 0)
        with Image.open(out) as film:
            self.assertEqual(film.size[0], 400)
            # 18 s, six times as fast, five frames a second, and the first.
            self.assertEqual(film.n_frames, 16)
            first = numpy.array(film.convert("RGB"), dtype=int)
            film.seek(film.n_frames - 1)
            last = numpy.array(film.convert("RGB"), dtype=int)
        self.assertGreater(numpy.sum(numpy.abs(first - last).sum(axis=2) > 60), 300)

    def test_hull_is_drawn_where_the_vessel_is(self):
        run = read_bag(self.bag)[0]
        film = Film(run, None, 500)
        frame = numpy.array(film.frame(run.motion.t[-1]))
        x, y = film.view(run.motion.x[-1], run.motion.y[-1])
        self.assertEqual(tuple(frame[int(y), int(x)]), (255, 255, 255))

    def test_water_is_seen_where_beams_went(self):
        run = read_bag(self.bag)[0]
        begin = run.motion.t[0]
        # Nothing in sight but an echo dead ahead, from a mast 1 m ahead.
        ranges = numpy.full(361, numpy.inf, dtype=numpy.float32)
        ranges[180] = 3.0
        run.scans = [Scan(begin + 1.0, (1.0, 0.0), -numpy.pi, numpy.pi / 180, 5.0, ranges)]
        film = Film(run, None, 500)

        def at(frame, ahead, port):
            row = int(numpy.searchsorted(run.motion.t, begin + 1.0))
            c, s = numpy.cos(run.motion.psi[row]), numpy.sin(run.motion.psi[row])
            x, y = film.view(run.motion.x[row] + c * ahead - s * port,
                             run.motion.y[row] + s * ahead + c * port)
            return tuple(frame[int(y), int(x)])
        before, after = (numpy.array(film.frame(begin + t)) for t in (0.5, 1.5))
        self.assertEqual(at(before, 1.0, 4.0), _UNSEEN)
        self.assertEqual(at(after, 1.0, 4.0), _WATER)
        self.assertEqual(at(after, 1.0, 6.0), _UNSEEN)
        self.assertEqual(at(after, 4.0, 0.0), _UNCHARTED)

    def test_frames_end_with_the_run(self):
        run = read_bag(self.bag)[0]
        times = frame_times(run, 4.0, 10.0)
        self.assertAlmostEqual(times[1] - times[0], 0.4)
        self.assertAlmostEqual(times[-1], run.motion.t[-1])

    def test_gif_of_a_result(self):
        result = synthetic.write_result(self.folder)
        code, out = self.make("result.gif", "--result", result, "--width", "400")
        self.assertEqual(code, 0)
        self.assertGreater(os.path.getsize(out), 1000)

    def test_film_needs_ffmpeg(self):
        with mock.patch("otter_nav.animation.shutil.which", return_value=None):
            code, out = self.make("run.mp4", "--bag", self.bag)
        self.assertEqual(code, 1)
        self.assertFalse(os.path.exists(out))

    def with_encoder(self, script):
        """Runs with a program of that text in ffmpeg's place."""
        path = os.path.join(self.folder, "ffmpeg")
        with open(path, "w") as file:
            file.write("#!/bin/sh\n" + script)
        os.chmod(path, 0o755)
        with mock.patch("otter_nav.animation.shutil.which", return_value=path):
            return self.make("run.mp4", "--bag", self.bag, "--width", "400", "--rate", "2")

    def test_film_is_every_frame_whole_to_ffmpeg(self):
        code, out = self.with_encoder('for last; do :; done; cat > "$last"')
        self.assertEqual(code, 0)
        size = Film(read_bag(self.bag)[0], None, 400).background.size
        frames = len(frame_times(read_bag(self.bag)[0], 8.0, 2.0))
        self.assertEqual(os.path.getsize(out), frames * 3 * size[0] * size[1])
        self.assertEqual([side % 2 for side in size], [0, 0])

    def test_says_why_ffmpeg_failed(self):
        code, _ = self.with_encoder("echo no such codec >&2; exit 3")
        self.assertEqual(code, 1)

    def test_refuses_what_makes_no_film(self):
        for arguments in (["--speed", "0"], ["--speed", "nan"], ["--speed", "inf"], ["--speed", "0.001"],
                          ["--rate", "0"], ["--width", "3"]):
            code, out = self.make("run.gif", "--bag", self.bag, *arguments)
            self.assertEqual(code, 1, arguments)
        self.assertEqual(self.make("run.avi", "--bag", self.bag)[0], 1)


if __name__ == "__main__":
    unittest.main()
