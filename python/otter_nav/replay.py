"""The program `replay_bag`: a recorded run on the topics it came from, for rviz. Commands nothing.

What rviz shows and a bag lacks is made from what it has: the hull's place in tf and the trail from
odometry, the sensed map from the chart, the path from the trajectories.
"""
import argparse
import bisect
import struct
import sys
import time

import numpy

from .bag import PARTIAL_READS, damaged, open_bag, raw_messages, vessel_topics
from .errors import RecordingError
from .vessel import share_folder

# A vessel, its tracker or its planner that runs meanwhile shall not take these for its own.
_ORDERS = {"trajectory", "goal", "cancel", "initialpose", "lockstep_ack",
           "recording", "clock"}
_CLOCK_S = 0.01      # between two messages of /clock, of the recording's time
_TRAIL_M = 0.3       # between two points of a trail made here
_JUMP_BACK_S = 1.0


class Topic:
    """Where the messages of one connection go."""

    def __init__(self, connection, name):
        self.name = name
        self.type = connection.datatype
        self.latched = connection.header.get("latching") in ("1", b"1")


def target(topic, prefix):
    """The name without the vessel's namespace; None for what is an order. Thrusts are shown by rviz,
    but under a name that no vessel takes them from."""
    inside = topic[len(prefix):] if prefix and topic.startswith(prefix + "/") else topic
    last = inside.rsplit("/", 1)[-1]
    if last == "thruster_command":
        return "/replayed" + inside
    return None if last in _ORDERS or inside.startswith("/move_base") else inside


class Recorded:
    """The messages of a bag in the order of recording, cut into runs where time jumps back."""

    def __init__(self, bag, path, namespace, partial=False):
        self.bag = bag
        connections = list(bag._get_connections())
        self.kinds, self.prefix = vessel_topics(connections, namespace, path)
        self.topics, self.pytypes = {}, {}
        for connection in connections:
            name = target(connection.topic, self.prefix)
            if name is not None and self._mine(connection.topic):
                self.topics[connection.topic] = Topic(connection, name)
        motion = [t for t, kind in self.kinds.items() if kind in ("odometry", "truth",
                                                                  "ground_truth")]
        every = sorted(set(self.topics) | set(motion) |
                       {t for t, kind in self.kinds.items() if kind == "trajectory"})
        self.runs = [[]]
        last, received = {}, -numpy.inf
        try:
            for topic, (_, data, _, _, pytype), t in raw_messages(bag, every):
                self.pytypes[topic] = pytype
                t = t.to_sec()
                stamp = _stamp(data) if topic in motion else None
                if t < received - _JUMP_BACK_S or (
                        stamp is not None and stamp < last.get(topic, stamp) - _JUMP_BACK_S):
                    self.runs.append(self._take_latched_tail(self.runs[-1], motion))
                    last = {}
                received = t
                if stamp is not None:
                    last[topic] = stamp
                self.runs[-1].append((t, topic, data))
        except Exception as error:  # as many kinds as there are of damage
            if not partial:
                raise damaged(path, received, error, PARTIAL_READS) from error
        self.runs = [run for run in self.runs if any(m[1] in motion for m in run)]

    def _take_latched_tail(self, run, motion):
        """A new run's nodes may have latched messages before its clock runs: after the old motion."""
        begin = len(run)
        while begin > 0 and run[begin - 1][1] not in motion:
            begin -= 1
        tail = run[begin:]
        latched = [m[1] in self.topics and self.topics[m[1]].latched for m in tail]
        run[begin:] = [m for m, is_latched in zip(tail, latched) if not is_latched]
        return [m for m, is_latched in zip(tail, latched) if is_latched]

    def _mine(self, topic):
        """Below the vessel's namespace, or everybody's at the root."""
        return (not self.prefix or topic in self.kinds or topic.startswith(self.prefix + "/") or
                topic.count("/") == 1)


def _stamp(data):
    """Of a message that begins with a header."""
    _, seconds, nanoseconds = struct.unpack_from("<III", data)
    return seconds + 1e-9 * nanoseconds


