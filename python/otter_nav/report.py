"""The program `report`: a run, or a campaign of runs, as one page and its figures as JSON."""
import argparse
import json
import os
import sys

import numpy

from .bag import read_one
from .errors import RecordingError
from .page import Page, escape, number
from .result import read_result
from .vessel import least_vessel, load_vessel, share_folder


def version():
    """The package's, from its package.xml."""
    import xml.etree.ElementTree as ElementTree
    share = share_folder()
    try:
        return ElementTree.parse(share / "package.xml").findtext("version")
    except (OSError, TypeError, ElementTree.ParseError):
        return None


def run_page(run, scenario=None, others=0):
    """The page of one run. `others`: how many more runs the recording holds."""
    from . import pictures
    figures = run.figures()
    label = run.label
    name = label.get("scenario")
    title = (f"{name}, mission {label.get('mission', 0)}" if name else
             os.path.basename(run.source) or "Run")
    page = Page(title)
    words = [f"vessel {label.get('vessel', run.vessel.name)}" + run.details.get("vessel", "")]
    for key in ("disturbance", "seed"):
        if key in label:
            words.append(f"{key} {label[key]}")
    if run.details.get("run") and others:
        words.append(f"run {run.details['run']} of the bag")
    page.heading(title, ", ".join(words), run.outcome, run.outcome == "arrived")
    if run.reason:
        page.raw(f"<p>{escape(run.reason)}</p>")
    page.figures([
        ("mean tracking error", number(figures["tracking_error_mean_m"]), "m"),
        ("largest tracking error", number(figures["tracking_error_max_m"]), "m"),
        ("duration", number(figures["duration_s"], 1), "s"),
        ("distance", number(figures["distance_m"], 1), "m"),
        ("mean speed", number(figures["speed_mean_mps"], 2), "m/s"),
        ("least clearance", number(figures["min_clearance_m"], 2), "m"),
        ("thrust, rms", number(figures["thrust_rms_n"], 1), "N"),
        ("thrusters saturated", _percent(figures["thrust_saturated_share"]), "%"),
        ("replans", number(figures["replans"]), ""),
        ("planning, median", number(figures["planning_ms_median"], 1), "ms"),
        ("control step, 99 %", number(figures["tracker_ms_p99"]), "ms"),
        ("contacts", number(figures["contacts"]), ""),
    ])
    begin = run.motion.t[0]
    page.raw(f'<p class="note">Figures are taken from {figures["window_from_s"] - begin:.2f} s, where '
             f'the first trajectory begins, to {figures["window_to_s"] - begin:.2f} s, where the '
             f'mission ends. Errors are of the {"true" if run.motion_is_true else "estimated"} '
             f'position.</p>')

    page.section("Track")
    page.picture(pictures.track(run, scenario))
    page.section("Tracking error", "From the reference to the vessel, along and across the way. "
                 "Dotted: a new trajectory. Thin lines: the window the figures are taken from. "
                 "Thick: a contact.")
    page.picture(pictures.errors(run) or "")
    if not pictures_have_reference(run):
        page.raw("<p>No trajectory was recorded.</p>")
    page.section("Speed")
    page.picture(pictures.speed(run))
    thrusts = pictures.thrusts(run)
    if thrusts:
        page.section("Thrusts", "As asked of the thrusters." if len(run.commands) else
                     "As they acted on the hull.")
        page.picture(thrusts)
    clearance = pictures.clearance(run)
    if clearance:
        page.section("Clearance")
        page.picture(clearance)
    estimates = pictures.estimates(run)
    if estimates:
        page.section("Wind, current and force", "What the tracker estimates acts on the hull "
                     "besides the thrusters, and the sea as it was.")
        page.picture(estimates)
    _planning(page, run, pictures)
    solver = pictures.solver(run)
    if solver:
        page.section("Tracker", "Wall times over the last few thousand control steps.")
        page.picture(solver)
        page.figures([("control step, median", number(figures["tracker_ms_median"]), "ms"),
                      ("control step, 99 %", number(figures["tracker_ms_p99"]), "ms"),
                      ("cycles on time", _percent(figures["cycles_on_time"]), "%")])
    if run.events:
        page.section("Events")
        page.table(("time, s", "from", "event"),
                   [(f"{event.t - begin:.2f}", event.source, event.text) for event in run.events],
                   numbers=(0,))
    _versions(page, run, scenario)
    return page


def pictures_have_reference(run):
    return run.recorded_reference is not None or bool(run.trajectories)


def _planning(page, run, pictures):
    if not run.plans:
        return
    page.section("Planning")
    page.picture(pictures.planning(run))
    begin = run.motion.t[0]
    page.table(("time, s", "plan", "outcome", "length, m", "duration, s", "cost", "samples", "nodes",
                "first, ms", "whole, ms"),
               [(f"{p.t - begin:.2f}", p.number, p.outcome, f"{p.length_m:.1f}",
                 f"{p.duration_s:.1f}", f"{p.cost:.1f}", p.samples, p.nodes,
                 f"{p.first_solution_ms:.1f}", f"{p.planning_ms:.1f}") for p in run.plans],
               numbers=(0, 1, 3, 4, 5, 6, 7, 8, 9))


