"""Pages of campaigns: what mission_benchmark, planner_benchmark and tracking_benchmark wrote."""
import glob
import math
import os
import sys

import numpy

from .chart import load_scenario
from .errors import RecordingError
from .page import Page, number
from .result import find_track, load_json, run_of
from .table import Table
from .vessel import share_folder

_WORST = 4          # cases with pictures
_FIGURES = ("tracking_error_mean_m", "tracking_error_max_m", "min_clearance_m", "duration_s", "replans",
            "planning_ms_max", "tracker_ms_p99")  # of each mission
_PLAN_LABELS = ("scenario", "mission", "kind", "method", "seed", "reason", "first_solution_ms")
_PLAN_NUMBERS = ("total_ms", "length_m", "duration_s")
_METHOD_NUMBERS = ("length_m_mean", "duration_s_mean", "cost_mean", "node_utilization_mean",
                   "total_ms_mean", "total_ms_median", "total_ms_p95", "success_rate_100ms",
                   "success_rate_1s")
_HISTOGRAMS = (("tracking_error_mean_m", "mean tracking error, m"),
               ("tracking_error_max_m", "largest tracking error, m"),
               ("min_clearance_m", "least clearance, m"),
               ("duration_s", "duration, s"),
               ("planning_ms_max", "slowest plan, ms"),
               ("tracker_ms_p99", "control step, 99th percentile, ms"))
# Tables I and II of the paper (docs/planner.md, docs/tracker.md).
_PAPER_PLANS = {"baseline": (71.4, 20.5, 24.3, 29.7, 58.1, 86),
                "local": (71.8, 20.8, 24.2, 40.6, 47.8, 96),
                "global": (69.6, 21.6, 22.1, 30.8, 60.2, 84),
                "proposed": (69.3, 21.3, 21.9, 41.8, 45.6, 98)}
_PAPER_TRACKING = (("the paper's, without flatness", 0.257, 0.768, 2.93, 4.31, 2.01),
                   ("the paper's, with flatness", 0.121, 0.483, 3.32, 4.37, 0.95))


def campaign_page(folder, scenarios=None):
    """(page, figures) of every result in a folder and those below it."""
    missions, plans, tracking = _gather(folder)
    page = Page(f"Campaign {os.path.basename(os.path.abspath(folder))}")
    counts = [f"{len(items)} {name}" for name, items in (
        ("missions", missions), ("plans", [c for p in plans for c in p[1]["cases"]]),
        ("tracking runs", tracking)) if items]
    page.heading(page.title, ", ".join(counts))
    charts = _Charts(scenarios)
    figures = {}
    if missions:
        figures["missions"] = _missions(page, missions, charts)
    if plans:
        figures["plans"] = _plans(page, plans, charts, folder)
    if tracking:
        figures["tracking"] = _tracking(page, tracking)
    return page, figures


def _gather(folder):
    if not os.path.isdir(folder):
        raise RecordingError(f"{folder}: no such folder")
    missions, plans, tracking = [], [], []
    for path in sorted(glob.glob(os.path.join(glob.escape(folder), "**", "*.json"), recursive=True)):
        try:
            data = load_json(path)
        except RecordingError as error:
            print(f"left out: {error}", file=sys.stderr)
            continue
        if not isinstance(data, dict):
            continue
        if isinstance(data.get("missions"), list):
            lacking = _lacking("mission", data["missions"], figures=_FIGURES)
            found, those = missions, [(path, mission) for mission in data["missions"]]
        elif isinstance(data.get("cases"), list) and "summary" in data:
            lacking = _plans_lack(data)
            found, those = plans, [(path, data)]
        elif "mean_error_m" in data and "path" in data:
            lacking = _lacks(data, ("vessel",), ("mean_error_m",))
            found, those = tracking, [(path, data)]
        else:
            continue
        if lacking:
            print(f"left out: {path}: {lacking}", file=sys.stderr)
        else:
            found += those
    if not (missions or plans or tracking):
        raise RecordingError(f"{folder}: no result of mission_benchmark, planner_benchmark or "
                             "tracking_benchmark (--out) in it")
    return missions, plans, tracking


def _lacking(what, items, labels=(), numbers=(), figures=()):
    """What the first item that can't be counted lacks; empty if all can."""
    for k, item in enumerate(items):
        lacks = _lacks(item, labels, numbers, figures)
        if lacks:
            return f"{what} {k} {lacks}"
    return ""


