"""The reference's heading and thrusts against the vessel's equations of motion."""
import unittest

import numpy

from otter_nav.trajectory import SAIL, SPIN, Trajectory, reference_at
from otter_nav.vessel import load_vessel

VESSEL = load_vessel("otter")


def trajectory(start, kinds, durations, x, y, heading=None, number=1):
    def rows(values):
        return numpy.array([list(v) + [0.0] * (8 - len(v)) for v in values], dtype=float)
    return Trajectory(number, start, numpy.array(kinds), numpy.array(durations, dtype=float), rows(x),
                      rows(y), rows(heading or [[0.0]] * len(kinds)))


class TrajectoryTest(unittest.TestCase):
    def test_sailing_piece_obeys_the_equations_of_motion(self):
        way = trajectory(5.0, [SAIL], [10.0], [[1, 1.5, 0.02, -0.004]], [[2, 0.2, 0.05, 0.002]])
        step, current = 1e-4, (0.2, -0.1)
        for t in (6.0, 9.0, 14.0):
            before, now, after = (way.sample([t + k * step], VESSEL, current) for k in (-1, 0, 1))
            u, v, r, psi = (getattr(now, name)[0] for name in ("u", "v", "r", "psi"))

            def rate(name):
                return (getattr(after, name)[0] - getattr(before, name)[0]) / (2 * step)
            self.assertAlmostEqual(rate("psi"), r, 6)
            self.assertAlmostEqual(rate("x"), u * numpy.cos(psi) - v * numpy.sin(psi), 6)
            cx = numpy.cos(psi) * current[0] + numpy.sin(psi) * current[1]
            cy = numpy.cos(psi) * current[1] - numpy.sin(psi) * current[0]
            left, right = now.thrust_left[0], now.thrust_right[0]
            self.assertAlmostEqual(VESSEL.m1_kg * (rate("u") - v * r),
                                   left + right - VESSEL.d1_kgps * (u - cx), 3)
            self.assertAlmostEqual(VESSEL.m1_kg * (rate("v") + u * r),
                                   -VESSEL.d2_kgps * (v - cy), 3)
            self.assertAlmostEqual(VESSEL.m2_kgm2 * rate("r"),
                                   VESSEL.lever_arm_m * (right - left) - VESSEL.d3_kgm2ps * r, 3)

    def test_at_rest_the_heading_is_its_limit_from_within(self):
        way = trajectory(0.0, [SAIL], [4.0], [[0, 0, 0, -0.1]], [[0, 0, 0, 0.1]])
        self.assertAlmostEqual(way.sample([0.0], VESSEL).psi[0], 0.75 * numpy.pi, 3)

    def test_spin_keeps_its_own_heading(self):
        way = trajectory(0.0, [SPIN, SAIL], [2.0, 2.0], [[3.0], [3.0, 1.0]], [[4.0], [4.0]],
                         [[0.5, 0.25], [0.0]])
        sample = way.sample([1.0, 3.0], VESSEL)
        self.assertAlmostEqual(sample.psi[0], 0.75)
        self.assertAlmostEqual(sample.r[0], 0.25)
        self.assertAlmostEqual(sample.course[0], 0.75)
        self.assertAlmostEqual(sample.psi[1], 0.0)
        self.assertAlmostEqual(sample.x[1], 4.0)

    def test_length_and_ends(self):
        way = trajectory(0.0, [SAIL], [5.0], [[0, 3.0]], [[0, 4.0]])
        self.assertAlmostEqual(way.length(), 25.0)
        self.assertAlmostEqual(way.sample([99.0], VESSEL).x[0], 15.0)

    def test_latest_that_has_begun_is_in_force_and_a_stop_order_ends_it(self):
        first = trajectory(0.0, [SAIL], [10.0], [[0, 1.0]], [[0.0]])
        second = trajectory(4.0, [SAIL], [10.0], [[4, 2.0]], [[0.0]], number=2)
        stop = trajectory(6.0, [], [], [], [], [], number=3)
        stop.x = stop.y = stop.heading = numpy.zeros((0, 8))
        reference = reference_at([first, second, stop], [-1.0, 2.0, 5.0, 7.0], VESSEL)
        numpy.testing.assert_allclose(reference.x, [numpy.nan, 2.0, 6.0, numpy.nan])
        numpy.testing.assert_array_equal(reference.part, [-1, 0, 1, 2])


if __name__ == "__main__":
    unittest.main()