def _versions(page, run, scenario):
    page.section("Versions and parameters")
    rows = [("report made by", f"otter_nav {version() or 'of unknown version'}")]
    rows += [(key, value) for key, value in run.label.items()]
    rows += [(key, value) for key, value in run.details.items() if key not in ("parameters", "vessel")]
    if scenario is not None:
        rows.append(("chart from", os.path.basename(scenario.path)))
    v = run.vessel
    rows.append(("vessel's model", f"{v.name}: m1 {v.m1_kg:g} kg, m2 {v.m2_kgm2:g} kg m², d1 "
                 f"{v.d1_kgps:g}, d2 {v.d2_kgps:g} kg/s, d3 {v.d3_kgm2ps:g} kg m²/s"))
    rows.append(("thrusters", f"{v.ahead_max_n:g} N ahead, {v.astern_max_n:g} N astern, "
                 f"{v.lever_arm_m:g} m off the centre line"))
    rows.append(("hull", f"{v.length_m:g} m by {v.beam_m:g} m"))
    page.table(("", ""), rows)
    if run.details.get("parameters"):
        page.raw(f"<pre>{escape(run.details['parameters'])}</pre>")


def _percent(share):
    return "–" if share is None else f"{100.0 * share:.1f}"


def json_beside(path):
    root, ending = os.path.splitext(path)
    return (root if ending else path) + ".json"


def write(page, figures, out, sources=()):
    beside = json_beside(out)
    for source in sources:
        if source and os.path.exists(source) and os.path.realpath(source) in map(os.path.realpath,
                                                                                 (out, beside)):
            raise RecordingError(f"--out {out}: its figures would be written over {source}")
    os.makedirs(os.path.dirname(os.path.abspath(out)), exist_ok=True)
    with open(out, "w") as file:
        file.write(page.html())
    with open(beside, "w") as file:
        json.dump(figures, file, indent=2, allow_nan=False)
        file.write("\n")
    print(f"{out} ({os.path.getsize(out) / 1e6:.1f} MB), {beside}")


def find_scenario(path, name, recorded):
    """The scenario asked for; else one of the package's maps by its name; else none."""
    from .chart import load_scenario
    if path:
        return load_scenario(path)
    share = share_folder()
    if name and recorded is None and share is not None:
        for found in sorted((share / "maps").glob(f"**/{name}.yaml")):
            return load_scenario(str(found))
    return None


def add_source_arguments(parser):
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("--bag", help="a recorded bag")
    source.add_argument("--result", help="result JSON of a mission, its track beside it")
    parser.add_argument("--scenario", help="scenario or chart YAML to draw (default: the chart in "
                        "the bag, or the package's scenario of that name)")
    parser.add_argument("--run", type=int, default=1, help="which run of the bag or mission of the "
                        "result, from 1 (default 1)")
    parser.add_argument("--vessel", help="name in config/vessels or a file (default: the recorded "
                        "one; of a bag without, the weakest that can give its commands)")
    parser.add_argument("--namespace", help="of the vessel, where the bag holds several")
    parser.add_argument("--partial", action="store_true", help="read what is there of a bag cut off")
    return source


def _assume_vessel(run):
    """A bag does not say whose it is; its commands rule out vessels that are too weak for them."""
    run.details["vessel"] = " (assumed, see --vessel)"
    if len(run.commands):
        most = [float(numpy.max(side)) for side in (run.commands.left, run.commands.right)]
        least = [float(numpy.min(side)) for side in (run.commands.left, run.commands.right)]
        vessel = least_vessel(max(most), -min(least))
        if vessel is not None:
            run.vessel = vessel


def load(options):
    """(run, scenario, number of other runs) of the program's arguments."""
    if options.bag:
        run, count = read_one(options.bag, options.run, options.vessel or "otter_gazebo",
                              options.namespace, options.partial)
        others = count - 1
        if options.vessel is not None:
            run.vessel = load_vessel(options.vessel)
        elif not run.vessel_is_recorded:
            _assume_vessel(run)
        if others:
            print(f"{options.bag} holds {count} runs; this is number {options.run} (--run)",
                  file=sys.stderr)
    else:
        run, others = read_result(options.result, options.run - 1, options.vessel), 0
    return run, find_scenario(options.scenario, run.label.get("scenario"), run.chart), others


def main(arguments=None):
    parser = argparse.ArgumentParser(
        prog="report", description="Makes a page of a run, or of a campaign of benchmarks, that "
        "needs nothing else to be read, and a JSON of its figures beside it.")
    source = add_source_arguments(parser)
    source.add_argument("--campaign", help="folder with results of mission_benchmark, "
                        "planner_benchmark or tracking_benchmark")
    parser.add_argument("--scenarios", help="of a campaign: folder of the scenarios, for pictures")
    parser.add_argument("--out", required=True, help="HTML file to write; its figures go to the "
                        "JSON of the same name")
    options = parser.parse_args(arguments)
    try:
        if options.campaign:
            from .campaign import campaign_page
            page, figures = campaign_page(options.campaign, options.scenarios)
        else:
            run, scenario, others = load(options)
            page, figures = run_page(run, scenario, others), {**run.label, **run.figures()}
        write(page, figures, options.out, (options.bag, options.result))
    except (RecordingError, OSError) as error:
        print(f"report: {error}", file=sys.stderr)
        return 1
    return 0
