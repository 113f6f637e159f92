#!/usr/bin/python3
"""Make scenarios of situations of DNV's ship-traffic-generator, brought to a small vessel's scale.

A situation is a JSON file with an own ship and others, each with waypoints in degrees and the speed
of its legs in knots. The own ship's way becomes one to the north of --length m at --speed m/s, and
lengths and times of everybody are scaled alike. The others are 6 m by 2 m, and keep their last
course for 300 m more.

Usage: traffic_situations.py --out DIR --chart CHART.yaml [--length 400] [--speed 2] FILE.json ...
"""

import argparse
import json
import math
import os
import sys

EARTH_M = 6371000.0
ONWARD_M = 300.0


def places(ship, origin):
    """East and north of the origin, m, of a ship's waypoints."""
    rad = math.pi / 180.0
    return [(EARTH_M * rad * (point["position"]["lon"] - origin["lon"]) * math.cos(rad * origin["lat"]),
             EARTH_M * rad * (point["position"]["lat"] - origin["lat"])) for point in ship["waypoints"]]


def speeds(ship):
    return [point["leg"]["sog"] for point in ship["waypoints"][:-1]]


def scenario(situation, chart, length_m, speed_mps):
    """The text of a scenario."""
    own = situation["ownShip"]
    origin = own["waypoints"][0]["position"]
    start, end = places(own, origin)[0], places(own, origin)[-1]
    whole = math.dist(start, end)
    turned = math.pi / 2 - math.atan2(end[1], end[0])  # the own way to the north
    scale = length_m / whole
    pace = speed_mps / speeds(own)[0]
    cos, sin = math.cos(turned), math.sin(turned)

    def on_map(place):
        return (scale * (cos * place[0] - sin * place[1]), scale * (sin * place[0] + cos * place[1]) - length_m / 2)

    lines = [f"chart: {chart}", f"world: {chart}", "missions:",
             f"  - {{kind: encounter, start: [0, {-length_m / 2:g}, 1.5708], goal: [0, {length_m / 2:g}, 1.5708], "
             f"speed_mps: {speed_mps:g}}}",
             "vessels:"]
    for number, ship in enumerate(situation["targetShips"], 1):
        way = [on_map(place) for place in places(ship, origin)]
        (x0, y0), (x1, y1) = way[-2:]
        onward = ONWARD_M / math.dist(way[-2], way[-1])
        way[-1] = (x1 + onward * (x1 - x0), y1 + onward * (y1 - y0))
        points = ", ".join(f"[{x:.2f}, {y:.2f}]" for x, y in way)
        paces = ", ".join(f"{pace * speed:.3f}" for speed in speeds(ship))
        lines.append(f"  - {{id: {number}, length_m: 6, beam_m: 2, waypoints: [{points}], speeds_mps: [{paces}]}}")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("files", nargs="+", metavar="FILE.json")
    parser.add_argument("--out", required=True, help="folder to write into")
    parser.add_argument("--chart", required=True, help="of open water, as the scenarios name it")
    parser.add_argument("--length", type=float, default=400.0, help="of the own way, m")
    parser.add_argument("--speed", type=float, default=2.0, help="of the own vessel, m/s")
    options = parser.parse_args()
    for name in ("length", "speed"):
        if not 0.0 < getattr(options, name) < math.inf:
            sys.exit(f"traffic_situations: --{name} must be positive")
    os.makedirs(options.out, exist_ok=True)
    for path in options.files:
        try:
            with open(path, encoding="utf-8") as file:
                text = scenario(json.load(file), options.chart, options.length, options.speed)
        except (OSError, ValueError, KeyError, TypeError, IndexError, ZeroDivisionError) as error:
            sys.exit(f"traffic_situations: {path} is no situation with an own ship and others: {error!r}")
        name = os.path.splitext(os.path.basename(path))[0] + ".yaml"
        with open(os.path.join(options.out, name), "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    main()
