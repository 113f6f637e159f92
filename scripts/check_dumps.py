#!/usr/bin/python3
"""Check planner_benchmark's dumps from outside.

Shares no code with the planner: its own RK4 of the paper's model, its own reading of the maps, its
own tests. For each case claimed as a success:
  - the dump's states follow from its thrusts: the model is integrated from each row to the next
    few with the dumped tau (cubic in time between rows) and must meet the dumped states;
  - the states follow from each other: differences of position and heading are the velocities, and
    position is smooth up to its third derivative;
  - speed and yaw rate are within the vessel's;
  - both thrusters are within the vessel's limits (the diamond);
  - the hull's centre keeps the clearance from every occupied cell's square, between rows too, and
    the hull's outline touches none;
  - it starts and ends at the mission's poses, at rest.
How far the whole trajectories drift when they are integrated open loop is printed as well.

Usage: check_dumps.py --scenarios DIR --json FILE.json --vessel config/vessels/otter_gazebo.yaml
"""

import argparse
import json
import math
import os
import sys

import numpy as np
import yaml
from PIL import Image

STEP_S = 0.02
VELOCITY_MPS = 2e-3
YAW_RADPS = 1e-2
# The surge force's ramps at launch and stop have a slope of this order (a step would be the whole
# jerk); smooth motion elsewhere stays far below.
JERK_STEP_MPS3 = 6.0
YAW_RATE_MAX_RADPS = 2.0

COLUMNS = ["t", "x", "y", "psi", "u", "v", "r", "tau_u", "tau_r"]


def read_image(path):
    """Shades of a PGM or PNG as rows from the top."""
    try:
        return np.asarray(Image.open(path).convert("L"), float)
    except (OSError, SyntaxError, ValueError) as error:  # PIL's SyntaxError: a file that is broken
        sys.exit(f"check_dumps: {path}: {error}")


class Map:
    """Occupied cells in buckets, for exact distances to their squares."""

    def __init__(self, yaml_path):
        with open(yaml_path) as file:
            meta = yaml.safe_load(file)
        image = read_image(os.path.join(os.path.dirname(yaml_path), meta["image"]))
        dark = (255.0 - image) / 255.0 if not meta["negate"] else image / 255.0
        self.occupied = np.flipud(dark > meta["occupied_thresh"])
        self.resolution = meta["resolution"]
        self.origin = np.array(meta["origin"][:2], float)

    def squares_near(self, p, reach):
        """Lower left corners of occupied cells within `reach` of p, and of cells off the map."""
        res = self.resolution
        low = np.floor((p - reach - self.origin) / res).astype(int)
        high = np.floor((p + reach - self.origin) / res).astype(int)
        rows, cols = self.occupied.shape
        ys, xs = np.meshgrid(np.arange(low[1], high[1] + 1), np.arange(low[0], high[0] + 1),
                             indexing="ij")
        inside = (ys >= 0) & (ys < rows) & (xs >= 0) & (xs < cols)
        hit = ~inside
        hit[inside] = self.occupied[ys[inside], xs[inside]]
        return self.origin + res * np.stack([xs[hit], ys[hit]], axis=1)

    def distance(self, p, reach):
        corners = self.squares_near(p, reach)
        if not len(corners):
            return reach
        nearest = np.clip(p, corners, corners + self.resolution)
        return float(np.min(np.hypot(*(nearest - p).T)))

    def touches(self, centre, psi, half_length, half_beam):
        """Whether a rectangle overlaps an occupied square (separating axes)."""
        reach = math.hypot(half_length, half_beam)
        corners = self.squares_near(centre, reach)
        if not len(corners):
            return False
        half = 0.5 * self.resolution
        offset = corners + half - centre
        c, s = math.cos(psi), math.sin(psi)
        along, across = offset @ [c, s], offset @ [-s, c]
        spread = half * (abs(c) + abs(s))
        box = np.array([half_length * abs(c) + half_beam * abs(s),
                        half_length * abs(s) + half_beam * abs(c)])
        overlap = ((np.abs(along) < half_length + spread) & (np.abs(across) < half_beam + spread) &
                   (np.abs(offset[:, 0]) < half + box[0]) & (np.abs(offset[:, 1]) < half + box[1]))
        return bool(np.any(overlap))


def derivative(state, tau, model):
    """The paper's model with the consistent Coriolis matrix (paper, section III)."""
    psi, u, v, r = state[..., 2], state[..., 3], state[..., 4], state[..., 5]
    c, s = np.cos(psi), np.sin(psi)
    m1, m2 = model["m1_kg"], model["m2_kgm2"]
    return np.stack([u * c - v * s, u * s + v * c, r,
                     v * r + (tau[..., 0] - model["d1_kgps"] * u) / m1,
                     -u * r - model["d2_kgps"] * v / m1,
                     (tau[..., 1] - model["d3_kgm2ps"] * r) / m2], axis=-1)


