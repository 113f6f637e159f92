"""What replay_bag plays: whose topics, which run, the map as it had become, and never an order."""
import numpy
import pytest
import rosbag
from map_msgs.msg import OccupancyGridUpdate
from nav_msgs.msg import OccupancyGrid
from otter_nav.msg import TrackerCycle
from std_msgs.msg import String

from otter_nav import replay
from otter_nav.bag import open_bag, read_bag
from otter_nav.errors import RecordingError
from synthetic import damage, messages, stamp, write_bag

VESSEL = """name: barge
top_speed_mps: 1.25
paper_model: {m1_kg: 1, m2_kgm2: 2, d1_kgps: 3, d2_kgps: 4, d3_kgm2ps: 5}
thrusters: {lever_arm_m: 0.5, ahead_max_n: 70, astern_max_n: 60}
hull: {length_m: 3, beam_m: 2}
"""
PLANT = "{vessel: barge, disturbance: hard, seed: 7, scenario: /maps/bay.yaml, mission: 2}"


def latched(bag, topic, message, t):
    header = {"topic": topic, "type": message._type, "md5sum": message._md5sum,
              "message_definition": message._full_text, "latching": "1", "callerid": "/x"}
    bag.write(topic, message, stamp(t), connection_header=header)


def test_orders_are_never_played():
    for topic in ("/trajectory", "/a/trajectory", "/move_base/goal", "/move_base_simple/goal", "/clock",
                  "/a/lockstep_ack"):
        assert replay.target(topic, "/a") is None, topic
    for topic in ("/thruster_command", "/a/thruster_command"):
        assert replay.target(topic, "/a") == "/replayed/thruster_command"
    assert replay.target("/a/odom", "/a") == "/odom"
    assert replay.target("/tf", "/a") == "/tf"
    assert replay.target("/ab/odom", "/a") == "/ab/odom"


def test_runs_are_cut_where_time_jumps_back(tmp_path):
    path = tmp_path / "runs.bag"
    write_bag(path, runs=3)
    with open_bag(path) as bag:
        recorded = replay.Recorded(bag, str(path), None)
    assert len(recorded.runs) == 3
    assert {len(run) for run in recorded.runs} == {len(recorded.runs[0])}
    assert all(abs(run[0][0] - recorded.runs[0][0][0]) < 0.1 for run in recorded.runs)


def test_damaged_bag_is_named_and_played_up_to_there_if_asked(tmp_path, capsys):
    path = tmp_path / "run.bag"
    write_bag(path)
    damage(path)
    with open_bag(path) as bag:
        with pytest.raises(RecordingError, match=f"{path}: damaged after 1.*--partial"):
            replay.Recorded(bag, str(path), None)
        assert len(replay.Recorded(bag, str(path), None, partial=True).runs[0]) > 100
    assert replay.main(["--bag", str(path)]) == 1
    assert "damaged" in capsys.readouterr().err


def test_what_comes_before_a_runs_motion_is_its_own(tmp_path):
    """Latched or not, in a bag put together from two and in one recorded through a restart."""
    together, restarted = tmp_path / "together.bag", tmp_path / "restarted.bag"
    for path, early in ((together, 99.0), (restarted, 118.0)):
        with rosbag.Bag(path, "w") as bag:
            for run in range(2):
                begin = early if run else 99.0
                latched(bag, "/vessel", String(VESSEL), begin)
                bag.write("/note", String("no motion yet"), stamp(begin))
                latched(bag, "/chart", OccupancyGrid(), begin)
                for name, message, t in messages():
                    bag.write(f"/{name}", message, stamp(t))
        with open_bag(path) as bag:
            recorded = replay.Recorded(bag, str(path), None)
        assert len(recorded.runs) == 2, path
        for run in recorded.runs:
            first = [topic for _, topic, _ in run if topic in ("/vessel", "/chart")]
            assert first == ["/vessel", "/chart"], path


def test_one_vessel_of_several(tmp_path):
    path = tmp_path / "two.bag"
    with rosbag.Bag(path, "w") as bag:
        for prefix in ("/a", "/b"):
            for name, message, t in messages():
                bag.write(f"{prefix}/{name}", message, stamp(t))
    with open_bag(path) as bag:
        recorded = replay.Recorded(bag, str(path), "b")
    assert all(topic.startswith("/b/") for topic in recorded.topics)
    assert "/odom" in {topic.name for topic in recorded.topics.values()}


