"""The pictures of a report. Each gives an SVG, or None where a run has nothing to show."""
import numpy
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from .chart import Grid
from .svg import COLOUR, SPEED_STEPS, pyplot, styled, to_svg

_WIDE = 9.2    # inches
_LOW = 2.5
_POINTS = 1500  # of a curve: more than a page can show
_CHART_CELLS = 500
_LAND = (0.60, 0.56, 0.46)       # seen well on light and dark water
_UNCHARTED = (0.84, 0.37, 0.0)


def thin(t, *columns):
    """At most _POINTS rows, with the least and largest of each stretch kept."""
    if len(t) <= _POINTS:
        return (t, *columns)
    stretch = 2 * len(t) // _POINTS + 1
    keep = {0, len(t) - 1}
    for column in columns:
        finite = numpy.where(numpy.isfinite(column), column, 0.0)
        for begin in range(0, len(t), stretch):
            part = finite[begin:begin + stretch]
            keep.add(begin + int(numpy.argmin(part)))
            keep.add(begin + int(numpy.argmax(part)))
    rows = numpy.array(sorted(keep))
    return (t[rows], *(column[rows] for column in columns))


def _time_axes(run, height=_LOW, rows=1):
    figure, axes = pyplot.subplots(rows, 1, figsize=(_WIDE, height), sharex=True, squeeze=False)
    axes = axes[:, 0]
    begin, end = run.window
    start = run.motion.t[0]
    for ax in axes:
        ax.set_xlim(0.0, max(run.motion.t[-1] - start, 1e-3))
        for t in _replan_times(run):
            ax.axvline(t - start, color=COLOUR["third"], linewidth=0.8, linestyle=":", zorder=1)
        for t in contact_times(run):
            ax.axvline(t - start, color=COLOUR["fg"], linewidth=2.0, zorder=1)
        for edge in (begin, end):
            ax.axvline(edge - start, color=COLOUR["muted"], linewidth=0.7, zorder=1)
    figure.align_ylabels(axes)
    axes[-1].set_xlabel("time since the recording's first motion, s")
    return figure, axes, start


def _replan_times(run):
    """Of a track alone: where its reference jumps to another trajectory."""
    if run.recorded_reference is not None:
        part = run.reference.part
        return list(run.motion.t[1:][numpy.diff(part) > 0][1:] if part[0] < 0 else
                    run.motion.t[1:][numpy.diff(part) > 0])
    return [t.start for t in run.trajectories[1:] if not t.empty]


def contact_times(run):
    return [float(t) for t, on in zip(run.contacts.t, run.contacts.in_contact) if on > 0]


def _legend(ax, **options):
    ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=6, borderaxespad=0.1,
              handlelength=1.6, columnspacing=1.2, **options)


# ---- the track ---------------------------------------------------------------------------------

def _grid_image(ax, grid, colour, zorder):
    if grid is None or not numpy.any(grid.occupied):
        return
    grid = grid.coarser(_CHART_CELLS)
    image = numpy.zeros(grid.occupied.shape + (4,))
    image[grid.occupied] = colour + (1.0,)
    ax.imshow(image, extent=grid.extent, origin="lower", interpolation="none", zorder=zorder)


def draw_waters(ax, scenario, recorded, box):
    """Chart below, what the chart does not know above it."""
    chart = scenario.chart if scenario is not None else recorded
    world = scenario.world if scenario is not None else None
    names = []
    if chart is not None:
        _grid_image(ax, chart.cut(*box), _LAND, 1)
        names.append(Patch(color=_LAND, label="land on the chart"))
    if world is not None and chart is not None and world.occupied.shape == chart.occupied.shape:
        new = Grid(world.occupied & ~chart.occupied, world.resolution, world.origin).cut(*box)
        if numpy.any(new.occupied):
            _grid_image(ax, new, _UNCHARTED, 2)
            names.append(Patch(color=_UNCHARTED, label="not on the chart"))
    return names


