#!/usr/bin/python3
"""Judge missions among other vessels from outside: distances, scores and the rules of the road.

Reads the result JSON of mission_benchmark with its tracks, shares no code with the planner, and
measures as docs/traffic.md says: distances are between the rectangles of both hulls, exact, with
the tracks interpolated to 0.02 s where they are near.

Usage: judge_encounters.py --scenarios DIR --json FILE.json [FILE.json ...] [--hull 2.0,1.08]
                           [--sheet FILE.png] [--verbose]
"""

import argparse
import collections
import json
import math
import os
import sys

import numpy as np
import yaml

# Which rule applies (rule 7 and the table of situations).
RISK_M, RISK_S = 15.0, 120.0
ABAFT, BOWS = math.radians(112.5), math.radians(12.0)
# What is asked.
EARLY_M, EARLY_S, AT_ONCE_S = 90.0, 60.0, 5.0
ACTION_RAD, ACTION_SHARE, ACTION_S, MEAN_S = math.radians(5.0), 0.1, 1.0, 2.0
APPARENT_RAD, HALF = math.radians(30.0), 0.5
STAND_ON_S, STAND_ON_M = 30.0, 30.0
BROAD = math.radians(70.0)
LANE_M, LANE_CROSSING_M, LANE_OVERTAKING_M = 2.0, 75.0, 20.0
CLEAR_M, WANTED_M, TOO_NEAR_M = 6.0, 10.0, 3.0
UNDER_WAY_S = 15.0
STEP_S, FINE_S, NEAR_M = 0.1, 0.02, 30.0

GIVE_WAY = ("head-on", "crossing give-way", "overtaking")


def wrap(angle):
    return (np.asarray(angle) + math.pi) % (2 * math.pi) - math.pi


def read_csv(path, columns):
    try:
        with open(path, encoding="ascii") as file:
            names = file.readline().strip().split(",")
            lines = file.readlines()
        data = np.loadtxt(lines, delimiter=",", ndmin=2) if lines else np.empty((0, len(names)))
    except (OSError, ValueError) as error:
        sys.exit(f"judge_encounters: {path}: {getattr(error, 'strerror', None) or error}")
    missing = [name for name in columns if name not in names]
    if missing or data.shape[1] != len(names):
        sys.exit(f"judge_encounters: {path}: no column {', '.join(missing)}" if missing
                 else f"judge_encounters: {path}: rows of {data.shape[1]} for {len(names)} names")
    table = {name: data[:, k] for k, name in enumerate(names)}
    for name in columns:
        # No comparison with such a one is ever true: what is there would be no contact.
        for row in np.flatnonzero(~np.isfinite(table[name])):
            sys.exit(f"judge_encounters: {path}: row {row + 1}: {name} is {table[name][row]}, no number")
    return table


def read_missions(path):
    try:
        with open(path, encoding="utf-8") as file:
            missions = json.load(file)["missions"]
        needed = {"scenario", "mission", "seed", "vessel", "outcome"}
        lacking = sorted(set().union(*(needed - set(mission) for mission in missions)))
    except (OSError, ValueError, LookupError, TypeError) as error:
        sys.exit(f"judge_encounters: {path}: {getattr(error, 'strerror', None) or 'no result of missions'}")
    if lacking:
        sys.exit(f"judge_encounters: {path}: a mission without {', '.join(lacking)}")
    return missions


def read_scenario(folder, name):
    path = os.path.join(folder, name + ".yaml")
    try:
        with open(path, encoding="utf-8") as file:
            scenario = yaml.safe_load(file)
    except (OSError, ValueError, yaml.YAMLError) as error:
        sys.exit(f"judge_encounters: {path}: {getattr(error, 'strerror', None) or error}")
    if not isinstance(scenario, dict) or not isinstance(scenario.get("missions"), list):
        sys.exit(f"judge_encounters: {path}: no scenario, it has no missions")
    for what, needed in (("missions", {"start", "goal"}),
                         ("vessels", {"id", "length_m", "beam_m", "waypoints", "speeds_mps"})):
        for k, one in enumerate(scenario.get(what) or []):
            lacking = sorted(needed - set(one if isinstance(one, dict) else ()))
            if lacking:
                sys.exit(f"judge_encounters: {path}: {what}[{k}] without {', '.join(lacking)}")
    return scenario


