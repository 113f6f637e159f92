"""How long the nodes take to answer what the lidar shows, from bags recorded in real time.

A conflict: the planner finds that something comes too near on the way that is sailed. Its times are
those of the newest scan in the map by then, of the decision, of the answer (a plan, a stop, or a
way among other vessels) and of the first command that the control loop makes with it.
"""
import argparse
import json
import os
import sys

import numpy

from .bag import damaged, open_bag
from .errors import RecordingError

_TOPICS = ("map_updates", "planner_status", "trajectory", "tracker_cycle")
_CONFLICT = "only "  # how the planner's reason begins then (test/unit/mission)
_OTHERWISE = {"stopping": "stop", "evading": "way among others"}  # answered, by the state; else a plan
_PARTS = (("scan to decision", "scan", "decision"), ("decision to answer", "decision", "answer"),
          ("answer to command", "answer", "command"), ("scan to command", "scan", "command"))


def messages_of(path):
    """(last name of the topic, message, s when it was recorded) of what this takes, in that order."""
    received = -numpy.inf
    with open_bag(path) as bag:
        try:
            for topic, message, when in bag.read_messages():
                name = topic.rsplit("/", 1)[-1]
                received = when.to_sec()
                if name in _TOPICS:
                    yield name, message, received
        except Exception as error:  # as many kinds as there are of damage
            raise damaged(path, received, error) from error


def conflicts(messages):
    """Those that were answered, each a dict with its times in s, "kind" and "plans" asked for; and
    the wall times of all plans in ms."""
    found, wall_ms, scans, sent, commands = [], {}, [], [], []
    now, state = None, ""
    for name, message, when in messages:
        stamp = message.header.stamp.to_sec()
        if name == "map_updates":
            scans.append((when, stamp))
        elif name == "trajectory":
            sent.append((when, message.id))
        elif name == "tracker_cycle":
            commands.append((message.trajectory_taken, stamp))
        elif name == "planner_status":
            if message.plans:
                wall_ms[message.plans] = message.planning_ms
            if now and message.state != "replanning":
                now.update(answer=stamp, until=when, plans=message.plans - now["plans"],
                           kind=_OTHERWISE.get(message.state, "plan"))
                found.append(now)
                now = None
            starts = message.state == "replanning" and message.reason.startswith(_CONFLICT)
            if starts and state == "sailing":
                now = {"decision": stamp, "plans": message.plans, "from": when}
            state = message.state
    answered = [_whole(conflict, scans, sent, commands) for conflict in found]
    return [conflict for conflict in answered if conflict], list(wall_ms.values())


def _whole(conflict, scans, sent, commands):
    """With the times of its scan and of its first command; None where it was clear again by itself."""
    late_s = 0.05  # topics are recorded each in its own time
    begin, end = conflict.pop("from"), conflict.pop("until") + late_s
    shown = [stamp for when, stamp in scans if when <= begin]
    if not shown:
        return None
    conflict["scan"] = max(shown)
    ids = [number for when, number in sent if begin <= when <= end]
    times = [stamp for taken, stamp in commands if ids and taken >= ids[0] and stamp >= conflict["scan"]]
    return dict(conflict, command=times[0]) if times else None


def summary(values, unit):
    if not values:
        return "none"
    median, p95, p99 = numpy.percentile(values, [50, 95, 99])
    return (f"{len(values)}: median {median:.0f} {unit}, p95 {p95:.0f}, p99 {p99:.0f}, "
            f"most {max(values):.0f}")


def _make_room(out, bags):
    """Before the bags are read, which takes its time."""
    if os.path.realpath(out) in map(os.path.realpath, bags):
        raise RecordingError(f"--json {out}: would be written over a bag that is read")
    if os.path.isdir(out):
        raise RecordingError(f"--json {out}: is a folder")
    os.makedirs(os.path.dirname(os.path.abspath(out)), exist_ok=True)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("bags", nargs="+", metavar="FILE.bag")
    parser.add_argument("--json", help="file for each conflict's times")
    options = parser.parse_args(arguments)
    found, wall_ms = [], []
    try:
        if options.json:
            _make_room(options.json, options.bags)
        for path in options.bags:
            of_bag, plans_ms = conflicts(messages_of(path))
            found += of_bag
            wall_ms += plans_ms
    except (RecordingError, OSError) as error:
        print(f"latency: {error}", file=sys.stderr)
        return 1
    for kind in ("plan", *_OTHERWISE.values()):
        of_kind = [c for c in found if c["kind"] == kind]
        print(f"answered by a {kind}")
        for what, begin, end in _PARTS:
            print(f"  {what}: {summary([1e3 * (c[end] - c[begin]) for c in of_kind], 'ms')}")
        print(f"  plans made for it: {summary([c['plans'] for c in of_kind], '')}")
    print(f"planning, wall time: {summary(wall_ms, 'ms')}")
    if options.json:
        with open(options.json, "w", encoding="ascii") as file:
            json.dump({"conflicts": found, "planning_ms": wall_ms}, file, indent=1)
    return 0
