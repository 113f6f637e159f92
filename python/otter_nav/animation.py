"""The program `animate`: a run as a moving picture, GIF or MP4."""
import argparse
import os
import shutil
import subprocess
import sys

import numpy

from .errors import RecordingError
from .report import add_source_arguments, load

# As the nautical chart in rviz (src/rviz/nautical_palette.hpp).
_WATER = (230, 243, 248)     # seen free, or all of it where no scans were recorded
_UNSEEN = (169, 203, 224)
_LAND = (216, 196, 138)
_COAST = (125, 106, 60)
_UNCHARTED = (208, 52, 44)   # where scans show what was sensed, what was not is pale
_HIDDEN = (214, 178, 184)
_COAST_M = 0.6               # charts and echoes agree to about that
_GRID = (214, 225, 233)
_INK = (28, 33, 38)
_MUTED = (91, 100, 110)
_PORT = (213, 94, 0)
_STARBOARD = (0, 114, 178)
_HULL = (255, 255, 255)
_PANEL = 64          # pixels below the chart
_FRAMES_MAX = 3000
# From slow to fast, as include/otter_nav/ros/speed_colour.hpp.
_SCALE = numpy.array([(13, 8, 135), (128, 3, 168), (204, 71, 120), (250, 153, 56)], dtype=float)


class View:
    """Between the map's metres and the picture's pixels."""

    def __init__(self, box, width):
        self.west, self.east, self.south, self.north = box
        self.scale = width / (self.east - self.west)
        self.width = width
        # Even, as the encoders of films want it.
        self.height = 2 * round(self.scale * (self.north - self.south) / 2)

    def __call__(self, x, y):
        return (numpy.asarray(x) - self.west) * self.scale, (self.north - numpy.asarray(y)) * self.scale

    def points(self, x, y):
        px, py = self(x, y)
        return list(zip(px.tolist(), py.tolist()))


def _box(run):
    x = numpy.r_[run.motion.x, run.reference.x[numpy.isfinite(run.reference.x)]]
    y = numpy.r_[run.motion.y, run.reference.y[numpy.isfinite(run.reference.y)]]
    margin = max(6.0, 4.0 * run.vessel.length_m)
    west, east, south, north = x.min() - margin, x.max() + margin, y.min() - margin, y.max() + margin
    # Neither a slit nor a tower.
    grow_x = max(0.0, 0.8 * (north - south) - (east - west)) / 2
    grow_y = max(0.0, 0.5 * (east - west) - (north - south)) / 2
    return west - grow_x, east + grow_x, south - grow_y, north + grow_y


def _paint_grid(image, view, grid, colour):
    """Cells of a grid, by looking up each pixel's."""
    x = view.west + (numpy.arange(view.width) + 0.5) / view.scale
    y = view.north - (numpy.arange(view.height) + 0.5) / view.scale
    column = numpy.floor((x - grid.origin[0]) / grid.resolution).astype(int)
    row = numpy.floor((y - grid.origin[1]) / grid.resolution).astype(int)
    rows, columns = grid.occupied.shape
    inside_x, inside_y = (column >= 0) & (column < columns), (row >= 0) & (row < rows)
    cells = grid.occupied[numpy.ix_(row.clip(0, rows - 1), column.clip(0, columns - 1))]
    image[cells & inside_y[:, None] & inside_x[None, :]] = colour


def _background(run, scenario, view):
    from PIL import Image, ImageDraw
    pixels = numpy.empty((view.height, view.width, 3), dtype=numpy.uint8)
    pixels[:] = _UNSEEN if run.scans else _WATER
    chart = scenario.chart if scenario is not None else run.chart
    if scenario is not None and scenario.world is not None:
        _paint_grid(pixels, view, scenario.world, _HIDDEN if run.scans else _UNCHARTED)
    if chart is not None:
        _paint_grid(pixels, view, chart, _LAND)
        land = numpy.all(pixels == _LAND, axis=2)
        inland = numpy.zeros_like(land)
        inland[1:-1, 1:-1] = (land[:-2, 1:-1] & land[2:, 1:-1] & land[1:-1, :-2] & land[1:-1, 2:])
        pixels[land & ~inland] = _COAST
    image = Image.new("RGB", (view.width, view.height + _PANEL), _HULL)
    image.paste(Image.fromarray(pixels), (0, 0))
    draw = ImageDraw.Draw(image)
    step = _nice((view.east - view.west) / 5.0)
    x, y = 0.04 * view.width, 0.95 * view.height
    draw.line([(x, y), (x + step * view.scale, y)], fill=_INK, width=3)
    draw.text((x, y - 18), f"{step:g} m", fill=_INK, font=_font(13))
    return image