def midpoint(tau):
    """Values half way between rows by the cubic through four rows (linear at the ends)."""
    mid = 0.5 * (tau[:-1] + tau[1:])
    if len(tau) > 3:
        mid[1:-1] = (9.0 * (tau[1:-2] + tau[2:-1]) - tau[:-3] - tau[3:]) / 16.0
    return mid


def rk4_step(x, tau, tau_mid, tau_end, h, model):
    k1 = derivative(x, tau, model)
    k2 = derivative(x + 0.5 * h * k1, tau_mid, model)
    k3 = derivative(x + 0.5 * h * k2, tau_mid, model)
    k4 = derivative(x + h * k3, tau_end, model)
    return x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)


def wrap(angle):
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


def integration_error(rows, model):
    """Largest position and heading errors of one-step integrations, per second of step."""
    t, states, tau = rows[:, 0], rows[:, 1:7], rows[:, 7:9]
    h = np.diff(t)[:, None]
    error = rk4_step(states[:-1], tau[:-1], midpoint(tau), tau[1:], h, model) - states[1:]
    error[:, 2] = wrap(error[:, 2])
    return np.abs(error)


def rollout_error(rows, model, seconds):
    """Largest position error of free rollouts of `seconds` from rows spread over the way."""
    step = max(1, int(round(seconds / 0.02)))
    worst = 0.0
    tau, mid = rows[:, 7:9], midpoint(rows[:, 7:9])
    for first in range(0, len(rows) - 1, step):
        x = rows[first, 1:7].copy()
        last = min(len(rows) - 1, first + step)
        for i in range(first, last):
            x = rk4_step(x, tau[i], mid[i], tau[i + 1], rows[i + 1, 0] - rows[i, 0], model)
        worst = max(worst, float(np.hypot(*(x[:2] - rows[last, 1:3]))))
    return worst


def kinematic_faults(rows):
    """Central differences of the pose against the velocities, and steps of the third derivative."""
    even = np.abs(np.diff(rows[:, 0]) - STEP_S) < 1e-6
    count = int(np.argmin(even)) + 1 if not np.all(even) else len(rows)
    t, x, psi = rows[:count, 0], rows[:count, 1:3], np.unwrap(rows[:count, 3])
    u, v, r = rows[:count, 4], rows[:count, 5], rows[:count, 6]
    if count < 8:
        return []
    faults = []
    c, s = np.cos(psi), np.sin(psi)
    velocity = np.stack([u * c - v * s, u * s + v * c], axis=1)
    # Five points: exact up to the fourth derivative.
    def slope(f):
        return (f[:-4] - 8.0 * f[1:-3] + 8.0 * f[3:-1] - f[4:]) / (12.0 * STEP_S)
    off = np.max(np.abs(slope(x) - velocity[2:-2]), axis=1)
    turn = np.abs(slope(psi) - r[2:-2])
    for name, error, limit in (("velocity", off, VELOCITY_MPS), ("yaw rate", turn, YAW_RADPS)):
        worst = int(np.argmax(error))
        if error[worst] > limit:
            faults.append(f"{name} is not the pose's slope by {error[worst]:.2g} "
                          f"at {t[worst + 2]:.2f} s")
    jerk = np.diff(x, 3, axis=0) / STEP_S**3
    step = np.hypot(*np.diff(jerk, axis=0).T)
    worst = int(np.argmax(step))
    if step[worst] > JERK_STEP_MPS3:
        faults.append(f"the third derivative steps by {step[worst]:.1f} m/s^3 "
                      f"at {t[worst + 2]:.2f} s")
    return faults


