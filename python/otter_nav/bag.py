"""Bags into numpy arrays: read_bag(path) gives the runs a bag holds.

Topics are known by their type and last name, under any namespace. A bag holds several runs where
its time jumps back. The messages' own definitions in the bag are used, so that old bags stay
readable and the package need not be sourced.
"""
import contextlib
import os
import shutil
import tempfile

import numpy
import yaml

from .chart import Grid
from .errors import RecordingError
from .run import CONTACTS, MOTION, Event, Plan, Run, Scan
from .table import Table, table_of
from .trajectory import Trajectory
from .vessel import load_vessel, vessel_of

_JUMP_BACK_S = 1.0
PARTIAL_READS = "; --partial reads what is before"
# type -> {last name: what it is}; "*" takes any name.
_KINDS = {
    "otter_nav/PlantState": {"*": "truth"},
    "nav_msgs/Odometry": {"ground_truth": "ground_truth", "*": "odometry"},
    "otter_nav/ThrusterCommand": {"*": "command"},
    "otter_nav/TrackerStatus": {"*": "tracker"},
    "otter_nav/PlannerStatus": {"*": "planner"},
    "otter_nav/Trajectory": {"*": "trajectory"},
    "otter_nav/TrackerCycle": {"*": "cycle"},
    "otter_nav/ContactEvent": {"*": "contact"},
    "geometry_msgs/Vector3Stamped": {"wind": "wind", "current": "current"},
    "nav_msgs/OccupancyGrid": {"chart": "chart", "map": "map"},
    "sensor_msgs/LaserScan": {"*": "scan"},
    "tf2_msgs/TFMessage": {"tf_static": "tf_static"},
    "std_msgs/String": {"parameters": "parameters", "vessel": "vessel"},
}
_CYCLE = ("t", "number", "left", "right", "x_ref", "y_ref", "psi_ref", "u_ref", "v_ref", "r_ref", "x",
          "y", "psi", "u", "v", "r", "force_x", "force_y", "moment", "wind_x", "wind_y", "current_x",
          "current_y", "iterations")
_TRUTH = MOTION + ("thrust_left", "thrust_right", "clearance", "in_contact")


def read_bag(path, vessel="otter_gazebo", namespace=None, partial=False):
    """The runs in a bag, a list of run.Run in the order of recording.

    vessel      whose model gives the reference's heading and thrusts, where the bag does not say: a
                name or a file
    namespace   which vessel's topics, where the bag holds several ("/a"); "" for none
    partial     read what can be read of a bag that was cut off
    Raises RecordingError with what is missing.
    """
    vessel = load_vessel(vessel) if isinstance(vessel, (str, os.PathLike)) else vessel
    with open_bag(path, partial) as bag:
        return _read(bag, str(path), vessel, namespace, partial)


@contextlib.contextmanager
def open_bag(path, partial=False):
    """The rosbag.Bag of a file, whole or, if asked, what is there of one that was cut off."""
    rosbag = _rosbag()
    with tempfile.TemporaryDirectory() as folder:
        bag = _open(rosbag, str(path), partial, folder)
        try:
            yield bag
        finally:
            bag.close()


def read_one(path, number, vessel="otter_gazebo", namespace=None, partial=False):
    """Run `number` of a bag, from 1, and how many it holds."""
    runs = read_bag(path, vessel, namespace, partial)
    if not 1 <= number <= len(runs):
        raise RecordingError(f"{path}: holds {len(runs)} runs, none with number {number}")
    return runs[number - 1], len(runs)


def _rosbag():
    try:
        import rosbag
    except ImportError as error:
        raise RecordingError("reading bags needs python3-rosbag") from error
    return rosbag


