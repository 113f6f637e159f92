"""One recorded run: what happened, what should have, and the figures of it."""
from dataclasses import dataclass, field

import numpy

from .table import Table, table_of, wrap
from .trajectory import reference_at

MOTION = ("t", "x", "y", "psi", "u", "v", "r")
COMMANDS = ("t", "left", "right")
CONTACTS = ("t", "in_contact", "x", "y", "speed")


@dataclass
class Event:
    t: float      # s
    source: str   # planner, tracker, plant; a node whose parameters were set
    text: str


@dataclass
class Scan:
    """What the lidar saw, rays from its mount counted from the vessel's heading."""
    t: float
    mount: tuple            # m ahead and to port of base_link
    angle_min: float
    angle_increment: float
    range_max: float
    ranges: numpy.ndarray   # m; infinite: nothing as far as it reaches


@dataclass
class Plan:
    """Figures of one plan as the planner gave them."""
    t: float
    number: int
    outcome: str
    length_m: float
    duration_s: float
    cost: float
    samples: int
    nodes: int
    first_solution_ms: float
    planning_ms: float


@dataclass
class Run:
    """Times are in s on the recording's clock. Tables without data are empty, never None.

    truth       plant_state: t x y psi u v r thrust_left thrust_right clearance in_contact
    odometry    t x y psi u v r (level axes)
    commands    thruster_command: t left right, N
    tracker     tracker_status: numbers of the message by their names, and force_x force_y moment
    planner     planner_status: numbers of the message by their names
    cycles      tracker_cycle: t number left right, the reference (x_ref ... r_ref), the estimate (x y
                psi u v r), what it estimates pushes (force_x force_y moment, wind's included), wind_x
                wind_y current_x current_y, iterations
    contacts    t in_contact x y speed
    wind, current   t x y, m/s towards
    """
    vessel: object
    source: str = ""
    truth: Table = field(default_factory=lambda: table_of(MOTION, []))
    odometry: Table = field(default_factory=lambda: table_of(MOTION, []))
    commands: Table = field(default_factory=lambda: table_of(COMMANDS, []))
    tracker: Table = field(default_factory=lambda: table_of(("t",), []))
    planner: Table = field(default_factory=lambda: table_of(("t",), []))
    cycles: Table = field(default_factory=lambda: table_of(("t",), []))
    contacts: Table = field(default_factory=lambda: table_of(CONTACTS, []))
    wind: Table = field(default_factory=lambda: table_of(("t", "x", "y"), []))
    current: Table = field(default_factory=lambda: table_of(("t", "x", "y"), []))
    trajectories: list = field(default_factory=list)
    scans: list = field(default_factory=list)
    plans: list = field(default_factory=list)
    events: list = field(default_factory=list)
    # (t, state, reason) at each change.
    planner_states: list = field(default_factory=list)
    tracker_states: list = field(default_factory=list)
    chart: object = None           # chart.Grid, if one was recorded
    label: dict = field(default_factory=dict)   # scenario, mission, vessel, ... where known
    stated: dict = field(default_factory=dict)  # figures of the mission's own result, where known
    details: dict = field(default_factory=dict)  # versions, sizes, parameters
    vessel_is_recorded: bool = False
    recorded_reference: Table = None  # of a track file, instead of trajectories

    def __post_init__(self):
        self._reference = None

    @property
    def motion(self):
        """The true motion; of a real vessel, its odometry."""
        return self.truth if len(self.truth) else self.odometry

    @property
    def motion_is_true(self):
        return len(self.truth) > 0

    @property
    def reference(self):
        """Where the vessel should have been at each time of `motion`; not a number without one."""
        if self._reference is None:
            self._reference = (self.recorded_reference if self.recorded_reference is not None else
                               reference_at(self.trajectories, self.motion.t, self.vessel))
        return self._reference

    @property
    def error(self):
        """From the reference to the vessel: t, distance, along and cross (to port) of the way, m;
        heading, rad."""
        motion, reference = self.motion, self.reference
        dx, dy = motion.x - reference.x, motion.y - reference.y
        c, s = numpy.cos(reference.course), numpy.sin(reference.course)
        return Table(t=motion.t, distance=numpy.hypot(dx, dy), along=c * dx + s * dy,
                     cross=c * dy - s * dx, heading=wrap(motion.psi - reference.psi))

    @property
    def thrusts(self):
        """What was asked of the thrusters; without commands, what acted. t left right, N."""
        if len(self.commands):
            return self.commands
        if len(self.truth) and "thrust_left" in self.truth.columns:
            return Table(t=self.truth.t, left=self.truth.thrust_left, right=self.truth.thrust_right)
        return self.commands

    @property
    def saturated(self):
        """Whether a thruster stands at its limit, for each row of `thrusts`."""
        return self.at_limit(self.thrusts.left) | self.at_limit(self.thrusts.right)

    def at_limit(self, thrust):
        """The tracker's solver stays a little inside the limits: within 0.5 % is at them."""
        share = 0.995
        return ((thrust >= share * self.vessel.ahead_max_n) |
                (thrust <= -share * self.vessel.astern_max_n))

    @property
    def window(self):
        """(from, to) in s: the first trajectory's start to arrival, or to where the mission failed,
        the hull touched something or the recording ends, as missions count themselves. Without a
        trajectory, all of the motion."""
        motion = self.motion
        if not len(motion):
            return (numpy.nan, numpy.nan)
        begin, end = motion.t[0], motion.t[-1]
        if self.recorded_reference is not None:
            there = numpy.isfinite(self.recorded_reference.x)
            if numpy.any(there):
                begin = motion.t[numpy.argmax(there)]
        starts = [t.start for t in self.trajectories if not t.empty]
        if starts:
            begin = max(begin, min(starts))
        over = [t for t, state, _ in self.planner_states
                if state in ("arrived", "failed") and t >= begin]
        over += [t for t, on in zip(self.contacts.t, self.contacts.in_contact) if on > 0 and t >= begin]
        return (float(begin), float(min([end] + over)))

    @property
    def outcome(self):
        """arrived, stopped, collided, ...; empty if the recording does not say."""
        if "outcome" in self.stated:
            return self.stated["outcome"]
        begin, end = self.window
        contact = self.contacts
        if len(contact) and numpy.any((contact.in_contact > 0) & (contact.t <= end + 1e-9)):
            return "collided"
        for t, state, _ in self.planner_states:
            if t >= begin and state in ("arrived", "failed"):
                return "arrived" if state == "arrived" else "stopped"
        return ""

    @property
    def reason(self):
        if "reason" in self.stated:
            return self.stated["reason"]
        begin, _ = self.window
        for t, state, reason in self.planner_states:
            if t >= begin and state in ("arrived", "failed"):
                return "" if state == "arrived" else reason
        return ""

    def figures(self):
        """Plain numbers over `window`; None where the recording has nothing to say."""
        begin, end = self.window
        motion, error = self.motion, self.error
        inside = _between(motion.t, begin, end)
        known = inside & numpy.isfinite(error.distance)
        until = motion.t <= end + 1e-9
        speed = numpy.hypot(motion.u, motion.v)[inside]
        thrusts = self.thrusts
        acting = _between(thrusts.t, begin, end)
        squares = 0.5 * (thrusts.left**2 + thrusts.right**2)[acting]
        figures = {
            "outcome": self.outcome or None,
            "position_source": "true" if self.motion_is_true else "odometry",
            "window_from_s": begin,
            "window_to_s": end,
            "duration_s": end - begin,
            "mission_duration_s": float(end - motion.t[0]) if len(motion) else None,
            "distance_m": _distance(motion, until),
            "tracking_error_mean_m": _mean(error.distance[known]),
            "tracking_error_max_m": _max(error.distance[known]),
            "tracking_error_rms_m": _rms(error.distance[known]),
            "along_error_rms_m": _rms(error.along[known]),
            "cross_error_rms_m": _rms(error.cross[known]),
            "cross_error_max_m": _max(numpy.abs(error.cross[known])),
            "heading_error_rms_rad": _rms(error.heading[known]),
            "speed_mean_mps": _mean(speed),
            "speed_max_mps": _max(speed),
            "thrust_rms_n": float(numpy.sqrt(numpy.mean(squares))) if len(squares) else None,
            "thrust_saturated_share": _mean(self.saturated[acting].astype(float)),
            "min_clearance_m": self._min_clearance(until),
            "contacts": int(numpy.sum(self.contacts.in_contact > 0)),
        }
        figures.update(self._planning_figures(end))
        # The mission's own figures were taken at every control step: they stand where known.
        for key, value in self.stated.items():
            if key in figures and key not in ("outcome", "duration_s"):
                figures[key] = value
        if "duration_s" in self.stated:
            figures["mission_duration_s"] = self.stated["duration_s"]
        return figures

    def _min_clearance(self, until):
        if "clearance" not in self.motion.columns or not numpy.any(until):
            return None
        return float(numpy.min(self.motion.clearance[until]))

    def _planning_figures(self, end):
        planned = [plan.planning_ms for plan in self.plans if plan.t <= end + 1e-9]
        figures = {"plans": len(planned) or None, "replans": None, "planning_ms_median": None,
                   "planning_ms_max": None, "tracker_ms_median": None, "tracker_ms_p99": None,
                   "cycles_on_time": None}
        if planned:
            figures["planning_ms_median"] = nearest_rank(planned, 0.5)
            figures["planning_ms_max"] = float(max(planned))
        before = self.planner.where(self.planner.t <= end + 1e-9)
        if len(before) and "replans" in before.columns:
            figures["replans"] = int(before.replans[-1])
        before = self.tracker.where(self.tracker.t <= end + 1e-9)
        if len(before) and "solver_ms_p99" in before.columns:
            figures["tracker_ms_median"] = float(before.solver_ms_median[-1])
            figures["tracker_ms_p99"] = float(before.solver_ms_p99[-1])
            figures["cycles_on_time"] = float(before.cycles_on_time[-1])
        for key in ("replans", "planning_ms_median", "planning_ms_max", "tracker_ms_p99"):
            if key in self.stated:
                figures[key] = self.stated[key]
        return figures


def nearest_rank(values, share):
    """The value below which `share` of the values lie (nearest rank)."""
    ordered = numpy.sort(numpy.asarray(values, dtype=float))
    rank = int(numpy.clip(numpy.ceil(share * len(ordered)), 1, len(ordered)))
    return float(ordered[rank - 1])


def _between(t, begin, end):
    return (t >= begin - 1e-9) & (t <= end + 1e-9)


def _mean(values):
    return float(numpy.mean(values)) if len(values) else None


def _max(values):
    return float(numpy.max(values)) if len(values) else None


def _rms(values):
    return float(numpy.sqrt(numpy.mean(values**2))) if len(values) else None


def _distance(motion, mask):
    if not numpy.any(mask):
        return None
    return float(numpy.sum(numpy.hypot(numpy.diff(motion.x[mask]), numpy.diff(motion.y[mask]))))