def test_the_map_is_what_it_had_become(tmp_path):
    path = tmp_path / "map.bag"
    grid = OccupancyGrid()
    grid.info.width, grid.info.height, grid.data = 3, 2, [0] * 6
    update = OccupancyGridUpdate(x=1, y=1, width=2, height=1, data=[100, 100])
    with rosbag.Bag(path, "w") as bag:
        latched(bag, "/map", grid, 100.0)
        for name, message, t in messages():
            bag.write(f"/{name}", message, stamp(t))
            if name == "contact":
                bag.write("/map_updates", update, stamp(t))
    with open_bag(path) as bag:
        recorded = replay.Recorded(bag, str(path), None)
    assert recorded.topics["/map"].latched and not recorded.topics["/map_updates"].latched
    mirror = replay.MapMirror(recorded)
    for _, topic, data in recorded.runs[0]:
        mirror.take(topic, data)
    _, cells = mirror.grids["/map"]
    numpy.testing.assert_array_equal(cells, [[0, 0, 0], [0, 100, 100]])


def test_a_recording_says_whose_it_is_and_what_the_tracker_thought(tmp_path):
    path = tmp_path / "own.bag"
    with rosbag.Bag(path, "w") as bag:
        latched(bag, "/vessel", String(VESSEL), 100.0)
        latched(bag, "/plant_node/parameters", String(PLANT), 100.0)
        for number in (0, 1, 2, 2):  # zero says only that it is there; the last came again
            bag.write("/tracker_cycle", TrackerCycle(
                cycle=number, time=100.0 + number, left=number, wind=[1.0, 2.0],
                disturbance=[3.0, 4.0, 5.0], estimate=[6.0] * 6), stamp(100.0))
        for name, message, t in messages():
            bag.write(f"/{name}", message, stamp(t))
    run, = read_bag(path)
    assert run.vessel.name == "barge" and run.vessel.ahead_max_n == 70.0 and run.vessel_is_recorded
    assert run.label == {"vessel": "barge", "disturbance": "hard", "seed": 7, "scenario": "bay",
                         "mission": 2}
    assert "plant_node:" in run.details["parameters"]
    numpy.testing.assert_array_equal(run.cycles.t, [101.0, 102.0])
    numpy.testing.assert_array_equal(run.cycles.left, [1.0, 2.0])
    numpy.testing.assert_array_equal(run.cycles.wind_y, [2.0, 2.0])
    numpy.testing.assert_array_equal(run.cycles.force_y, [4.0, 4.0])


def test_parameters_set_under_way_are_events(tmp_path):
    path = tmp_path / "tuned.bag"
    told = "tracker:\n  flatness: {position: %g, heading: 50}\nspeed: 1\n"
    with rosbag.Bag(path, "w") as bag:
        latched(bag, "/tracker_node/parameters", String(told % 100), 100.0)
        for name, message, t in messages():
            bag.write(f"/{name}", message, stamp(t))
            if name == "contact":
                latched(bag, "/tracker_node/parameters", String(told % 20), t)
    run, = read_bag(path)
    changed = [event for event in run.events if event.source == "tracker_node"]
    assert [event.text for event in changed] == ["tracker.flatness.position: 100 → 20"]
    assert abs(changed[0].t - 117.5) < 1e-6


def test_the_hull_is_the_recorded_one(tmp_path):
    path = str(tmp_path / "hull.bag")
    with rosbag.Bag(path, "w") as bag:
        for name, message, t in messages():
            bag.write(f"/otter1/{name}", message, stamp(t))
    assert 'robot name="otter"' in replay.hull(path, None, False)
    with rosbag.Bag(path, "a") as bag:
        latched(bag, "/otter1/robot_description", String("<robot name='barge'/>"), 118.0)
    assert replay.hull(path, None, False) == "<robot name='barge'/>"
    assert 'robot name="otter"' in replay.hull(str(tmp_path / "none.bag"), None, False)
