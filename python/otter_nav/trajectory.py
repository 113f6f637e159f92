"""Planned trajectories and where they have the vessel be (docs/model.md, "Flatness")."""
from dataclasses import dataclass

import numpy

from .table import Table

SAIL, SPIN = 0, 1
_SINGULAR_FORCE_N = 0.05  # below, the force says nothing of the heading
_AT_REST_MPS = 1e-4


@dataclass
class Trajectory:
    """Pieces of polynomials: coefficient k belongs to t^k, t in s from the piece's start."""
    id: int
    start: float               # s, when it begins
    kinds: numpy.ndarray       # SAIL or SPIN, (n)
    durations: numpy.ndarray   # s, (n)
    x: numpy.ndarray           # (n, 8)
    y: numpy.ndarray
    heading: numpy.ndarray     # rad, of spins
    goal: tuple = (numpy.nan, numpy.nan, numpy.nan)  # x m, y m, psi rad
    published: float = numpy.nan                     # s, when it was received

    @property
    def empty(self):
        """Without pieces it is an order to stop."""
        return len(self.durations) == 0

    @property
    def duration(self):
        return float(numpy.sum(self.durations))

    def length(self, step_s=0.02):
        """m along the way."""
        if self.empty:
            return 0.0
        t = numpy.linspace(0.0, self.duration, max(2, int(self.duration / step_s) + 1))
        flat = self._flat(t)
        speed = numpy.hypot(flat[1, 0], flat[1, 1])
        return float(numpy.sum(0.5 * (speed[1:] + speed[:-1]) * numpy.diff(t)))

    def sample(self, times, vessel, current=(0.0, 0.0)):
        """States and thrusts at `times` (s, clamped to the trajectory); `current` m/s, map frame.

        The heading of sailing pieces follows from the vessel's paper model, as do the thrusts.
        `course` is the direction of travel; at rest, the heading.
        """
        times = numpy.asarray(times, dtype=float)
        t = numpy.clip(times - self.start, 0.0, self.duration)
        p, v, a, j, s = self._flat(t)
        c = numpy.array(current, dtype=float)[:, None]
        psi, r, r_dot = self._sail_heading(t, v, a, j, s, vessel, c)
        piece, tau = self._locate(t)
        spins = self.kinds[piece] == SPIN
        if numpy.any(spins):
            turn = _derivatives(self.heading[piece], tau, 2)
            psi, r, r_dot = (numpy.where(spins, turn[k], value)
                             for k, value in enumerate((psi, r, r_dot)))
        e = numpy.array([numpy.cos(psi), numpy.sin(psi)])
        surge_n = vessel.m1_kg * _dot(e, a) + vessel.d1_kgps * _dot(e, v - c)
        yaw_nm = vessel.m2_kgm2 * r_dot + vessel.d3_kgm2ps * r
        speed = numpy.hypot(v[0], v[1])
        course = numpy.where(speed > 0.02, numpy.arctan2(v[1], v[0]), psi)
        turn_n = yaw_nm / vessel.lever_arm_m
        return Table(t=times, x=p[0], y=p[1], psi=psi, u=_dot(e, v), v=_cross(e, v), r=r,
                     speed=speed, course=course, thrust_left=0.5 * (surge_n - turn_n),
                     thrust_right=0.5 * (surge_n + turn_n))

    def _locate(self, t):
        starts = numpy.concatenate([[0.0], numpy.cumsum(self.durations)])
        piece = numpy.clip(numpy.searchsorted(starts, t, side="right") - 1, 0,
                           len(self.durations) - 1)
        return piece, t - starts[piece]

    def _flat(self, t):
        """Position and its derivatives up to the fourth, (5, 2, len(t))."""
        piece, tau = self._locate(t)
        return numpy.stack([_derivatives(self.x[piece], tau, 4),
                            _derivatives(self.y[piece], tau, 4)], axis=1)

    def _sail_heading(self, t, v, a, j, s, vessel, current):
        water = v - current
        w = vessel.m1_kg * a + vessel.d2_kgps * water
        w1 = vessel.m1_kg * j + vessel.d2_kgps * a
        w2 = vessel.m1_kg * s + vessel.d2_kgps * j
        norm2 = _dot(w, w)
        # The bow is on the side of the course through the water; at rest, of its limit from within.
        piece, tau = self._locate(t)
        inward = numpy.minimum(1e-2, 0.25 * self.durations[piece])
        inside = t + numpy.where(tau < 0.5 * self.durations[piece], inward, -inward)
        ahead = numpy.where(_dot(water, water) > _AT_REST_MPS**2, water,
                            self._flat(inside)[1] - current)
        regular = norm2 > _SINGULAR_FORCE_N**2
        safe2 = numpy.where(regular, norm2, 1.0)
        bow = numpy.where(regular, numpy.where(_dot(w, ahead) >= 0.0, w, -w), ahead)
        r = numpy.where(regular, _cross(w, w1) / safe2, 0.0)
        r_dot = numpy.where(regular, (_cross(w, w2) - 2.0 * r * _dot(w, w1)) / safe2, 0.0)
        return numpy.arctan2(bow[1], bow[0]), r, r_dot


def reference_at(trajectories, times, vessel):
    """The reference at `times`: on the latest trajectory that has begun by then.

    Not a number where there is none, or where it is an order to stop. `part` is the trajectory's
    place in the list, -1 for none.
    """
    times = numpy.asarray(times, dtype=float)
    chosen = numpy.full(len(times), -1)
    for k, trajectory in enumerate(trajectories):
        chosen[times >= trajectory.start] = k
    names = ("x", "y", "psi", "u", "v", "r", "speed", "course", "thrust_left", "thrust_right")
    columns = {name: numpy.full(len(times), numpy.nan) for name in names}
    for k, trajectory in enumerate(trajectories):
        mask = chosen == k
        if numpy.any(mask) and not trajectory.empty:
            sample = trajectory.sample(times[mask], vessel)
            for name in names:
                columns[name][mask] = getattr(sample, name)
    return Table(t=times, **columns, part=chosen)


def _derivatives(coefficients, t, highest):
    """A polynomial and its derivatives up to the highest; one row of coefficients a time."""
    values = []
    c = coefficients
    for _ in range(highest + 1):
        value = numpy.zeros(len(t))
        for k in range(c.shape[1] - 1, -1, -1):
            value = value * t + c[:, k]
        values.append(value)
        c = c[:, 1:] * numpy.arange(1, c.shape[1])
    return numpy.stack(values)


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def _cross(a, b):
    return a[0] * b[1] - a[1] * b[0]