def hull_of(text):
    try:
        length, beam = (float(number) for number in text.split(","))
    except ValueError:
        length = beam = math.nan
    if not (0.0 < length < math.inf and 0.0 < beam < math.inf):
        raise argparse.ArgumentTypeError(f"must be length,beam in m, both above 0, got '{text}'")
    return length, beam


def find(named, folder):
    """A file as named, beside the result, or the only one of its name in a folder below it."""
    base = os.path.basename(named)
    for place in (named, os.path.join(folder, named), os.path.join(folder, base)):
        if os.path.isfile(place):
            return place
    below = [os.path.join(parent, base) for parent, _, files in os.walk(folder or ".") if base in files]
    if not below:
        sys.exit(f"judge_encounters: {named}: no such file, nor one of its name in '{folder or '.'}'")
    if len(below) > 1:
        sys.exit(f"judge_encounters: {named}: no such file, and several of its name: {', '.join(below)}")
    return below[0]


class Track:
    """Positions and headings at times."""

    def __init__(self, t, x, y, psi):
        self.t, self.x, self.y, self.psi = t, x, y, np.unwrap(psi)

    def at(self, t):
        return (np.interp(t, self.t, self.x), np.interp(t, self.t, self.y),
                np.interp(t, self.t, self.psi))


def scripted(vessel, t):
    """A vessel of a scenario at times t: its track as it is written."""
    points = np.array(vessel["waypoints"], float)
    speeds = list(vessel["speeds_mps"])
    legs = np.linalg.norm(np.diff(points, axis=0), axis=1)
    speeds = speeds * len(legs) if len(speeds) == 1 else speeds
    when = np.concatenate([[0.0], np.cumsum(legs / speeds)])
    leg = np.clip(np.searchsorted(when, t, side="right") - 1, 0, len(legs) - 1)
    psi = np.arctan2(np.diff(points[:, 1]), np.diff(points[:, 0]))[leg]
    return Track(t, np.interp(t, when, points[:, 0]), np.interp(t, when, points[:, 1]), psi)


def corners(x, y, psi, length, beam):
    """The corners of rectangles, [n, 4, 2]."""
    c, s = np.cos(psi), np.sin(psi)
    along = np.array([0.5, 0.5, -0.5, -0.5]) * length
    aside = np.array([0.5, -0.5, -0.5, 0.5]) * beam
    return np.stack([x[:, None] + c[:, None] * along - s[:, None] * aside,
                     y[:, None] + s[:, None] * along + c[:, None] * aside], axis=2)


def corner_edge(points, other):
    """Least distance of corners to the edges of other rectangles, [n]."""
    least = np.full(len(points), np.inf)
    for k in range(4):
        a, b = other[:, k], other[:, (k + 1) % 4]
        d = b - a
        length2 = np.maximum(np.sum(d * d, axis=1), 1e-12)
        for i in range(4):
            p = points[:, i] - a
            share = np.clip(np.sum(p * d, axis=1) / length2, 0.0, 1.0)
            least = np.minimum(least, np.linalg.norm(p - share[:, None] * d, axis=1))
    return least


def overlap(a, b):
    """Whether rectangles overlap (separating axes)."""
    apart = np.zeros(len(a), bool)
    for one, two in ((a, b), (b, a)):
        for k in (0, 1):
            axis = one[:, (k + 1) % 4] - one[:, k]
            p = np.einsum("nij,nj->ni", one, axis)
            q = np.einsum("nij,nj->ni", two, axis)
            apart |= (p.max(1) < q.min(1)) | (q.max(1) < p.min(1))
    return ~apart


def outline_distance(own, own_hull, other, other_hull, t):
    a = corners(*own.at(t), *own_hull)
    b = corners(*other.at(t), *other_hull)
    distance = np.minimum(corner_edge(a, b), corner_edge(b, a))
    distance[overlap(a, b)] = 0.0
    return distance


def range_score(r):
    if r >= 10.0:
        return 1.0
    if r >= 6.0:
        return 1.0 - 0.375 * (10.0 - r) / 4.0
    if r >= 3.0:
        return 0.625 - 0.625 * (6.0 - r) / 3.0
    return 0.0