class Player:
    """Publishes a run. What is made here is published beside it."""

    def __init__(self, recorded, rate):
        import rospy
        from rosgraph_msgs.msg import Clock
        self.rospy, self.recorded, self.rate = rospy, recorded, rate
        self.clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self.publishers, self.classes = {}, {}
        for topic, entry in recorded.topics.items():
            if topic in recorded.pytypes:
                raw = _raw_class(recorded.pytypes[topic])
                self.classes[topic] = raw
                self.publishers[topic] = rospy.Publisher(entry.name, raw, queue_size=100,
                                                         latch=entry.latched)
        self.made = Made(self)

    def play(self, run, start_s):
        """All of a run; what comes before `start_s` as it has become by then."""
        begin = run[0][0]
        at = bisect.bisect_left([m[0] for m in run], begin + start_s)
        self.made.begin()
        self._catch_up(run[:at])
        wall, first, told = time.monotonic(), begin + start_s, None
        for t, topic, data in run[at:]:
            while told is None or told < t:
                if self.rospy.is_shutdown():
                    return
                told = first if told is None else min(told + _CLOCK_S, t)
                pause = (told - first) / self.rate - (time.monotonic() - wall)
                if pause > 0.0:
                    time.sleep(pause)
                self._tell(told)
            self._publish(topic, data)
            self.made.take(topic, data)

    def _tell(self, t):
        from rosgraph_msgs.msg import Clock
        self.clock.publish(Clock(clock=self.rospy.Time.from_sec(max(t, 1e-3))))

    def _publish(self, topic, data):
        publisher = self.publishers.get(topic)
        if publisher is not None:
            message = self.classes[topic]()
            message._buff = data
            publisher.publish(message)

    def _catch_up(self, before):
        """The last of everything, the map with all its updates."""
        last = {}
        maps = MapMirror(self.recorded)
        for t, topic, data in before:
            last[topic] = (t, topic, data)
            self.made.take(topic, data, publish=False)
            maps.take(topic, data)
        if not last:
            return
        self._tell(max(entry[0] for entry in last.values()))
        for topic, (_, _, data) in last.items():
            if not maps.owns(topic):
                self._publish(topic, data)
        maps.publish(self)
        self.made.publish()


class MapMirror:
    """Maps with the updates that came for them."""

    def __init__(self, recorded):
        self.recorded = recorded
        self.grids = {}
        self.updates = {topic: topic[:-len("_updates")] for topic in recorded.topics
                        if topic.endswith("_updates")}

    def take(self, topic, data):
        if topic in self.updates.values():
            message = _decode(self.recorded, topic, data)
            cells = numpy.array(message.data, dtype=numpy.int8)
            self.grids[topic] = (message, cells.reshape(message.info.height, message.info.width))
        elif topic in self.updates and self.updates[topic] in self.grids:
            update = _decode(self.recorded, topic, data)
            _, cells = self.grids[self.updates[topic]]
            cells[update.y:update.y + update.height, update.x:update.x + update.width] = \
                numpy.array(update.data, dtype=numpy.int8).reshape(update.height, update.width)

    def owns(self, topic):
        return topic in self.grids or self.updates.get(topic) in self.grids

    def publish(self, player):
        import io
        for topic, (message, cells) in self.grids.items():
            message.data = cells.ravel().tolist()
            out = io.BytesIO()
            message.serialize(out)
            player._publish(topic, out.getvalue())


class Made:
    """What a display needs and the recording lacks."""

    def __init__(self, player):
        import rospy
        from geometry_msgs.msg import TransformStamped
        from nav_msgs.msg import OccupancyGrid, Path
        from tf2_msgs.msg import TFMessage
        self.player, recorded = player, player.recorded
        self.types = (TransformStamped, Path, TFMessage, OccupancyGrid)
        names = {topic.name for topic in recorded.topics.values()}
        by_kind = {kind: topic for topic, kind in recorded.kinds.items()}
        self.motion = by_kind.get("odometry") or by_kind.get("ground_truth")
        self.chart = by_kind.get("chart") or by_kind.get("map")
        self.trajectory = by_kind.get("trajectory")
        self.needs = {
            "tf": self.motion is not None and "/tf" not in names,
            "trail": self.motion is not None and "/trail" not in names,
            "map": self.chart is not None and "/map" not in names,
            "chart": self.chart is not None and "/chart" not in names,
            "path": self.trajectory is not None and "/path" not in names,
        }
        self.out = {}
        if self.needs["tf"]:
            self.out = {"tf": rospy.Publisher("/tf", TFMessage, queue_size=100),
                        "tf_static": rospy.Publisher("/tf_static", TFMessage, queue_size=1,
                                                     latch=True)}
        for name, kind in (("trail", Path), ("map", OccupancyGrid), ("chart", OccupancyGrid),
                           ("path", Path)):
            if self.needs[name]:
                self.out[name] = rospy.Publisher("/" + name, kind, queue_size=1, latch=True)
        self.begin()

    def begin(self):
        self.trail = self.types[1]()
        self.trail.header.frame_id = "map"
        self.joined = False
        self.last = {}

    def take(self, topic, data, publish=True):
        if topic == self.motion and (self.needs["tf"] or self.needs["trail"]):
            self._take_motion(_decode(self.player.recorded, topic, data), publish)
        elif topic == self.chart:
            for name in ("map", "chart"):
                if self.needs[name]:
                    self._keep(name, _decode(self.player.recorded, topic, data), publish)
        elif topic == self.trajectory and self.needs["path"]:
            self._keep("path", self._path(_decode(self.player.recorded, topic, data)), publish)

    def publish(self):
        for name, message in self.last.items():
            self.out[name].publish(message)

    def _keep(self, name, message, publish):
        self.last[name] = message
        if publish:
            self.out[name].publish(message)

    def _take_motion(self, message, publish):
        transform_stamped, _, transforms, _ = self.types
        pose = message.pose.pose
        if self.needs["tf"]:
            frame = message.header.frame_id.strip("/") or "map"
            if frame != "map" and not self.joined:
                self.joined = True  # odometry with satellite fixes: both coincide (docs/nodes.md)
                join = transform_stamped()
                join.header.frame_id, join.child_frame_id = "map", frame
                join.transform.rotation.w = 1.0
                self._keep("tf_static", transforms([join]), True)
            place = transform_stamped()
            place.header = message.header
            place.header.frame_id, place.child_frame_id = frame, "base_link"
            place.transform.rotation = pose.orientation
            for axis in "xyz":
                setattr(place.transform.translation, axis, getattr(pose.position, axis))
            self._keep("tf", transforms([place]), publish)
        if self.needs["trail"]:
            from geometry_msgs.msg import PoseStamped
            poses = self.trail.poses
            if not poses or numpy.hypot(pose.position.x - poses[-1].pose.position.x,
                                        pose.position.y - poses[-1].pose.position.y) >= _TRAIL_M:
                poses.append(PoseStamped(header=message.header, pose=pose))
                poses[-1].header.frame_id = "map"
                self.trail.header.stamp = message.header.stamp
                self._keep("trail", self.trail, publish)

    def _path(self, message):
        from geometry_msgs.msg import PoseStamped
        path = self.types[1]()
        path.header = message.header
        for piece in message.pieces:
            for tau in numpy.linspace(0.0, piece.duration, max(2, int(piece.duration / 0.25) + 1)):
                point = PoseStamped(header=message.header)
                point.pose.position.x = numpy.polyval(piece.x[::-1], tau)
                point.pose.position.y = numpy.polyval(piece.y[::-1], tau)
                point.pose.orientation.w = 1.0
                path.poses.append(point)
        return path


