"""Poses in the format of the TUM benchmark, which evo reads: t x y z qx qy qz qw."""
import argparse
import os
import sys

import numpy

from .bag import read_one
from .errors import RecordingError


def write_tum(path, table, window=None):
    """Writes t, x, y and psi of a table; rows that are not numbers are left out."""
    rows = numpy.isfinite(table.x) & numpy.isfinite(table.y) & numpy.isfinite(table.psi)
    if window is not None:
        rows &= (table.t >= window[0] - 1e-9) & (table.t <= window[1] + 1e-9)
    with open(path, "w") as file:
        for t, x, y, psi in zip(table.t[rows], table.x[rows], table.y[rows], table.psi[rows]):
            file.write(f"{t:.9f} {x:.9f} {y:.9f} 0 0 0 {numpy.sin(psi / 2):.12f} "
                       f"{numpy.cos(psi / 2):.12f}\n")
    return int(numpy.sum(rows))


def main(arguments=None):
    parser = argparse.ArgumentParser(
        prog="bag_to_tum", description="Writes truth.tum, odometry.tum and reference.tum of a bag, "
        "for evo: evo_ape tum reference.tum truth.tum")
    parser.add_argument("--bag", required=True, help="bag of a run")
    parser.add_argument("--out", required=True, help="folder to write into")
    parser.add_argument("--run", type=int, default=1, help="which run of the bag, from 1")
    parser.add_argument("--vessel", default="otter_gazebo", help="name in config/vessels or a file")
    parser.add_argument("--namespace", help="of the vessel, where the bag holds several")
    parser.add_argument("--window", action="store_true",
                        help="only from the first trajectory to arrival")
    parser.add_argument("--partial", action="store_true", help="read what is there of a bag cut off")
    options = parser.parse_args(arguments)
    try:
        run, _ = read_one(options.bag, options.run, options.vessel, options.namespace,
                          options.partial)
        os.makedirs(options.out, exist_ok=True)
        window = run.window if options.window else None
        for name, table in (("truth", run.truth), ("odometry", run.odometry),
                            ("reference", run.reference)):
            if len(table):
                rows = write_tum(os.path.join(options.out, name + ".tum"), table, window)
                print(f"{name}.tum: {rows} poses")
    except (RecordingError, OSError) as error:
        print(f"bag_to_tum: {error}", file=sys.stderr)
        return 1
    return 0