def _lacks(item, labels=(), numbers=(), figures=()):
    """Of labels, of numbers, and of figures, which are null where there was nothing to measure."""
    if not isinstance(item, dict):
        return "is no mapping"
    missing = [name for name in figures if not _is_figure(item.get(name, ""))]
    missing += [name for name in numbers if item.get(name) is None or not _is_figure(item[name])]
    if missing:
        return f"has no number for {', '.join(missing)}"
    missing = [name for name in labels if name not in item]
    return f"has no {', '.join(missing)}" if missing else ""


def _plans_lack(data):
    lacking = _lacking("case", data["cases"], _PLAN_LABELS, _PLAN_NUMBERS)
    summary = data["summary"]
    if lacking or not isinstance(summary, dict):
        return lacking or "its summary is no mapping"
    for kind, methods in summary.items():
        for method, row in methods.items() if isinstance(methods, dict) else [("", None)]:
            lacks = _lacks(row, numbers=_METHOD_NUMBERS)
            if lacks:
                return f"its summary of {kind} {method} {lacks}"
    return ""


def _is_figure(value):
    return value is None or (isinstance(value, (int, float)) and math.isfinite(value))


class _Charts:
    """Scenarios by name, each read once; none where it is not found."""

    def __init__(self, folder):
        if folder and not os.path.exists(folder):
            raise RecordingError(f"--scenarios: no folder '{folder}'")
        share = share_folder()
        self._folders = [f for f in (folder, share and str(share / "maps")) if f]
        self._known = {}

    def get(self, name):
        if name not in self._known:
            pattern = os.path.join("**", glob.escape(str(name)) + ".yaml")
            found = [path for folder in self._folders for path in
                     sorted(glob.glob(os.path.join(glob.escape(folder), pattern), recursive=True))]
            self._known[name] = load_scenario(found[0]) if found else None
        return self._known[name]


# ---- missions ----------------------------------------------------------------------------------

def _column(missions, key):
    return numpy.array([m.get(key, numpy.nan) for m in missions], dtype=float)


def _figure(of, missions, key):
    """Of the missions of which it was measured; None without."""
    values = _column(missions, key)
    values = values[~numpy.isnan(values)]
    return float(of(values)) if len(values) else None


def _summary(missions):
    return {"count": len(missions),
            "arrived": sum(m.get("outcome") == "arrived" for m in missions),
            "tracking_error_mean_m": _figure(numpy.mean, missions, "tracking_error_mean_m"),
            "tracking_error_max_m": _figure(numpy.max, missions, "tracking_error_max_m"),
            "min_clearance_m": _figure(numpy.min, missions, "min_clearance_m"),
            "duration_s_mean": _figure(numpy.mean, missions, "duration_s"),
            "replans_mean": _figure(numpy.mean, missions, "replans"),
            "planning_ms_max": _figure(numpy.max, missions, "planning_ms_max"),
            "tracker_ms_p99_max": _figure(numpy.max, missions, "tracker_ms_p99")}


def _missions(page, found, charts):
    from . import pictures
    missions = [mission for _, mission in found]
    total = _summary(missions)
    page.figures([("arrived", f"{total['arrived']} of {total['count']}", ""),
                  ("mean tracking error", number(total["tracking_error_mean_m"]), "m"),
                  ("largest tracking error", number(total["tracking_error_max_m"]), "m"),
                  ("least clearance", number(total["min_clearance_m"], 2), "m"),
                  ("slowest plan", number(total["planning_ms_max"], 0), "ms"),
                  ("slowest 99 % step", number(total["tracker_ms_p99_max"]), "ms")])
    groups = {}
    for mission in missions:
        key = tuple(str(mission.get(name, "")) for name in ("vessel", "disturbance", "scenario"))
        groups.setdefault(key, []).append(mission)
    page.section("Missions by scenario")
    rows = []
    for key in sorted(groups):
        s = _summary(groups[key])
        rows.append((*key, f"{s['arrived']} of {s['count']}", number(s["tracking_error_mean_m"]),
                     number(s["tracking_error_max_m"]), number(s["min_clearance_m"], 2),
                     number(s["duration_s_mean"], 1), number(s["replans_mean"], 1),
                     number(s["planning_ms_max"], 0), number(s["tracker_ms_p99_max"])))
    page.table(("vessel", "disturbance", "scenario", "arrived", "mean error, m", "largest, m",
                "least clearance, m", "duration, s", "replans", "slowest plan, ms",
                "99 % step, ms"), rows, numbers=range(3, 11))
    page.section("How they spread", "Each mission counts once.")
    vessels = sorted({str(m.get("vessel", "")) for m in missions})
    page.pictures([pictures.histogram(None, label, groups={
        vessel: _column([m for m in missions if str(m.get("vessel", "")) == vessel], key)
        for vessel in vessels}) for key, label in _HISTOGRAMS])
    _failures(page, missions)
    _worst_missions(page, found, charts, pictures)
    return {**total, "by_scenario": {" ".join(key): _summary(groups[key]) for key in sorted(groups)}}