def check(rows, mission, grid, vessel, clearance):
    """A list of what is wrong."""
    faults = []
    if not np.all(np.isfinite(rows)):
        return ["values that are not finite"]
    t = rows[:, 0]
    if abs(t[0]) > 1e-9 or np.any(np.diff(t) <= 0.0) or np.any(np.diff(t) > 0.0201):
        faults.append("times do not rise by 0.02 s")
    for name, row, pose in (("start", rows[0], mission["start"]), ("goal", rows[-1], mission["goal"])):
        off = math.hypot(row[1] - pose[0], row[2] - pose[1])
        if off > 0.02:
            faults.append(f"{name} missed by {off:.3f} m")
        if abs(wrap(row[3] - pose[2])) > math.radians(5.0):
            faults.append(f"{name} heading off by {math.degrees(wrap(row[3] - pose[2])):.1f} deg")
        if np.max(np.abs(row[4:7])) > 1e-3:
            faults.append(f"not at rest at the {name}: {row[4:7]}")
    model, thrusters, hull = vessel["paper_model"], vessel["thrusters"], vessel["hull"]
    error = integration_error(rows, model)
    limits = [2e-3, 2e-3, 4e-3, 1e-2, 1e-2, 4e-2]
    for column, limit in enumerate(limits):
        worst = int(np.argmax(error[:, column]))
        if error[worst, column] > limit:
            faults.append(f"{COLUMNS[column + 1]} off by {error[worst, column]:.2g} after one step "
                          f"at {t[worst]:.2f} s")
    faults += kinematic_faults(rows)
    if np.max(np.hypot(rows[:, 4], rows[:, 5])) > vessel["top_speed_mps"]:
        faults.append("faster than the vessel")
    if np.max(np.abs(rows[:, 6])) > YAW_RATE_MAX_RADPS:
        faults.append(f"turns at {np.max(np.abs(rows[:, 6])):.2f} rad/s")
    drift = rollout_error(rows, model, 2.0)
    if drift > 0.05:
        faults.append(f"2 s rollout drifts {drift:.3f} m")
    difference = rows[:, 8] / thrusters["lever_arm_m"]
    for side, thrust in (("left", 0.5 * (rows[:, 7] - difference)),
                         ("right", 0.5 * (rows[:, 7] + difference))):
        over = max(np.max(thrust - thrusters["ahead_max_n"]),
                   np.max(-thrusters["astern_max_n"] - thrust))
        if over > 1e-6:
            faults.append(f"{side} thruster {over:.2f} N beyond its limit")
    faults += collisions(rows, grid, hull, clearance)
    return faults


def collisions(rows, grid, hull, clearance):
    half_length, half_beam = 0.5 * hull["length_m"], 0.5 * hull["beam_m"]
    reach = 6.0
    clear_until = 0.0  # length of way within which nothing can be near
    travelled = 0.0
    for i in range(len(rows)):
        p = rows[i, 1:3]
        step = 0.0 if i + 1 == len(rows) else math.hypot(*(rows[i + 1, 1:3] - p))
        if travelled + step >= clear_until:
            # Between rows the centre is on a short arc: its middle is tested as well.
            distance = grid.distance(p, reach)
            middle = distance - 0.5 * step
            if step > 0.0 and middle < clearance:
                middle = grid.distance(0.5 * (p + rows[i + 1, 1:3]), reach)
            if min(distance, middle) < clearance - 1e-3:
                return [f"clearance {min(distance, middle):.3f} m at {rows[i, 0]:.2f} s"]
            if distance < 1.3 and grid.touches(p, rows[i, 3], half_length, half_beam):
                return [f"hull touches at {rows[i, 0]:.2f} s"]
            clear_until = travelled + distance - 1.3
        travelled += step
    return []


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scenarios", required=True)
    parser.add_argument("--json", required=True, help="planner_benchmark's --out")
    parser.add_argument("--vessel", required=True, help="vessel YAML")
    parser.add_argument("--map", default="world", choices=["world", "chart"])
    parser.add_argument("--clearance", type=float, default=0.8)
    args = parser.parse_args()
    with open(args.json) as file:
        cases = json.load(file)["cases"]
    with open(args.vessel) as file:
        vessel = yaml.safe_load(file)
    scenarios, grids = {}, {}
    bad = checked = 0
    drifts = []
    for case in cases:
        if not case["success"]:
            continue
        name = case["scenario"]
        if name not in scenarios:
            with open(os.path.join(args.scenarios, name + ".yaml")) as file:
                scenarios[name] = yaml.safe_load(file)
            grids[name] = Map(os.path.join(args.scenarios, scenarios[name][args.map]))
        rows = np.loadtxt(case["dump"], delimiter=",", skiprows=1)
        faults = check(rows, scenarios[name]["missions"][case["mission"]], grids[name], vessel,
                       args.clearance)
        checked += 1
        drifts.append(rollout_error(rows, vessel["paper_model"], rows[-1, 0] + 1.0))
        if faults:
            bad += 1
            print(f"{name} {case['mission']} {case['method']} seed {case['seed']}: "
                  + "; ".join(faults))
    if drifts:
        print(f"open loop over the whole way: {np.median(drifts):.3f} m off at the end (median), "
              f"{np.quantile(drifts, 0.95):.3f} m (95 %), {np.max(drifts):.3f} m (worst)")
    print(f"{checked} claimed successes checked, {bad} of them false")
    return 1 if bad or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