def mean_velocity(track, t):
    """Course over ground, mean of the last 2 s."""
    before = np.maximum(t - MEAN_S, t[0])
    span = np.maximum(t - before, 1e-6)
    x0, y0, _ = track.at(before)
    x1, y1, _ = track.at(t)
    v = np.stack([(x1 - x0) / span, (y1 - y0) / span], axis=1)
    v[t - t[0] < 0.2] = 0.0
    return v


def approach(offset, closing):
    """Time to the nearest approach and its distance; offset and closing of the other."""
    speed2 = np.maximum(np.sum(closing * closing, axis=-1), 1e-9)
    time = -np.sum(offset * closing, axis=-1) / speed2
    distance = np.linalg.norm(offset + time[..., None] * closing, axis=-1)
    return time, distance


def course_of(v):
    return math.atan2(v[1], v[0])


def classify(own_v, other_v, offset):
    to = math.atan2(offset[1], offset[0])
    bearing = float(wrap(course_of(own_v) - to))
    aspect = float(wrap(course_of(other_v) - to - math.pi))
    own, other = np.linalg.norm(own_v), np.linalg.norm(other_v)
    if abs(aspect) > ABAFT and own > other:
        return "overtaking", bearing, aspect
    if abs(bearing) > ABAFT and other > own:
        return "being overtaken", bearing, aspect
    if abs(bearing) <= BOWS and abs(aspect) <= BOWS:
        return "head-on", bearing, aspect
    return ("crossing give-way" if bearing >= 0 else "crossing stand-on"), bearing, aspect


class Encounter:
    def __init__(self):
        self.rules = []  # (rule, kept)