def _box(x, y, margin):
    x, y = x[numpy.isfinite(x)], y[numpy.isfinite(y)]
    west, east, south, north = x.min(), x.max(), y.min(), y.max()
    # Not too slim: a straight way is still a picture.
    size = max(east - west, north - south, 10.0)
    grow_x = max(0.0, 0.45 * size - (east - west)) / 2 + margin
    grow_y = max(0.0, 0.45 * size - (north - south)) / 2 + margin
    return west - grow_x, east + grow_x, south - grow_y, north + grow_y


def speed_scale(top):
    levels = MaxNLocator(SPEED_STEPS, min_n_ticks=5).tick_values(0.0, max(top, 0.1))
    levels = levels[levels <= max(top, 0.1) * 1.0001 + (levels[1] - levels[0])]
    return numpy.linspace(0.0, levels[-1], SPEED_STEPS + 1)


def _coloured(ax, x, y, speed, levels, width):
    """The track as one line for each stretch within one step of the scale."""
    step = numpy.clip(numpy.digitize(speed, levels) - 1, 0, SPEED_STEPS - 1)
    change = numpy.flatnonzero(numpy.diff(step)) + 1
    lines, colours = [], []
    for begin, end in zip(numpy.r_[0, change], numpy.r_[change, len(x)]):
        stop = min(end + 1, len(x))
        lines.append(numpy.column_stack([x[begin:stop], y[begin:stop]]))
        colours.append(COLOUR[f"speed{step[begin]}"])
    ax.add_collection(LineCollection(lines, colors=colours, linewidths=width, capstyle="round",
                                     zorder=5))


def _with_gaps(x, y, part, step):
    """Thinned, with a gap where one trajectory ends and another begins."""
    rows = numpy.arange(0, len(x), step)
    ends = numpy.flatnonzero(numpy.diff(part[rows])) + 1
    return (numpy.insert(x[rows].astype(float), ends, numpy.nan),
            numpy.insert(y[rows].astype(float), ends, numpy.nan))


def _speed_bar(ax, levels):
    # A patch a step: an image could not change its colours with the look.
    bar = ax.inset_axes([1.02, 0.0, 0.025, 1.0])
    for k in range(SPEED_STEPS):
        bar.axhspan(levels[k], levels[k + 1], color=COLOUR[f"speed{k}"], linewidth=0)
    bar.set_ylim(levels[0], levels[-1])
    bar.set_xticks([])
    bar.grid(False)
    bar.yaxis.tick_right()
    bar.yaxis.set_label_position("right")
    bar.set_ylabel("speed over ground, m/s")
    for spine in bar.spines.values():
        spine.set_visible(False)