def _open(rosbag, path, partial, folder):
    if not os.path.isfile(path):
        raise RecordingError(f"{path}: no such file")
    if os.path.getsize(path) == 0:
        raise RecordingError(f"{path}: is empty (0 bytes)")
    try:
        return rosbag.Bag(path)
    except rosbag.ROSBagUnindexedException as error:
        if not partial:
            raise RecordingError(f"{path}: has no index, its recording was cut off; `rosbag reindex` "
                                 "mends it, --partial reads what is there") from error
    except Exception as error:  # rosbag raises many kinds for what is no bag
        raise RecordingError(f"{path}: is not a ROS bag, or damaged: {error}") from error
    copy = os.path.join(folder, "partial.bag")
    shutil.copy(path, copy)
    try:
        with rosbag.Bag(copy, "a", allow_unindexed=True) as bag:
            for _ in bag.reindex():
                pass
        return rosbag.Bag(copy)
    except Exception as error:
        raise RecordingError(f"{path}: nothing could be read of what was cut off: {error}") from error


def _kind(datatype, topic):
    names = _KINDS.get(datatype, {})
    last = topic.rsplit("/", 1)[-1]
    return names.get(last, names.get("*"))


def vessel_topics(connections, namespace, path):
    """{topic: kind} of the one vessel that is wanted, and its namespace."""
    found = {}
    for connection in connections:
        kind = _kind(connection.datatype, connection.topic)
        if kind is not None:
            # A node's parameters are its own.
            prefix = connection.topic.rsplit("/", 2 if kind == "parameters" else 1)[0]
            found.setdefault(prefix, {})[connection.topic] = kind
    with_motion = [prefix for prefix, topics in found.items()
                   if {"truth", "odometry", "ground_truth"} & set(topics.values())]
    if namespace is not None:
        namespace = "/" + namespace.strip("/") if namespace.strip("/") else ""
        with_motion = [prefix for prefix in with_motion if prefix == namespace]
    if not with_motion:
        inside = ", ".join(sorted({f"{c.topic} ({c.datatype})" for c in connections})[:12])
        where = "" if namespace is None else f" under '{namespace}'"
        raise RecordingError(f"{path}: no motion{where}: neither otter_nav/PlantState nor "
                             f"nav_msgs/Odometry; it holds {inside or 'no topics'}")
    if len(with_motion) > 1:
        raise RecordingError(f"{path}: holds several vessels; choose one by its namespace: "
                             + ", ".join(repr(prefix) for prefix in sorted(with_motion)))
    topics = dict(found[with_motion[0]])
    # A chart or the weather may be shared by all vessels.
    for topic, kind in found.get("", {}).items():
        if kind in ("chart", "map", "wind", "current", "tf_static") and kind not in topics.values():
            topics[topic] = kind
    # One topic a kind: the usual name first.
    usual = {"odometry": "odom", "truth": "plant_state", "command": "thruster_command"}
    for kind in set(topics.values()) - {"parameters"}:
        same = sorted(topic for topic, k in topics.items() if k == kind)
        if len(same) > 1:
            keep = next((t for t in same if t.rsplit("/", 1)[-1] == usual.get(kind)), same[0])
            for topic in same:
                if topic != keep:
                    del topics[topic]
    return topics, with_motion[0]


def _records(bag, topics, raw):
    """(topic, message, time of receipt) in the order of recording, not of stamps: only so does a
    clock that was set back show."""
    try:
        connections = list(bag._get_connections(list(topics)))
        entries = sorted(bag._get_entries(connections), key=lambda e: (e.chunk_pos, e.offset))
        read = bag._reader.seek_and_read_message_data_record
        records = (read((entry.chunk_pos, entry.offset), raw) for entry in entries)
    except AttributeError:  # another version of rosbag or of its format
        records = bag.read_messages(topics=list(topics), raw=raw)
    for record in records:
        yield record[0], record[1], record[2]


def damaged(path, received, error, advice=""):
    """What to raise where a bag's messages break off, by the time of the last one in s."""
    return RecordingError(f"{path}: damaged after {received:.3f} s: {error}{advice}")


def raw_messages(bag, topics):
    """As _records(); a message is (type, bytes, md5sum, place, class)."""
    return _records(bag, topics, True)


def _messages(bag, topics):
    for topic, message, t in _records(bag, topics, False):
        yield topic, message, t.to_sec()