class Run:
    """One mission: own track, the others', what was between them."""

    def __init__(self, own, mission, others, own_hull):
        self.own, self.mission, self.others, self.hull = own, mission, others, own_hull
        end = own.t[-1]
        self.t = np.arange(0.0, end + 1e-9, STEP_S)
        x, y, _ = own.at(self.t)
        self.p = np.stack([x, y], axis=1)
        self.v = mean_velocity(own, self.t)
        speed = mission.get("speed_mps") or 2.0
        goal = np.array(mission["goal"][:2])
        # While getting under way, the course and speed we are about to have.
        under_way = np.linalg.norm(self.v, axis=1) > 0.9 * speed
        first = np.argmax(under_way) if under_way.any() else len(self.t)
        first = min(first, int(UNDER_WAY_S / STEP_S))
        to = goal - self.p[:first]
        self.v_rule = self.v.copy()
        self.v_rule[:first] = speed * to / np.maximum(np.linalg.norm(to, axis=1), 1e-6)[:, None]
        self.under_way = first
        self.encounters = [self.meet(vessel, track) for vessel, track in others]
        self.judge_standing()

    def meet(self, vessel, track):
        e = Encounter()
        e.id, e.vessel = vessel["id"], vessel
        x, y, psi = track.at(self.t)
        e.q = np.stack([x, y], axis=1)
        e.v = np.gradient(e.q, STEP_S, axis=0)
        # Before its first row a track tells no motion: she seems to begin more slowly than she sails.
        told = min(int(np.searchsorted(self.t, track.t[0])) + 1, len(self.t) - 1)
        e.v[:told] = e.v[told]
        e.psi = psi
        e.offset = e.q - self.p
        e.range = np.linalg.norm(e.offset, axis=1)
        hull = (vessel["length_m"], vessel["beam_m"])
        near = e.range < max(NEAR_M, e.range.min() + 10.0)
        coarse = outline_distance(self.own, self.hull, track, hull, self.t[near])
        e.outline = np.full(len(self.t), np.inf)
        e.outline[near] = coarse
        close = self.t[near][coarse < coarse.min() + 1.5]
        fine = np.unique(np.concatenate(
            [np.arange(t - STEP_S, t + STEP_S, FINE_S) for t in close]).round(3))
        fine = fine[(fine >= 0) & (fine <= self.own.t[-1])]
        e.r = float(min(coarse.min(),
                        outline_distance(self.own, self.hull, track, hull, fine).min()))
        e.nearest = int(np.argmin(e.range))
        e.cpa = float(e.range.min())
        e.situation, e.role_from, e.role_to = None, None, None
        closing = e.v - self.v_rule
        e.tcpa, e.dcpa = approach(e.offset, closing)
        risk = (e.tcpa > 0) & (e.tcpa < RISK_S) & (e.dcpa < RISK_M)
        if risk.any():
            self.judge(e, int(np.argmax(risk)))
        return e

    def judge(self, e, k):
        e.since = k
        e.role_from = self.t[k]
        e.kept = self.v_rule[k]
        e.situation, e.bearing, e.aspect = classify(e.kept, e.v[k], e.offset[k])
        # Past and clear: they draw apart.
        after = np.arange(len(self.t)) > max(e.nearest, k)
        clear = after & (e.tcpa < 0) & (e.range > 30.0)
        last = int(np.argmax(clear)) if clear.any() else len(self.t) - 1
        e.role_to = self.t[last]
        cpa = max(e.nearest, k + 1)
        e.cpa_index, e.last = min(cpa, len(self.t) - 1), last
        self.actions(e, k, e.cpa_index)
        if e.situation in GIVE_WAY:
            self.judge_giving_way(e, k)

    def actions(self, e, k, until):
        begin = max(k, self.under_way)
        v = self.v[begin:until + 1]
        speed, kept = np.linalg.norm(v, axis=1), np.linalg.norm(e.kept)
        e.turn = -wrap(np.arctan2(v[:, 1], v[:, 0]) - course_of(e.kept))  # starboard positive
        e.turn[speed < 0.2] = 0.0
        e.share = speed / kept
        act = (np.abs(e.turn) > ACTION_RAD) | (np.abs(e.share - 1.0) > ACTION_SHARE)
        e.action, run = None, 0
        need = int(round(ACTION_S / STEP_S))
        for i, on in enumerate(act):
            run = run + 1 if on else 0
            if run >= need:
                e.action = begin + i - need + 1
                break
        e.begin = begin

    def first_turn(self, e):
        turning = np.abs(e.turn) > ACTION_RAD
        need = int(round(ACTION_S / STEP_S))
        run = 0
        for i, on in enumerate(turning):
            run = run + 1 if on else 0
            if run >= need:
                at = i - need + 1
                return (1 if e.turn[i] > 0 else -1), at
        return 0, None

    def left(self, e, i):
        """Time and distance to the nearest approach at i, had course and speed been kept."""
        time, distance = approach(e.offset[i], e.v[i] - e.kept)
        return float(time), float(distance)

    def into_lane(self, e, ahead_m, begin):
        """Own outline in her lane, ahead of her centre."""
        rows = slice(begin, e.last + 1)
        shape = corners(self.p[rows, 0], self.p[rows, 1], self.own.at(self.t[rows])[2], *self.hull)
        psi = e.psi[rows]
        off = shape - e.q[rows][:, None]
        along = off[..., 0] * np.cos(psi)[:, None] + off[..., 1] * np.sin(psi)[:, None]
        aside = -off[..., 0] * np.sin(psi)[:, None] + off[..., 1] * np.cos(psi)[:, None]
        crosses = (aside.min(1) <= LANE_M) & (aside.max(1) >= -LANE_M)
        return bool((crosses & (along.max(1) > 0.0) & (along.min(1) < ahead_m)).any())

    def judge_giving_way(self, e, k):
        s = e.situation
        rules = e.rules
        if e.action is None:
            timely = False
        else:
            i = e.action
            timely = (e.range[i] >= EARLY_M or self.left(e, i)[0] >= EARLY_S
                      or self.t[i] - max(self.t[k], self.t[e.begin]) <= AT_ONCE_S)
        rules.append(("8a", timely))
        rules.append(("8d", e.r >= CLEAR_M))
        if s != "overtaking":
            rules.append(("8b", bool(len(e.turn) and (np.abs(e.turn).max() >= APPARENT_RAD
                                                      or e.share.min() <= HALF))))
        side, at = self.first_turn(e)
        if s == "overtaking":
            rules.append(("13", not self.into_lane(e, LANE_OVERTAKING_M, k)))
        elif s == "head-on":
            i = e.cpa_index
            offset = self.p[i] - e.q[i]
            psi = e.psi[i]
            port = -offset[0] * math.sin(psi) + offset[1] * math.cos(psi)
            rules.append(("14", side == 1 and port > 0))
        else:
            fair = side >= 0
            if side < 0:
                fair = e.bearing >= BROAD or e.share[:at + 1].min() <= HALF
            rules.append(("15", fair and not self.into_lane(e, LANE_CROSSING_M, k)))

    def judge_standing(self):
        for e in self.encounters:
            if e.situation not in ("crossing stand-on", "being overtaken"):
                continue
            i = e.action
            when = self.t[i] if i is not None else None
            busy = [o for o in self.encounters if o is not e and o.situation in GIVE_WAY]
            probe = when if when is not None else self.t[e.cpa_index]
            if any(o.role_from <= probe <= o.role_to for o in busy):
                continue
            if i is None:
                e.rules.append(("17a", True))
            else:
                time, _ = self.left(e, i)
                e.rules.append(("17a", not (time > STAND_ON_S and e.range[i] > STAND_ON_M)))
            self.judge_last_moment(e)
            side, _ = self.first_turn(e)
            if e.situation == "crossing stand-on" and side != 0:
                e.rules.append(("17c", bool((e.turn > -ACTION_RAD).all()) or side == 1))

    def judge_last_moment(self, e):
        """17 b: asked if courses kept would bring the outlines within 3 m."""
        k = e.since
        if e.dcpa[k] - 0.5 * (e.vessel["length_m"] + self.hull[0]) > TOO_NEAR_M:
            return
        # She may act herself: then nothing is asked of us.
        moved = np.abs(wrap(np.arctan2(e.v[:, 1], e.v[:, 0]) - course_of(e.v[k]))) > ACTION_RAD
        she = moved[k:e.cpa_index].any()
        if she and e.action is None:
            return
        last = None
        for i in range(k, e.cpa_index + 1):
            time, _ = self.left(e, i)
            if (e.range[i] < 20.0 and time <= 10.0) or e.outline[i] < 6.0:
                last = i
                break
        acted = e.action is not None and (last is None or e.action <= last)
        e.rules.append(("17b", acted and e.r >= TOO_NEAR_M))


