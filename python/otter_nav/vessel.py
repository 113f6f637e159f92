"""What reports need of a vessel file (config/vessels/*.yaml), and where the package's files are."""
import os
import pathlib
from dataclasses import dataclass

import yaml

from .errors import RecordingError


@dataclass(frozen=True)
class Vessel:
    name: str
    m1_kg: float
    m2_kgm2: float
    d1_kgps: float
    d2_kgps: float
    d3_kgm2ps: float
    lever_arm_m: float
    ahead_max_n: float
    astern_max_n: float
    top_speed_mps: float
    length_m: float
    beam_m: float


def share_folder():
    """The folder that holds config/ and maps/: OTTER_NAV_SHARE, the source tree, or installed."""
    here = pathlib.Path(__file__).resolve()
    candidates = [os.environ.get("OTTER_NAV_SHARE")]
    for parent in here.parents:
        candidates += [parent, parent / "share" / "otter_nav"]
    candidates += [os.path.join(prefix, "share", "otter_nav")
                   for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep) if prefix]
    for folder in candidates:
        if folder and (pathlib.Path(folder) / "config" / "vessels").is_dir():
            return pathlib.Path(folder)
    return None


def load_vessel(name_or_path):
    """A vessel by its name in config/vessels or by its file."""
    path = pathlib.Path(name_or_path)
    share = share_folder()
    if not path.is_file() and share is not None:
        path = share / "config" / "vessels" / f"{name_or_path}.yaml"
    if not path.is_file():
        raise RecordingError(f"no vessel '{name_or_path}': neither a file nor one of config/vessels")
    try:
        with open(path) as file:
            return vessel_of(yaml.safe_load(file), path)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise RecordingError(f"vessel file {path}: {error}") from error


def vessel_of(data, path):
    """A vessel from its file's content."""
    try:
        model, thrusters = data["paper_model"], data["thrusters"]
        hull = data.get("hull", {})
        return Vessel(name=str(data.get("name", pathlib.Path(path).stem)),
                      **{key: float(model[key])
                         for key in ("m1_kg", "m2_kgm2", "d1_kgps", "d2_kgps", "d3_kgm2ps")},
                      **{key: float(thrusters[key])
                         for key in ("lever_arm_m", "ahead_max_n", "astern_max_n")},
                      top_speed_mps=float(data["top_speed_mps"]),
                      length_m=float(hull["length_m"]), beam_m=float(hull["beam_m"]))
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise RecordingError(f"vessel file {path}: {error!r} is missing or no number") from error


def least_vessel(ahead_n, astern_n):
    """The weakest vessel of config/vessels with such thrust; of several, the first
    by name. None if none has it."""
    share = share_folder()
    if share is None:
        return None
    known = [load_vessel(path) for path in sorted((share / "config" / "vessels").glob("*.yaml"))]
    slack = 1.0 + 1e-3
    able = [vessel for vessel in known if ahead_n <= slack * vessel.ahead_max_n and
            astern_n <= slack * vessel.astern_max_n]
    return min(able, key=lambda vessel: vessel.ahead_max_n, default=None)
