"""Results of missions: the JSON of mission_node and mission_benchmark with the tracks' CSV."""
import csv
import json
import os

import numpy

from .errors import RecordingError
from .run import CONTACTS, Event, Run
from .table import Table, table_of
from .vessel import load_vessel

_COLUMNS = ("t", "x", "y", "psi", "u", "v", "r", "f_left", "f_right", "x_ref", "y_ref", "psi_ref")
_LABELS = ("scenario", "mission", "vessel", "disturbance", "seed")


def load_json(path):
    try:
        with open(path) as file:
            return json.load(file)
    except OSError as error:
        raise RecordingError(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise RecordingError(f"{path}: is not JSON: {error}") from error


def load_missions(path):
    """The missions of a result file, as they stand in it."""
    data = load_json(path)
    missions = data.get("missions") if isinstance(data, dict) else None
    if not missions or not isinstance(missions, list):
        raise RecordingError(f"{path}: no 'missions' in it")
    return missions


def find_track(mission, folder):
    """The track's file as named, beside the result, or the only one of its name in a folder below it;
    None without."""
    named = mission.get("track") or ""
    if not named:
        return None
    base = os.path.basename(named)
    for candidate in (named, os.path.join(folder, named), os.path.join(folder, base)):
        if os.path.isfile(candidate):
            return candidate
    below = [os.path.join(parent, base) for parent, _, files in os.walk(folder) if base in files]
    if len(below) > 1:
        raise RecordingError(f"track {named}: is not there, and several have its name: {', '.join(below)}")
    return below[0] if below else None


def load_track(path):
    """A track's columns."""
    try:
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
    except OSError as error:
        raise RecordingError(f"track {path}: {error.strerror}") from error
    missing = [name for name in _COLUMNS if not rows or name not in rows[0]]
    if missing:
        raise RecordingError(f"track {path}: no column {', '.join(missing)}")
    if len(rows) < 3:
        raise RecordingError(f"track {path}: fewer than two rows")
    try:
        data = numpy.array(rows[1:], dtype=float)
    except ValueError as error:
        raise RecordingError(f"track {path}: {error}") from error
    return Table(**{name: data[:, k] for k, name in enumerate(rows[0])})


def _reference_of(track):
    """The reference a track states. Its course is the way's own, where it moves and does not jump
    to another trajectory; else the heading."""
    none = (track.x_ref == track.x) & (track.y_ref == track.y) & (track.psi_ref == track.psi)
    # Before the first trajectory the reference is the vessel's own pose.
    first = int(numpy.argmin(none)) if not numpy.all(none) else len(none)
    x, y, psi = (column.copy() for column in (track.x_ref, track.y_ref, track.psi_ref))
    for column in (x, y, psi):
        column[:first] = numpy.nan
    vx, vy = numpy.gradient(x, track.t), numpy.gradient(y, track.t)
    speed = numpy.hypot(vx, vy)
    step = numpy.hypot(numpy.diff(x), numpy.diff(y)) / numpy.diff(track.t)
    jumped = numpy.zeros(len(track), dtype=bool)
    with numpy.errstate(invalid="ignore"):
        leaps = step > 2.0 * numpy.nanmax(numpy.hypot(track.u, track.v)) + 0.5
    jumped[:-1] |= leaps
    jumped[1:] |= leaps
    with numpy.errstate(invalid="ignore"):
        moving = (speed > 0.05) & ~jumped
    course = numpy.where(moving, numpy.arctan2(vy, vx), psi)
    speed = numpy.where(jumped, numpy.nan, speed)
    part = numpy.where(numpy.isfinite(x), numpy.cumsum(numpy.r_[False, leaps]), -1)
    return Table(t=track.t, x=x, y=y, psi=psi, speed=speed, course=course, part=part)


def read_result(path, mission=0, vessel=None):
    """One mission of a result file as a run; needs its track."""
    missions = load_missions(path)
    if not 0 <= mission < len(missions):
        raise RecordingError(f"{path}: holds {len(missions)} missions, none with the place {mission}")
    return run_of(missions[mission], path, vessel)


def run_of(mission, path, vessel=None):
    track_path = find_track(mission, os.path.dirname(os.path.abspath(path)))
    if track_path is None:
        raise RecordingError(f"{path}: the track '{mission.get('track', '')}' is not there; "
                             "mission_benchmark writes one with --tracks")
    track = load_track(track_path)
    model = load_vessel(vessel or mission.get("vessel") or "otter_gazebo")
    truth = Table(t=track.t, x=track.x, y=track.y, psi=track.psi, u=track.u, v=track.v, r=track.r,
                  thrust_left=track.f_left, thrust_right=track.f_right)
    run = Run(vessel=model, source=str(path), truth=truth, recorded_reference=_reference_of(track),
              label={key: mission[key] for key in _LABELS if key in mission},
              stated={key: value for key, value in mission.items() if key not in _LABELS})
    if mission.get("outcome") == "collided":
        end = len(track) - 1
        run.contacts = table_of(CONTACTS, [(track.t[end], 1.0, track.x[end], track.y[end],
                                            numpy.hypot(track.u[end], track.v[end]))])
    run.details = {"result": os.path.basename(path), "track": os.path.basename(track_path)}
    begin = run.window[0]
    run.events = [Event(begin, "planner", "first trajectory begins"),
                  Event(float(track.t[-1]), "planner",
                        mission.get("outcome", "") +
                        (f": {mission['reason']}" if mission.get("reason") else ""))]
    return run