def _read(bag, path, vessel, namespace, partial):
    connections = list(bag._get_connections())
    if bag.get_message_count() == 0:
        raise RecordingError(f"{path}: holds no messages")
    topics, _ = vessel_topics(connections, namespace, path)
    readers, texts = [_RunReader()], {}
    received, stamps = -numpy.inf, {}
    try:
        for topic, message, t in _messages(bag, topics):
            kind = topics[topic]
            stamp = message.header.stamp.to_sec() if kind in ("truth", "odometry") else None
            if t < received - _JUMP_BACK_S or (
                    stamp is not None and stamp < stamps.get(topic, -numpy.inf) - _JUMP_BACK_S):
                readers.append(_RunReader(readers[-1].mounts))
                readers[-1].texts = dict(texts)
                stamps = {}
            received = t
            if stamp is not None:
                stamps[topic] = stamp
            if kind in ("parameters", "vessel"):
                node = topic.rsplit("/", 2)[-2] if kind == "parameters" else "vessel"
                if kind == "parameters":
                    readers[-1].take_parameters(node, texts.get(node), message.data, t)
                texts[node] = message.data
                readers[-1].texts = dict(texts)
            else:
                readers[-1].take(kind, message, t)
    except Exception as error:
        if not partial:
            raise damaged(path, received, error, PARTIAL_READS) from error
    readers = [reader for reader in readers if reader.moved()]
    if not readers:
        raise RecordingError(f"{path}: its topics of motion hold no messages")
    grids = [reader.chart for reader in readers if reader.chart is not None]
    runs = []
    for number, reader in enumerate(readers, 1):
        run = reader.finish(_vessel_in(reader.texts, path) or vessel)
        run.source = path
        run.chart = run.chart or (grids[0] if grids else None)
        run.details.update({"bag": os.path.basename(path), "bag size": f"{bag.size / 1e6:.1f} MB",
                            "run": f"{number} of {len(readers)}",
                            "topics": ", ".join(sorted(topics)),
                            "trajectory message": next((c.md5sum for c in connections
                                                        if topics.get(c.topic) == "trajectory"), "none")})
        runs.append(run)
    return runs


def _vessel_in(texts, path):
    if "vessel" not in texts:
        return None
    try:
        return vessel_of(yaml.safe_load(texts["vessel"]), path)
    except yaml.YAMLError as error:
        raise RecordingError(f"{path}: its vessel is no YAML: {error}") from error


def _label(texts):
    """What the plant was told, as missions label their results."""
    try:
        told = yaml.safe_load(texts["plant_node"])
        label = {key: told[key] for key in ("vessel", "disturbance", "seed")}
        if told["scenario"]:
            label["scenario"] = os.path.splitext(os.path.basename(told["scenario"]))[0]
            label["mission"] = told["mission"]
        return label
    except (KeyError, TypeError, yaml.YAMLError):
        return {}