def _decode(recorded, topic, data):
    message = recorded.pytypes[topic]()
    message.deserialize(data)
    return message


def _raw_class(pytype):
    """A class that publishes a message's bytes as they are."""
    import rospy
    return type("Raw_" + pytype.__name__, (rospy.AnyMsg,),
                {"_type": pytype._type, "_md5sum": pytype._md5sum,
                 "_full_text": pytype._full_text, "_has_header": False})


def hull(path, namespace, partial):
    """The recorded robot_description; the Otter's where the recording has none."""
    try:
        with open_bag(path, partial) as bag:
            _, prefix = vessel_topics(list(bag._get_connections()), namespace, path)
            for topic in (prefix + "/robot_description", "/robot_description"):
                for _, message, _ in bag.read_messages(topics=[topic]):
                    return message.data
    except Exception:
        pass  # who plays the bag says so
    with open(share_folder() / "rviz" / "otter.urdf") as file:
        return file.read()


def main(arguments=None):
    parser = argparse.ArgumentParser(
        prog="replay_bag", description="Publishes a recorded run for rviz, with /clock. Orders and "
        "commands are left out.")
    parser.add_argument("--bag", required=True)
    parser.add_argument("--rate", type=float, default=1.0, help="times real time (default 1)")
    parser.add_argument("--start", type=float, default=0.0, help="s into the run (default 0)")
    parser.add_argument("--run", type=int, default=0, help="which run, from 1 (default: all, one after "
                        "the other)")
    parser.add_argument("--namespace", help="of the vessel, where the bag holds several")
    parser.add_argument("--partial", nargs="?", const="true", default="false",
                        choices=("true", "false"), help="read what is there of a bag cut off")
    parser.add_argument("--hull", action="store_true", help="only print the hull (URDF) that was recorded, "
                        "or the Otter's")
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    options = parser.parse_args([a for a in arguments if not a.startswith("__") and ":=" not in a])
    if options.hull:
        print(hull(options.bag, options.namespace or None, options.partial == "true"))
        return 0
    try:
        if not options.rate > 0.0 or not options.start >= 0.0:
            raise RecordingError("--rate has to be above 0, --start not below")
        with open_bag(options.bag, options.partial == "true") as bag:
            recorded = Recorded(bag, options.bag, options.namespace or None,
                                options.partial == "true")
            if not 0 <= options.run <= len(recorded.runs):
                raise RecordingError(f"{options.bag}: holds {len(recorded.runs)} runs, none with "
                                     f"number {options.run}")
            return _play(recorded, options)
    except RecordingError as error:
        print(f"replay_bag: {error}", file=sys.stderr)
        return 1


def _play(recorded, options):
    import rospy
    rospy.init_node("replay", disable_signals=False)
    player = Player(recorded, options.rate)
    # Whoever shows it has to find the publishers first; what is latched waits for the rest.
    time.sleep(1.0)
    runs = recorded.runs if options.run == 0 else [recorded.runs[options.run - 1]]
    for number, run in enumerate(runs, options.run or 1):
        duration = run[-1][0] - run[0][0]
        if options.start >= duration and len(runs) == 1:
            raise RecordingError(f"{options.bag}: run {number} lasts {duration:.1f} s, --start is "
                                 "beyond its end")
        print(f"Run {number} of {len(recorded.runs)}: {duration:.1f} s, {len(run)} messages",
              flush=True)
        player.play(run, min(options.start, duration))
        if rospy.is_shutdown():
            return 0
    print("The end of the recording; the last picture stays", flush=True)
    rospy.spin()
    return 0