def _failures(page, missions):
    failed = [m for m in missions if m.get("outcome") != "arrived"]
    if failed:
        page.section("Those that did not arrive")
        keys = ("scenario", "mission", "vessel", "disturbance", "seed", "outcome", "reason")
        page.table(keys, [tuple(str(m.get(key, "")) for key in keys) for m in failed])


def _name(mission):
    return f"{mission.get('scenario')}, mission {mission.get('mission')}, {mission.get('vessel')}"


def _largest_error(mission):
    """0 where none was measured, which JSON tells as null."""
    return mission.get("tracking_error_max_m") or 0.0


def _worst_missions(page, found, charts, pictures):
    """First what did not arrive, then by the largest error."""
    order = sorted(found, key=lambda entry: (entry[1].get("outcome") == "arrived",
                                             -_largest_error(entry[1])))
    drawn, titles = [], []
    for path, mission in order:
        if len(drawn) == _WORST:
            break
        try:
            if find_track(mission, os.path.dirname(os.path.abspath(path))) is None:
                continue
        except RecordingError as error:
            print(f"left out: {path}: {error}", file=sys.stderr)
            continue
        title = (f"{_name(mission)}: {mission.get('outcome')}, "
                 f"{_largest_error(mission):.2f} m at most")
        drawn.append(pictures.track(run_of(mission, path), charts.get(mission.get("scenario")), title,
                                    compact=True))
        titles.append(title)
    if drawn:
        page.section("Worst cases", "First those that did not arrive, then by their largest error.")
        page.pictures(drawn, titles)
    else:
        page.raw('<p class="note">No tracks were written (mission_benchmark --tracks), so there are '
                 "no pictures of the worst cases.</p>")


# ---- plans -------------------------------------------------------------------------------------

def _plans(page, found, charts, folder):
    from . import pictures
    cases = []
    for path, data in found:
        page.section(f"Table I: {data.get('vessel', '')} on {data.get('map', '')} maps",
                     f"{os.path.basename(path)}, {len(data['cases'])} plans. Success: verified whole, "
                     "within 100 ms.")
        for kind, methods in data["summary"].items():
            _table_one(page, kind, methods)
        cases += [(path, case) for case in data["cases"]]
    solved = [case for _, case in cases if case.get("success")]
    methods = sorted({case.get("method", "") for _, case in cases})

    def by_method(get):
        return {method: [get(case) for case in solved if case.get("method", "") == method]
                for method in methods}
    page.section("How plans spread", "Of those that were solved.")
    page.pictures([
        pictures.histogram(None, "whole plan, ms", groups=by_method(lambda c: c["total_ms"])),
        pictures.histogram(None, "first solution, ms", groups=by_method(
            lambda c: numpy.nan if c["first_solution_ms"] is None else c["first_solution_ms"])),
        pictures.histogram(None, "length over the shortest", groups=by_method(
            lambda c: c["length_m"] / c["shortest_m"] if c.get("shortest_m", 0) > 0 else numpy.nan)),
        pictures.histogram(None, "mean speed, m/s", groups=by_method(
            lambda c: c["length_m"] / c["duration_s"] if c["duration_s"] > 0 else numpy.nan))])
    _plans_by_scenario(page, [case for _, case in cases])
    failed = [case for _, case in cases if not case.get("success")]
    if failed:
        page.section("Plans that failed")
        page.table(("scenario", "mission", "kind", "method", "seed", "reason", "ms"),
                   [(c["scenario"], c["mission"], c["kind"], c["method"], c["seed"], c["reason"],
                     f"{c['total_ms']:.0f}") for c in failed[:60]], numbers=(1, 4, 6))
    _worst_plans(page, cases, charts, pictures, folder)
    times = [case["total_ms"] for _, case in cases]
    return {"count": len(cases), "solved": len(solved),
            "total_ms_median": float(numpy.median(times)) if times else None,
            "total_ms_max": float(numpy.max(times)) if times else None,
            "summary": {os.path.basename(path): data["summary"] for path, data in found}}


