"""Occupancy grids of charts and worlds: map_server's YAML with PGM or PNG, or a message."""
import os
from dataclasses import dataclass

import numpy
import yaml

from .errors import RecordingError


@dataclass
class Grid:
    occupied: numpy.ndarray   # bool; row 0 is the southernmost
    resolution: float         # m
    origin: tuple             # x m, y m of the lower left corner

    @property
    def extent(self):
        """(west, east, south, north), m."""
        rows, columns = self.occupied.shape
        return (self.origin[0], self.origin[0] + columns * self.resolution,
                self.origin[1], self.origin[1] + rows * self.resolution)

    @staticmethod
    def from_message(message):
        info = message.info
        cells = numpy.array(message.data, dtype=numpy.int8).reshape(info.height, info.width)
        position = info.origin.position
        return Grid(cells > 65, info.resolution, (position.x, position.y))

    def cut(self, west, east, south, north):
        """The part inside, at least a cell."""
        rows, columns = self.occupied.shape
        x0, y0 = self.origin
        left = int(numpy.clip((west - x0) / self.resolution, 0, columns - 1))
        right = int(numpy.clip(numpy.ceil((east - x0) / self.resolution), left + 1, columns))
        low = int(numpy.clip((south - y0) / self.resolution, 0, rows - 1))
        high = int(numpy.clip(numpy.ceil((north - y0) / self.resolution), low + 1, rows))
        return Grid(self.occupied[low:high, left:right], self.resolution,
                    (x0 + left * self.resolution, y0 + low * self.resolution))

    def coarser(self, cells_max):
        """No more cells on a side than that; a cell is occupied if anything in it is."""
        step = int(numpy.ceil(max(self.occupied.shape) / cells_max))
        if step <= 1:
            return self
        rows, columns = self.occupied.shape
        padded = numpy.zeros((-(-rows // step) * step, -(-columns // step) * step), dtype=bool)
        padded[:rows, :columns] = self.occupied
        blocks = padded.reshape(padded.shape[0] // step, step, padded.shape[1] // step, step)
        return Grid(blocks.any(axis=(1, 3)), self.resolution * step, self.origin)


@dataclass
class Scenario:
    chart: Grid = None
    world: Grid = None
    missions: list = None
    path: str = ""


def load_grid(path):
    """map_server's YAML; unknown cells are not occupied."""
    from PIL import Image
    try:
        with open(path) as file:
            meta = yaml.safe_load(file)
        image = Image.open(os.path.join(os.path.dirname(path), meta["image"])).convert("L")
        shade = numpy.asarray(image, dtype=float) / 255.0
        dark = shade if meta.get("negate", 0) else 1.0 - shade
        return Grid(numpy.flipud(dark > float(meta.get("occupied_thresh", 0.65))),
                    float(meta["resolution"]), tuple(float(v) for v in meta["origin"][:2]))
    except (OSError, KeyError, TypeError, ValueError, SyntaxError, yaml.YAMLError) as error:
        # PIL's SyntaxError: a PNG that is broken.
        raise RecordingError(f"chart {path}: {error}") from error


def load_scenario(path):
    """A scenario's chart and world; a chart's YAML alone will do."""
    try:
        with open(path) as file:
            data = yaml.safe_load(file)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise RecordingError(f"scenario {path}: {error}") from error
    if not isinstance(data, dict):
        raise RecordingError(f"scenario {path}: neither a scenario nor a chart")
    if "image" in data:
        return Scenario(chart=load_grid(path), path=str(path))
    if "chart" not in data:
        raise RecordingError(f"scenario {path}: has no 'chart'")
    world = data.get("world")
    for name, value in (("chart", data["chart"]), ("world", world)):
        if not isinstance(value, str) and (name == "chart" or value is not None):
            raise RecordingError(f"scenario {path}: '{name}' is no file's name: {value}")
    folder = os.path.dirname(path)
    return Scenario(chart=load_grid(os.path.join(folder, data["chart"])),
                    world=load_grid(os.path.join(folder, world)) if world else None,
                    missions=data.get("missions"), path=str(path))