def judge_mission(entry, scenario, folder, own_hull):
    missions, number = scenario["missions"], entry["mission"]
    if not isinstance(number, int) or not 0 <= number < len(missions):
        sys.exit(f"judge_encounters: mission {number} of {entry['scenario']}, which has {len(missions)}, "
                 "counted from 0")
    mission = missions[number]
    if not entry.get("track"):
        sys.exit(f"judge_encounters: mission {entry['mission']} names no track")
    place = find(entry["track"], folder)
    data = read_csv(place, ("t", "x", "y", "psi"))
    if len(data["t"]) < 2:
        sys.exit(f"judge_encounters: {place}: fewer than two rows")
    own = Track(data["t"], data["x"], data["y"], data["psi"])
    t = np.arange(0.0, own.t[-1] + STEP_S, STEP_S)
    others = []
    faults = []
    if (np.diff(own.t) <= 0).any() or np.hypot(np.diff(own.x), np.diff(own.y)).max() > 2.0:
        faults.append("broken track")
    table = None
    if entry.get("vessels"):
        met = find(entry["vessels"], folder)
        table = read_csv(met, ("id", "t", "x", "y", "psi"))
    for vessel in scenario.get("vessels") or []:
        script = scripted(vessel, t)
        if table is None:
            others.append((vessel, script))
            continue
        rows = table["id"] == vessel["id"]
        if not rows.any():
            sys.exit(f"judge_encounters: {met}: no rows of vessel {vessel['id']}")
        track = Track(table["t"][rows], table["x"][rows], table["y"][rows], table["psi"][rows])
        x, y, _ = scripted(vessel, track.t).at(track.t)
        if np.hypot(track.x - x, track.y - y).max() > 0.5:
            faults.append(f"vessel {vessel['id']} off its script")
        others.append((vessel, track))
    run = Run(own, mission, others, own_hull)
    goal = mission["goal"]
    off = math.hypot(own.x[-1] - goal[0], own.y[-1] - goal[1])
    arrived = entry["outcome"] == "arrived"
    if arrived and off > 1.0:
        faults.append("arrival claimed")
    speed = mission.get("speed_mps") or 2.0
    straight = math.hypot(goal[0] - mission["start"][0], goal[1] - mission["start"][1]) / speed
    return run, arrived, own.t[-1] - straight, faults