def _nice(length):
    power = 10.0 ** numpy.floor(numpy.log10(length))
    return float(max(step for step in (1, 2, 5, 10) if step * power <= length * 1.0001) * power)


def _font(size):
    from PIL import ImageFont
    for name in ("DejaVuSans.ttf", "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"):
        try:
            return ImageFont.truetype(name, size)
        except OSError:
            continue
    try:  # matplotlib brings its own
        from matplotlib import font_manager
        return ImageFont.truetype(font_manager.findfont("DejaVu Sans"), size)
    except (ImportError, OSError):
        return ImageFont.load_default()


def _colour(share):
    place = float(numpy.clip(share, 0.0, 1.0)) * (len(_SCALE) - 1)
    low = int(min(place, len(_SCALE) - 2))
    return tuple(int(v) for v in _SCALE[low] + (place - low) * (_SCALE[low + 1] - _SCALE[low]))


def _state_at(run, t):
    states = [state for since, state, _ in run.planner_states if since <= t + 1e-9]
    return states[-1] if states else ""


class Film:
    """Draws the frames of a run one after another."""

    def __init__(self, run, scenario, width):
        from PIL import ImageDraw
        self._draw_on = ImageDraw.Draw
        self.run = run
        self.view = View(_box(run), width)
        self.background = _background(run, scenario, self.view)
        self.top = run.vessel.top_speed_mps
        self.font, self.small = _font(15), _font(12)
        self.error = run.error
        self.drawn = 0  # rows of the motion already in the background's trail
        self.looked = 0  # scans already in the background
        self.ashore = self._near_land()

    def frame(self, t):
        """The picture at time t; times must not fall."""
        row = int(numpy.searchsorted(self.run.motion.t, t + 1e-9)) - 1
        row = max(row, 0)
        self._look(t)
        self._extend_trail(row)
        image = self.background.copy()
        draw = self._draw_on(image)
        self._reference(draw, row)
        self._hull(draw, row)
        self._panel(draw, t, row)
        return image

    def _near_land(self):
        """Pixels so near to charted land that an echo there is the coast's."""
        from PIL import Image, ImageFilter
        pixels = numpy.array(self.background)[:self.view.height]
        land = numpy.all(pixels == _LAND, axis=2) | numpy.all(pixels == _COAST, axis=2)
        size = 2 * int(_COAST_M * self.view.scale) + 1
        return numpy.asarray(Image.fromarray(land).convert("L").filter(ImageFilter.MaxFilter(size))) > 0

    def _look(self, t):
        """Paints what the scans up to then have seen, under the trail."""
        from PIL import Image
        motion, scans = self.run.motion, self.run.scans
        if self.looked == len(scans) or scans[self.looked].t > t + 1e-9:
            return
        size = self.view.width, self.view.height
        seen, echoes = Image.new("1", size), Image.new("1", size)
        fan, dots = self._draw_on(seen), self._draw_on(echoes)
        psi_rad = numpy.unwrap(motion.psi)
        while self.looked < len(scans) and scans[self.looked].t <= t + 1e-9:
            scan = scans[self.looked]
            self.looked += 1
            psi = float(numpy.interp(scan.t, motion.t, psi_rad))
            ahead, port = scan.mount
            place = (float(numpy.interp(scan.t, motion.t, motion.x)) +
                     ahead * numpy.cos(psi) - port * numpy.sin(psi),
                     float(numpy.interp(scan.t, motion.t, motion.y)) +
                     ahead * numpy.sin(psi) + port * numpy.cos(psi))
            ranges = numpy.where(numpy.isfinite(scan.ranges), scan.ranges,
                                 numpy.where(numpy.isposinf(scan.ranges), scan.range_max, 0.0))
            angles = psi + scan.angle_min + scan.angle_increment * numpy.arange(len(ranges))
            x, y = place[0] + ranges * numpy.cos(angles), place[1] + ranges * numpy.sin(angles)
            fan.polygon(self.view.points(numpy.r_[place[0], x], numpy.r_[place[1], y]), fill=1)
            hit = numpy.isfinite(scan.ranges)
            for px, py in self.view.points(x[hit], y[hit]):
                dots.ellipse([px - 1.5, py - 1.5, px + 1.5, py + 1.5], fill=1)
        pixels = numpy.array(self.background)
        chart = pixels[:self.view.height]
        water = numpy.all(chart == _UNSEEN, axis=2)
        chart[numpy.asarray(seen) & water] = _WATER
        bare = numpy.any([numpy.all(chart == shade, axis=2) for shade in (_WATER, _UNSEEN, _HIDDEN)],
                         axis=0)
        chart[numpy.asarray(echoes) & bare & ~self.ashore] = _UNCHARTED
        self.background = Image.fromarray(pixels)

    def _extend_trail(self, row):
        motion = self.run.motion
        draw = self._draw_on(self.background)
        speed = numpy.hypot(motion.u, motion.v)
        while self.drawn < row:
            end = min(row, self.drawn + max(1, len(motion) // 800))
            ends = [self.drawn, end]
            draw.line(self.view.points(motion.x[ends], motion.y[ends]),
                      fill=_colour(speed[end] / self.top), width=4)
            self.drawn = end

    def _reference(self, draw, row):
        """What lies ahead on the trajectory in force."""
        reference, number = self.run.reference, self.run.reference.part[row]
        if number < 0:
            return
        if self.run.recorded_reference is None:
            trajectory = self.run.trajectories[number]
            if trajectory.empty:
                return
            t = numpy.arange(self.run.motion.t[row], trajectory.start + trajectory.duration, 0.25)
            if len(t) < 2:
                return
            ahead = trajectory.sample(t, self.run.vessel)
            points = self.view.points(ahead.x, ahead.y)
        else:
            step = max(1, len(reference) // 800)
            ahead = numpy.flatnonzero(reference.part == number)
            ahead = ahead[ahead >= row][::step]
            points = self.view.points(reference.x[ahead], reference.y[ahead])
        for begin in range(0, len(points) - 1, 2):
            draw.line(points[begin:begin + 2], fill=_INK, width=1)

    def _hull(self, draw, row):
        motion, vessel = self.run.motion, self.run.vessel
        # Never smaller than one can see.
        grow = max(1.0, 16.0 / (vessel.length_m * self.view.scale))
        length, beam = grow * vessel.length_m / 2, grow * vessel.beam_m / 2
        shape = numpy.array([(1, 0), (0.55, 1), (-1, 1), (-1, -1), (0.55, -1)]) * (length, beam)
        c, s = numpy.cos(motion.psi[row]), numpy.sin(motion.psi[row])
        x = motion.x[row] + c * shape[:, 0] - s * shape[:, 1]
        y = motion.y[row] + s * shape[:, 0] + c * shape[:, 1]
        points = self.view.points(x, y)
        touching = self._touching(row)
        draw.polygon(points, fill=_PORT if touching else _HULL)
        draw.line(points + points[:1], fill=_INK, width=2)

    def _touching(self, row):
        truth = self.run.truth
        return "in_contact" in truth.columns and len(truth) and bool(truth.in_contact[row] > 0)

    def _panel(self, draw, t, row):
        motion, top = self.run.motion, self.view.height
        draw.line([(0, top), (self.view.width, top)], fill=_MUTED, width=1)
        speed = float(numpy.hypot(motion.u[row], motion.v[row]))
        error = self.error.distance[row]
        gap = "–" if numpy.isnan(error) else f"{error:.3f} m"
        draw.text((14, top + 9), f"{t - motion.t[0]:.1f} s   {speed:.2f} m/s", fill=_INK,
                  font=self.font)
        draw.text((14, top + 36), f"error {gap}   {_state_at(self.run, t)}", fill=_MUTED,
                  font=self.small)
        self._thrust_bars(draw, t, top)

    def _thrust_bars(self, draw, t, top):
        thrust, vessel = self.run.thrusts, self.run.vessel
        if not len(thrust):
            return
        half, right = min(70, self.view.width // 8), self.view.width - 14
        for k, (side, colour, name) in enumerate((("left", _PORT, "port"),
                                                  ("right", _STARBOARD, "starboard"))):
            value = float(numpy.interp(t, thrust.t, getattr(thrust, side)))
            y, middle = top + 14 + 22 * k, right - half
            draw.rectangle([right - 2 * half, y, right, y + 12], outline=_MUTED)
            limit = vessel.ahead_max_n if value >= 0.0 else vessel.astern_max_n
            reach = int(half * numpy.clip(value / limit, -1.0, 1.0))
            draw.rectangle([min(middle, middle + reach), y + 1, max(middle, middle + reach), y + 11],
                           fill=colour)
            draw.line([(middle, y - 2), (middle, y + 14)], fill=_INK, width=1)
            width = draw.textlength(name, font=self.small)
            draw.text((right - 2 * half - 8 - width, y - 2), name, fill=_INK, font=self.small)


def frame_times(run, speed, rate):
    """When the frames are of: `rate` a second of film, `speed` times as fast as life."""
    begin, end = float(run.motion.t[0]), float(run.motion.t[-1])
    count = int((end - begin) / speed * rate) + 1
    if count > _FRAMES_MAX:
        raise RecordingError(f"that would be {count} frames, at most {_FRAMES_MAX} are drawn: raise "
                             "--speed or lower --rate")
    times = begin + numpy.arange(count) * speed / rate
    return times if end - times[-1] < 1e-6 else numpy.append(times, end)


def write_gif(path, frames, rate):
    from PIL import Image
    small = []
    palette = None
    for frame in frames:
        # One palette for all, so that nothing flickers; nothing but the first frame is kept whole.
        if palette is None:
            palette = _palette_image()
        small.append(frame.quantize(palette=palette, dither=Image.Dither.NONE))
    if not small:
        raise RecordingError("nothing to draw")
    durations = [max(20, int(round(1000.0 / rate)))] * len(small)
    durations[-1] = 2000
    small[0].save(path, save_all=True, append_images=small[1:], duration=durations, loop=0,
                  optimize=False, disposal=1)


def _palette_image():
    from PIL import Image
    fixed = [_WATER, _UNSEEN, _LAND, _COAST, _HIDDEN, _UNCHARTED, _GRID, _INK, _MUTED, _PORT, _STARBOARD, _HULL]
    scale = [_colour(k / 63) for k in range(64)]
    grey = [(v, v, v) for v in range(0, 256, 8)]
    # Between the ink and what it is written on.
    tints = [tuple(int(a + (b - a) * k / 8) for a, b in zip(_INK, base))
             for base in (_WATER, _LAND, _HULL) for k in range(1, 8)]
    colours = (fixed + scale + grey + tints + [(0, 0, 0)] * 256)[:256]
    image = Image.new("P", (1, 1))
    image.putpalette([value for colour in colours for value in colour])
    return image


def write_film(path, frames, rate, size):
    program = shutil.which("ffmpeg")
    if program is None:
        raise RecordingError("an MP4 needs ffmpeg, which is not installed; a GIF does not")
    command = [program, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
               f"{size[0]}x{size[1]}", "-r", str(rate), "-i", "-", "-pix_fmt", "yuv420p",
               "-movflags", "+faststart", path]
    encoder = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        for frame in frames:
            encoder.stdin.write(frame.tobytes())
    except BrokenPipeError:
        pass
    _, complaint = encoder.communicate()
    if encoder.returncode != 0:
        raise RecordingError(f"ffmpeg: {complaint.decode(errors='replace').strip()}")


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="animate", description="Makes a moving picture of a run.")
    add_source_arguments(parser)
    parser.add_argument("--out", required=True, help="file.gif, or file.mp4 where ffmpeg is installed")
    parser.add_argument("--speed", type=float, default=8.0, help="times real time (default 8)")
    parser.add_argument("--rate", type=float, default=12.0, help="frames a second (default 12)")
    parser.add_argument("--width", type=int, default=640, help="pixels (default 640)")
    options = parser.parse_args(arguments)
    try:
        ending = os.path.splitext(options.out)[1].lower()
        if ending not in (".gif", ".mp4"):
            raise RecordingError(f"--out {options.out}: has to end in .gif or .mp4")
        if not 0.0 < options.speed < numpy.inf or not 1.0 <= options.rate <= 50.0:
            raise RecordingError("--speed has to be a number above 0, --rate from 1 to 50")
        if not 400 <= options.width <= 3840:
            raise RecordingError("--width has to be from 400 to 3840 pixels")
        run, scenario, _ = load(options)
        film = Film(run, scenario, options.width - options.width % 2)
        times = frame_times(run, options.speed, options.rate)
        os.makedirs(os.path.dirname(os.path.abspath(options.out)), exist_ok=True)
        frames = (film.frame(t) for t in times)
        if ending == ".gif":
            write_gif(options.out, frames, options.rate)
        else:
            write_film(options.out, frames, options.rate, film.background.size)
        print(f"{options.out}: {len(times)} frames, {os.path.getsize(options.out) / 1e6:.1f} MB")
    except (RecordingError, OSError) as error:
        print(f"animate: {error}", file=sys.stderr)
        return 1
    return 0