def _table_one(page, kind, methods):
    rows = []
    for method, s in methods.items():
        rows.append((kind, method, f"{s['length_m_mean']:.1f}", f"{s['duration_s_mean']:.1f}",
                     f"{s['cost_mean']:.1f}", f"{100 * s['node_utilization_mean']:.1f}",
                     f"{s['total_ms_mean']:.2f}", f"{s['total_ms_median']:.2f}",
                     f"{s['total_ms_p95']:.2f}", f"{100 * s['success_rate_100ms']:.1f}",
                     f"{100 * s['success_rate_1s']:.1f}"))
        if method in _PAPER_PLANS:
            p = _PAPER_PLANS[method]
            rows.append(("", "the paper's", *(f"{v:g}" for v in p[:5]), "", "", f"{p[5]}", ""))
    page.table(("missions", "method", "length, m", "time, s", "cost", "nodes used, %", "mean, ms",
                "median, ms", "95 %, ms", "success, %", "within 1 s, %"), rows, numbers=range(2, 11))


def _plans_by_scenario(page, cases):
    groups = {}
    for case in cases:
        groups.setdefault((case["scenario"], case["kind"], case["method"]), []).append(case)
    page.section("Plans by scenario")
    rows = []
    for key in sorted(groups):
        group = groups[key]
        times = [case["total_ms"] for case in group]
        rows.append((*key, f"{sum(bool(c['success']) for c in group)} of {len(group)}",
                     f"{numpy.median(times):.1f}", f"{max(times):.1f}"))
    page.table(("scenario", "missions", "method", "solved", "median, ms", "slowest, ms"), rows,
               numbers=(3, 4, 5))


def _worst_plans(page, cases, charts, pictures, folder):
    drawn, titles = [], []
    for path, case in sorted(cases, key=lambda entry: -entry[1]["total_ms"]):
        dump = case.get("dump") or ""
        places = [dump, os.path.join(os.path.dirname(path), dump),
                  os.path.join(folder, os.path.basename(dump))]
        place = next((p for p in places if dump and os.path.isfile(p)), None)
        if place is None or len(drawn) == _WORST:
            continue
        with open(place) as file:
            rows = len(file.readlines()) - 1
        if rows < 2:  # nothing was written, or no way
            continue
        data = numpy.genfromtxt(place, delimiter=",", names=True)
        way = Table(t=data["t"], x=data["x"], y=data["y"], u=data["u"], v=data["v"])
        titles.append(f"{case['scenario']}, mission {case['mission']}, {case['method']}, seed "
                      f"{case['seed']}: {case['total_ms']:.0f} ms")
        drawn.append(pictures.planned_way(way, charts.get(case["scenario"]), titles[-1]))
    if drawn:
        page.section("Slowest plans")
        page.pictures(drawn, titles)


# ---- tracking ----------------------------------------------------------------------------------

def _tracking(page, found):
    from . import pictures
    runs = [data for _, data in found]
    page.section("Table II: tracking", "Errors of the true position in the closed loop of tracker and "
                 "plant.")
    rows = [(name, "", "", number(mean), number(most), f"{speed:.2f}", f"{top:.2f}", f"{turn:.2f}", "",
             "", "") for name, mean, most, speed, top, turn in _PAPER_TRACKING]
    runs.sort(key=lambda r: (r["vessel"], r["path"], r.get("disturbance", ""), r.get("seed", 0)))
    for r in runs:
        rows.append((f"{r['vessel']}, {os.path.basename(r['path'])}, {r.get('method', '')}",
                     r.get("disturbance", ""), r.get("seed", ""), number(r["mean_error_m"]),
                     number(r.get("max_error_m")), number(r.get("mean_speed"), 2),
                     number(r.get("max_speed"), 2), number(r.get("yaw_rate_integral"), 2),
                     number(r.get("thrust_rms_n"), 1),
                     number(100 * r.get("saturation_share", numpy.nan), 1),
                     number(r.get("solver_us", {}).get("p99"), 0)))
    page.table(("run", "disturbance", "seed", "mean error, m", "largest, m", "mean speed, m/s",
                "largest, m/s", "∫ r² dt, rad²/s", "thrust rms, N", "saturated, %",
                "99 % step, µs"), rows, numbers=range(2, 11))
    if len(runs) <= 40:
        names = [f"{r['vessel']} {os.path.basename(r['path'])} {r.get('disturbance', '')} "
                 f"{r.get('seed', '')}" for r in runs]
        page.picture(pictures.bars(names, [r["mean_error_m"] for r in runs], "mean tracking error, m",
                                   {"the paper's, with flatness": _PAPER_TRACKING[1][1]}))
    else:
        page.pictures([pictures.histogram([r["mean_error_m"] for r in runs], "mean tracking error, m")])
    return {"count": len(runs), "mean_error_m": float(numpy.mean([r["mean_error_m"] for r in runs])),
            "max_error_m": float(max(r.get("max_error_m", 0.0) for r in runs))}