def sheet(path, judged):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    columns = 6
    rows = -(-len(judged) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(2.6 * columns, 3.4 * rows), squeeze=False)
    for axis in axes.flat[len(judged):]:
        axis.axis("off")
    for axis, (name, run) in zip(axes.flat, judged):
        every = int(20.0 / STEP_S)
        for k, e in enumerate(run.encounters):
            colour = f"C{k + 1}"
            axis.plot(e.q[:, 0], e.q[:, 1], color=colour, lw=1)
            axis.plot(e.q[::every, 0], e.q[::every, 1], ".", color=colour, ms=3)
        axis.plot(run.p[:, 0], run.p[:, 1], "k", lw=1.3)
        axis.plot(run.p[::every, 0], run.p[::every, 1], "k.", ms=4)
        least = min((e.r for e in run.encounters), default=math.inf)
        axis.set_title(f"{name}: {least:.1f} m", fontsize=8)
        axis.set_aspect("equal")
        x = 0.5 * (run.p[:, 0].min() + run.p[:, 0].max())
        y = 0.5 * (run.p[:, 1].min() + run.p[:, 1].max())
        high = 0.55 * max(np.ptp(run.p[:, 1]), np.ptp(run.p[:, 0]), 40.0)
        axis.set_xlim(x - 0.75 * high, x + 0.75 * high)
        axis.set_ylim(y - high, y + high)
        axis.tick_params(labelsize=6)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scenarios", required=True)
    parser.add_argument("--json", nargs="+", required=True)
    parser.add_argument("--hull", type=hull_of, default="2.0,1.08", help="ours: length,beam in m")
    parser.add_argument("--sheet", help="a picture of the tracks, of each mission the first")
    parser.add_argument("--verbose", action="store_true")
    arguments = parser.parse_args()
    scenarios = {}
    asked, kept = collections.Counter(), collections.Counter()
    lost, scores, contacts, near_misses, arrivals, count = [], [], 0, 0, 0, 0
    faults, judged = [], []
    for path in arguments.json:
        for entry in read_missions(path):
            name = entry["scenario"]
            if name not in scenarios:
                scenarios[name] = read_scenario(arguments.scenarios, name)
            run, arrived, late, wrong = judge_mission(
                entry, scenarios[name], os.path.dirname(path), arguments.hull)
            count += 1
            arrivals += arrived
            faults += [f"{name} {entry['mission']}: {w}" for w in wrong]
            if arrived:
                lost.append(late)
            label = f"{name} {entry['mission']}"
            if label not in (other for other, _ in judged):
                judged.append((label, run))
            for e in run.encounters:
                contacts += e.r == 0.0
                near_misses += 0.0 < e.r < CLEAR_M
                scores.append(range_score(e.r))
                for rule, good in e.rules:
                    asked[rule] += 1
                    kept[rule] += good
            if arguments.verbose:
                print(f"{name} {entry['mission']} seed {entry['seed']} {entry['vessel']}: "
                      f"{entry['outcome']}, {late:.1f} s lost")
                for e in run.encounters:
                    broken = [rule for rule, good in e.rules if not good]
                    what = e.situation or "no risk"
                    when = f"{self_time(e, run)}"
                    print(f"    {e.id}: r {e.r:5.1f} m, cpa {e.cpa:5.1f} m, {what}{when}"
                          + (f"  BROKEN {', '.join(broken)}" if broken else ""))
    total, good = sum(asked.values()), sum(kept.values())
    print(f"{count} missions, {arrivals} arrived, {contacts} contacts, {near_misses} near misses, "
          f"range score {np.mean(scores) if scores else 1.0:.4f}, time lost "
          f"{np.mean(lost) if lost else math.nan:.1f} s mean")
    print(f"rules kept {good} of {total}"
          + (f" ({100.0 * good / total:.1f} %)" if total else "") + ": "
          + ", ".join(f"{rule} {kept[rule]}/{asked[rule]}" for rule in sorted(asked)))
    for fault in faults:
        print("FAULT", fault)
    if arguments.sheet:
        sheet(arguments.sheet, judged)
    return 1 if faults or contacts else 0


def self_time(e, run):
    if e.situation is None:
        return ""
    acted = f", acted {run.t[e.action]:.0f} s" if e.action is not None else ", no action"
    return f" since {run.t[e.since]:.0f} s{acted}"


if __name__ == "__main__":
    sys.exit(main())