class _RunReader:
    """Gathers the messages of one run."""

    def __init__(self, mounts=()):
        self.rows = {kind: [] for kind in ("truth", "odometry", "ground_truth", "command", "contact",
                                           "wind", "current")}
        self.status = {"tracker": [], "planner": []}
        self.trajectories = []
        self.scans = []
        self.mounts = dict(mounts)  # of sensors on the vessel, by their frames
        self.chart = None
        self.chart_kind = ""
        self.cycles = []
        self.texts = {}
        self.changed = []

    def moved(self):
        return any(len(self.rows[kind]) > 1 for kind in ("truth", "odometry", "ground_truth"))

    def take(self, kind, m, received):
        if kind in ("tracker", "planner"):
            self.status[kind].append(m)
        elif kind == "trajectory":
            self._take_trajectory(m, received)
        elif kind in ("chart", "map"):
            if self.chart is None or (kind == "chart" and self.chart_kind == "map"):
                self.chart, self.chart_kind = Grid.from_message(m), kind
        elif kind == "cycle":
            if m.cycle > 0 and (not self.cycles or m.time > self.cycles[-1][0]):
                self.cycles.append((m.time, m.cycle, m.left, m.right, *m.reference, *m.estimate,
                                    *m.disturbance, *m.wind, *m.current, m.solver_iterations))
        elif kind == "tf_static":
            for transform in m.transforms:
                place = transform.transform.translation
                self.mounts[transform.child_frame_id] = place.x, place.y
        elif kind == "scan":
            mount = self.mounts.get(m.header.frame_id, (0.0, 0.0))
            self.scans.append(Scan(m.header.stamp.to_sec(), mount, m.angle_min, m.angle_increment,
                                   m.range_max,
                                   numpy.array(m.ranges, dtype=numpy.float32)))
        else:
            t = m.header.stamp.to_sec()
            rows = self.rows[kind]
            if not rows or kind == "contact" or t > rows[-1][0]:
                rows.append(_ROWS[kind](t, m))

    def take_parameters(self, node, before, now, t):
        """What was set while the node ran: the same keys with other values."""
        old, new = (_leaves(yaml.safe_load(text)) if text else {} for text in (before, now))
        if not self.moved() or old.keys() != new.keys():
            return
        self.changed += [Event(t, node, f"{key}: {old[key]} → {new[key]}") for key in new
                              if new[key] != old[key]]

    def _take_trajectory(self, m, received):
        start = m.header.stamp.to_sec()
        if self.trajectories and self.trajectories[-1].id == m.id and \
                self.trajectories[-1].start == start:
            return  # latched, and heard again
        n = len(m.pieces)

        def stack(name):
            return numpy.array([getattr(p, name) for p in m.pieces], dtype=float).reshape(n, 8)
        q = m.goal.orientation
        self.trajectories.append(Trajectory(
            id=m.id, start=start, published=received,
            kinds=numpy.array([p.kind for p in m.pieces], dtype=int),
            durations=numpy.array([p.duration for p in m.pieces], dtype=float),
            x=stack("x"), y=stack("y"), heading=stack("heading"),
            goal=(m.goal.position.x, m.goal.position.y, 2.0 * numpy.arctan2(q.z, q.w))))

    def finish(self, vessel):
        run = Run(vessel=vessel, trajectories=self.trajectories, scans=self.scans, chart=self.chart)
        run.truth = table_of(_TRUTH, self.rows["truth"])
        if not len(run.truth):
            run.truth = _level(self.rows["ground_truth"])
        run.odometry = _level(self.rows["odometry"])
        run.commands = table_of(("t", "left", "right"), self.rows["command"])
        run.contacts = table_of(CONTACTS, self.rows["contact"])
        run.wind = table_of(("t", "x", "y"), self.rows["wind"])
        run.current = table_of(("t", "x", "y"), self.rows["current"])
        run.tracker = _numbers(self.status["tracker"])
        run.planner = _numbers(self.status["planner"])
        run.planner_states = _changes(self.status["planner"])
        run.tracker_states = _changes(self.status["tracker"])
        run.plans = _plans(self.status["planner"])
        run.events = sorted(_events(run, self.status["tracker"]) + self.changed,
                            key=lambda event: event.t)
        run.cycles = table_of(_CYCLE, self.cycles)
        run.label = _label(self.texts)
        run.vessel_is_recorded = "vessel" in self.texts
        parameters = [f"{node}:\n" + "".join(f"  {line}\n" for line in text.splitlines())
                      for node, text in sorted(self.texts.items()) if node != "vessel"]
        if parameters:
            run.details["parameters"] = "".join(parameters)
        return run


def _truth_row(t, m):
    return (t, m.x, m.y, m.yaw, m.u, m.v, m.r, m.thrust_left, m.thrust_right, m.clearance,
            m.in_contact)


def _odometry_row(t, m):
    p, q = m.pose.pose.position, m.pose.pose.orientation
    v, w = m.twist.twist.linear, m.twist.twist.angular
    return (t, p.x, p.y, q.x, q.y, q.z, q.w, v.x, v.y, v.z, w.x, w.y, w.z)


def _vector_row(t, m):
    return (t, m.vector.x, m.vector.y)