def track(run, scenario=None, title="", compact=False):
    motion = run.motion
    if len(motion) < 2:
        return None
    with styled():
        step = max(1, len(motion) // 1200)
        x, y = motion.x[::step], motion.y[::step]
        speed = numpy.hypot(motion.u, motion.v)[::step]
        box = _box(numpy.r_[motion.x, run.reference.x], numpy.r_[motion.y, run.reference.y],
                   max(4.0, 3.0 * run.vessel.length_m))
        ratio = (box[3] - box[2]) / (box[1] - box[0])
        width = 5.2 if compact else _WIDE
        inside = float(numpy.clip((width - 1.4) * ratio, 2.2, 4.4 if compact else 8.2))
        height = inside + (1.15 if compact else 0.9)
        figure, ax = pyplot.subplots(figsize=(width, height))
        ax.set_facecolor(COLOUR["water"])
        names = draw_waters(ax, scenario, run.chart, box)
        levels = speed_scale(float(numpy.nanmax(speed)))
        reference = run.reference
        ax.plot(*_with_gaps(reference.x, reference.y, reference.part, step), color=COLOUR["fg"],
                linewidth=0.9, linestyle=(0, (4, 3)), zorder=4)
        _coloured(ax, x, y, speed, levels, 2.2 if compact else 3.0)
        names.append(Line2D([], [], color=COLOUR["fg"], linewidth=0.9, linestyle=(0, (4, 3)),
                            label="reference"))
        names += _marks(ax, run)
        ax.set_xlim(box[0], box[1])
        ax.set_ylim(box[2], box[3])
        ax.set_aspect("equal")
        ax.set_xlabel("east, m")
        ax.set_ylabel("north, m")
        _speed_bar(ax, levels)
        ax.legend(handles=names, loc="upper center", bbox_to_anchor=(0.5, -0.52 / inside),
                  ncol=3 if compact else 8, handletextpad=0.5, columnspacing=1.2)
        return to_svg(figure, title or "Track on the chart, coloured by speed")


def _marks(ax, run):
    """Start, goal, replans, stops and contacts."""
    motion = run.motion
    names = []

    def mark(x, y, label, marker, colour, size=8, **style):
        points = ax.plot(x, y, linestyle="none", marker=marker, color=COLOUR[colour], label=label,
                         markersize=size, markeredgecolor=COLOUR["page"], markeredgewidth=0.9,
                         zorder=7, **style)
        names.extend(points)

    def at(times):
        return motion.at(times, "x"), motion.at(times, "y")

    mark(motion.x[0], motion.y[0], "start", "o", "fg")
    goals = [t.goal for t in run.trajectories if numpy.all(numpy.isfinite(t.goal))]
    end = goals[-1][:2] if goals else (motion.x[-1], motion.y[-1])
    mark(*end, "goal" if goals else "end", "*", "fg", 12)
    replans = _replan_times(run)
    if replans:
        mark(*at(replans), "new trajectory", "D", "third", 6)
    stops = [t for t, state, _ in run.planner_states if state in ("stopping", "stopped")]
    stops += [t.start for t in run.trajectories if t.empty]
    if stops:
        mark(*at(sorted(stops)), "stop", "s", "accent", 7)
    touched = contact_times(run)
    if touched:
        mark(*at(touched), "contact", "X", "left", 10)
    return names


# ---- over time ---------------------------------------------------------------------------------

def errors(run):
    error = run.error
    if not numpy.any(numpy.isfinite(error.distance)):
        return None
    with styled():
        figure, axes, start = _time_axes(run, 4.6, 2)
        for ax, name, label, colour in (
                (axes[0], "along", "along, m\n(+ ahead)", "right"),
                (axes[1], "cross", "across, m\n(+ to port)", "left")):
            t, value = thin(error.t - start, getattr(error, name))
            ax.axhline(0.0, color=COLOUR["muted"], linewidth=0.7)
            ax.plot(t, value, color=COLOUR[colour])
            ax.set_ylabel(label)
        return to_svg(figure, "Along-track and cross-track error over time")


def speed(run):
    motion = run.motion
    with styled():
        figure, (ax,), start = _time_axes(run)
        t, value = thin(motion.t - start, numpy.hypot(motion.u, motion.v))
        ax.plot(t, value, color=COLOUR["right"], label="over ground")
        if numpy.any(numpy.isfinite(run.reference.speed)):
            t, value = thin(motion.t - start, run.reference.speed)
            ax.plot(t, value, color=COLOUR["reference"], linestyle="--", label="reference")
        ax.axhline(run.vessel.top_speed_mps, color=COLOUR["limit"], linestyle="-.", linewidth=1.1,
                   label=f"top speed of {run.vessel.name}")
        ax.set_ylim(bottom=0.0)
        ax.set_ylabel("speed, m/s")
        _legend(ax)
        return to_svg(figure, "Speed over ground, the reference's and the vessel's limit")


def thrusts(run):
    thrust = run.thrusts
    if not len(thrust):
        return None
    with styled():
        figure, axes, start = _time_axes(run, 4.4, 2)
        limits = (run.vessel.ahead_max_n, -run.vessel.astern_max_n)
        for ax, side, label in ((axes[0], "left", "port thruster, N"),
                                (axes[1], "right", "starboard thruster, N")):
            value = getattr(thrust, side)
            for begin, end in stretches(thrust.t, run.at_limit(value)):
                ax.axvspan(begin - start, end - start, color=COLOUR["shade"], alpha=0.35,
                           linewidth=0, zorder=0)
            t, shown = thin(thrust.t - start, value)
            ax.plot(t, shown, color=COLOUR[side], linewidth=1.0)
            for limit in limits:
                ax.axhline(limit, color=COLOUR["limit"], linestyle="-.", linewidth=1.1)
            ax.set_ylim(1.12 * limits[1], 1.12 * limits[0])
            ax.set_ylabel(label)
        axes[0].legend(handles=[Line2D([], [], color=COLOUR["limit"], linestyle="-.", label="limit"),
                                Patch(color=COLOUR["shade"], alpha=0.35, label="saturated")],
                       loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=2, borderaxespad=0.1)
        return to_svg(figure, "Thrusts with their limits; saturated stretches are shaded")


def stretches(t, mask):
    """(from, to) of each run of rows for which the mask holds; near ones are joined."""
    edges = numpy.flatnonzero(numpy.diff(numpy.r_[False, mask, False].astype(int)))
    joined = []
    for begin, end in zip(edges[::2], edges[1::2]):
        span = [float(t[begin]), float(t[min(end, len(t) - 1)])]
        if joined and span[0] - joined[-1][1] < 0.05:
            joined[-1][1] = span[1]
        else:
            joined.append(span)
    return joined


def estimates(run):
    """Estimated force and moment, and wind and current, the true ones beside them."""
    tracker = run.cycles if len(run.cycles) else run.tracker
    felt = len(tracker) and "force_x" in tracker.columns
    streams = [(name, len(getattr(run, name)),
                len(run.cycles) and numpy.any(run.cycles.at(run.cycles.t, name + "_x") != 0.0))
               for name in ("wind", "current")]
    streams = [stream for stream in streams if stream[1] or stream[2]]
    parts = (["force", "moment"] if felt else []) + streams
    if not parts:
        return None
    with styled():
        figure, axes, start = _time_axes(run, 1.7 * len(parts) + 0.5, len(parts))

        def draw(ax, table, column, label, colour, style):
            t, value = thin(table.t - start, getattr(table, column))
            ax.plot(t, value, color=COLOUR[colour], label=label, linestyle=style)

        for ax, part in zip(axes, parts):
            if part == "force":
                draw(ax, tracker, "force_x", "to the east", "right", "-")
                draw(ax, tracker, "force_y", "to the north", "left", (0, (5, 1.5)))
                ax.set_ylabel("estimated\nforce, N")
                _legend(ax)
            elif part == "moment":
                draw(ax, tracker, "moment", "", "third", "-")
                ax.set_ylabel("estimated\nmoment, N m")
            else:
                name, known, estimated = part
                for axis, side, colour in (("x", "east", "right"), ("y", "north", "left")):
                    if known:
                        draw(ax, getattr(run, name), axis, f"true, {side}", colour, ":")
                    if estimated:
                        draw(ax, run.cycles, f"{name}_{axis}", f"estimated, {side}", colour,
                             "-" if axis == "x" else (0, (5, 1.5)))
                ax.set_ylabel(f"{name}, m/s")
                _legend(ax)
        return to_svg(figure, "Estimated force and moment; wind and current, estimated and true")


def clearance(run):
    motion = run.motion
    if "clearance" not in motion.columns:
        return None
    with styled():
        figure, (ax,), start = _time_axes(run, 2.1)
        t, value = thin(motion.t - start, motion.clearance)
        ax.plot(t, value, color=COLOUR["reference"])
        ax.set_ylim(bottom=0.0)
        ax.set_ylabel("hull to the\nnearest thing, m")
        return to_svg(figure, "Clearance of the hull over time")


def solver(run):
    tracker = run.tracker
    if not len(tracker) or "solver_ms_median" not in tracker.columns:
        return None
    with styled():
        figure, (ax,), start = _time_axes(run, 2.2)
        for column, label, colour, style in (
                ("solver_ms_median", "median", "right", "-"),
                ("solver_ms_p99", "99th percentile", "left", (0, (5, 1.5)))):
            t, value = thin(tracker.t - start, getattr(tracker, column))
            ax.plot(t, value, color=COLOUR[colour], linestyle=style, label=label)
        ax.set_ylim(bottom=0.0)
        ax.set_ylabel("control step, ms")
        _legend(ax)
        return to_svg(figure, "Wall time of the tracker's control step")


def planning(run):
    if not run.plans:
        return None
    with styled():
        figure, ax = pyplot.subplots(figsize=(_WIDE, 2.4))
        numbers = numpy.arange(1, len(run.plans) + 1)
        total = numpy.array([plan.planning_ms for plan in run.plans])
        first = numpy.array([plan.first_solution_ms for plan in run.plans])
        ax.bar(numbers, total, width=0.7, color=COLOUR["right"], label="whole plan")
        shown = first > 0.0
        ax.plot(numbers[shown], first[shown], linestyle="none", marker="D", markersize=6,
                color=COLOUR["accent"], markeredgecolor=COLOUR["page"], label="first solution")
        ax.xaxis.set_major_locator(MaxNLocator(integer=True))
        ax.set_xlim(0.4, max(len(numbers), 8) + 0.6)
        ax.set_xlabel("plan, in their order")
        ax.set_ylabel("wall time, ms")
        ax.grid(axis="x", visible=False)
        _legend(ax)
        return to_svg(figure, "Wall time of each plan")


# ---- campaigns ---------------------------------------------------------------------------------

def histogram(values, label, title="", groups=None):
    """One histogram; with groups {name: values} their bars stand on each other."""
    groups = groups or {"": values}
    groups = {name: numpy.asarray(v, dtype=float) for name, v in groups.items()}
    groups = {name: v[numpy.isfinite(v)] for name, v in groups.items()}
    every = numpy.concatenate(list(groups.values())) if groups else numpy.array([])
    if not len(every):
        return None
    with styled():
        figure, ax = pyplot.subplots(figsize=(4.5, 2.5))
        low, high = float(every.min()), float(every.max())
        if high - low < 1e-9:
            low, high = low - 0.5 * max(abs(low), 1e-3), high + 0.5 * max(abs(high), 1e-3)
        colours = [COLOUR[name] for name in ("right", "accent", "reference", "third", "left")]
        ax.hist(list(groups.values()), bins=numpy.linspace(low, high, 21), stacked=True,
                color=[colours[k % len(colours)] for k in range(len(groups))],
                label=list(groups), edgecolor=COLOUR["page"], linewidth=0.6)
        ax.yaxis.set_major_locator(MaxNLocator(6, integer=True))
        ax.xaxis.set_major_locator(MaxNLocator(6))
        ax.set_xlabel(label)
        ax.set_ylabel("number")
        ax.grid(axis="x", visible=False)
        if len(groups) > 1:
            _legend(ax)
        if title:
            ax.set_title(title)
        return to_svg(figure, title or f"Histogram of {label}")


def bars(names, values, label, marks=None):
    """Horizontal bars; `marks` {name of mark: value} are lines across."""
    with styled():
        figure, ax = pyplot.subplots(figsize=(_WIDE, 0.32 * len(names) + 1.1))
        places = numpy.arange(len(names))[::-1]
        ax.barh(places, values, height=0.66, color=COLOUR["right"])
        for k, (name, value) in enumerate((marks or {}).items()):
            ax.axvline(value, color=COLOUR["left" if k == 0 else "reference"],
                       linestyle="--" if k == 0 else "-.", linewidth=1.2, label=name)
        ax.set_yticks(places, names)
        ax.set_xlabel(label)
        ax.grid(axis="y", visible=False)
        if marks:
            _legend(ax)
        return to_svg(figure, label)


def planned_way(path, scenario, title):
    """A dumped plan on its world."""
    with styled():
        box = _box(path.x, path.y, 6.0)
        ratio = (box[3] - box[2]) / (box[1] - box[0])
        figure, ax = pyplot.subplots(figsize=(5.2, float(numpy.clip(3.8 * ratio, 2.4, 4.4)) + 0.9))
        ax.set_facecolor(COLOUR["water"])
        draw_waters(ax, scenario, None, box)
        step = max(1, len(path) // 800)
        value = numpy.hypot(path.u, path.v)[::step]
        levels = speed_scale(float(value.max()))
        _coloured(ax, path.x[::step], path.y[::step], value, levels, 2.2)
        ax.set_xlim(box[0], box[1])
        ax.set_ylim(box[2], box[3])
        ax.set_aspect("equal")
        ax.set_xlabel("east, m")
        ax.set_ylabel("north, m")
        _speed_bar(ax, levels)
        return to_svg(figure, title)