_ROWS = {
    "truth": _truth_row,
    "odometry": _odometry_row,
    "ground_truth": _odometry_row,
    "command": lambda t, m: (t, m.left, m.right),
    "contact": lambda t, m: (t, m.in_contact, m.position.x, m.position.y, m.speed),
    "wind": _vector_row,
    "current": _vector_row,
}


def _level(rows):
    """Odometry as planar motion: the twist, which is in the body's axes, turned level."""
    a = numpy.array(rows, dtype=float).reshape(len(rows), 13)
    t, x, y, qx, qy, qz, qw = (a[:, k] for k in range(7))
    psi = numpy.arctan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
    pitch = numpy.arcsin(numpy.clip(2 * (qw * qy - qz * qx), -1, 1))
    roll = numpy.arctan2(2 * (qw * qx + qy * qz), 1 - 2 * (qx * qx + qy * qy))
    cr, sr, cp, sp = numpy.cos(roll), numpy.sin(roll), numpy.cos(pitch), numpy.sin(pitch)

    def turned(v):
        return (cp * v[:, 0] + sp * (sr * v[:, 1] + cr * v[:, 2]), cr * v[:, 1] - sr * v[:, 2],
                -sp * v[:, 0] + cp * (sr * v[:, 1] + cr * v[:, 2]))
    u, v, _ = turned(a[:, 7:10])
    _, _, r = turned(a[:, 10:13])
    return Table(t=t, x=x, y=y, psi=psi, u=u, v=v, r=r)


def _numbers(messages):
    """Every number of a status by its name; the tracker's disturbance as three."""
    if not messages:
        return table_of(("t",), [])
    first = messages[0]
    names = [name for name in first.__slots__
             if isinstance(getattr(first, name), (int, float, bool))]
    columns = {"t": [m.header.stamp.to_sec() for m in messages]}
    columns.update({name: [float(getattr(m, name)) for m in messages] for name in names})
    if hasattr(first, "disturbance"):
        for k, name in enumerate(("force_x", "force_y", "moment")):
            columns[name] = [m.disturbance[k] for m in messages]
    return Table(**columns)


def _leaves(tree, path=""):
    if not isinstance(tree, dict):
        return {path: tree}
    return {key: value for name, inner in tree.items()
            for key, value in _leaves(inner, f"{path}.{name}" if path else str(name)).items()}


def _changes(messages):
    changes = []
    for m in messages:
        if not changes or m.state != changes[-1][1]:
            changes.append((m.header.stamp.to_sec(), m.state, m.reason))
    return changes


def _plans(messages):
    plans, known = [], 0
    for m in messages:
        if m.plans != known:
            known = m.plans
            plans.append(Plan(m.header.stamp.to_sec(), m.plans, m.outcome, m.length, m.duration,
                              m.cost, m.samples, m.nodes, m.first_solution_ms, m.planning_ms))
    return plans


def _events(run, tracker_messages):
    events = []
    for source, changes in (("planner", run.planner_states), ("tracker", run.tracker_states)):
        for k, (t, state, reason) in enumerate(changes):
            was = f"{changes[k - 1][1]} → " if k else ""
            events.append(Event(t, source, was + state + (f": {reason}" if reason else "")))
    for trajectory in run.trajectories:
        text = (f"trajectory {trajectory.id}: an order to stop" if trajectory.empty else
                f"trajectory {trajectory.id}: {trajectory.length():.1f} m in "
                f"{trajectory.duration:.1f} s")
        events.append(Event(trajectory.start, "planner", text))
    refused = 0
    for m in tracker_messages:
        if m.refused_id != refused:
            refused = m.refused_id
            events.append(Event(m.header.stamp.to_sec(), "tracker",
                                f"refused trajectory {refused}: {m.refused_reason}"))
    for k in range(len(run.contacts)):
        began = run.contacts.in_contact[k] > 0
        events.append(Event(float(run.contacts.t[k]), "plant",
                            f"contact {'begins' if began else 'ends'} at "
                            f"{run.contacts.speed[k]:.2f} m/s"))
    return sorted(events, key=lambda event: event.t)
