"""Recordings made by hand, with known answers."""
import csv
import json
import os

import genpy
import numpy
import rosbag
from geometry_msgs.msg import Vector3Stamped
from nav_msgs.msg import Odometry
from otter_nav.msg import (ContactEvent, PlannerStatus, PlantState, ThrusterCommand, TrackerStatus,
                           Trajectory, TrajectoryPiece)

STEP_S = 0.02
START_S = 100.0      # of the motion
SAILS_S = 101.0      # of the first trajectory
ARRIVES_S = 117.0
END_S = 118.0
ALONG_M, CROSS_M = 0.3, -0.4   # how far the vessel is off its reference
SPEED_MPS = 2.0
HEADING = 0.5        # of the straight way
LEFT_N, RIGHT_N = 50.0, 10.0   # left stands at otter_gazebo's limit


def stamp(t):
    """Rounded: genpy cuts off."""
    nanoseconds = round(t * 1e9)
    return genpy.Time(nanoseconds // 10**9, nanoseconds % 10**9)


def piece(kind, duration, x, y, heading=()):
    def padded(values):
        return list(values) + [0.0] * (8 - len(values))
    return TrajectoryPiece(kind=kind, duration=duration, x=padded(x), y=padded(y),
                           heading=padded(heading))


def trajectory(number, start_s, pieces, goal=(32.0, 0.0)):
    message = Trajectory(id=number, pieces=pieces)
    message.header.frame_id = "map"
    message.header.stamp = stamp(start_s)
    message.goal.position.x, message.goal.position.y = goal
    message.goal.orientation.w = 1.0
    return message


def straight(number, start_s, begin_m, duration_s):
    """At constant speed along HEADING, `begin_m` from the origin at its start."""
    c, s = numpy.cos(HEADING), numpy.sin(HEADING)
    return trajectory(number, start_s, [piece(0, duration_s, [begin_m * c, SPEED_MPS * c],
                                              [begin_m * s, SPEED_MPS * s])])


def _stamped(message, t):
    message.header.stamp = stamp(t)
    return message


def damage(path):
    """Zeros over a part of a bag, behind its middle; its index stays."""
    with open(path, "r+b") as file:
        file.seek(int(0.6 * os.path.getsize(path)))
        file.write(bytes(2000))


def pose(t):
    """True place: along the way, off by the known errors."""
    way = SPEED_MPS * max(0.0, t - SAILS_S) + ALONG_M
    c, s = numpy.cos(HEADING), numpy.sin(HEADING)
    return way * c - CROSS_M * s, way * s + CROSS_M * c


def messages(offset_s=0.0, truth=True, contact=ARRIVES_S + 0.5):
    """(name, message, stamp) of one run in the order of time."""
    found = []

    def add(name, message, t):
        found.append((name, _stamped(message, t + offset_s), t + offset_s))
    for t in numpy.arange(START_S, END_S + 1e-9, STEP_S):
        x, y = pose(t)
        if truth:
            add("plant_state", PlantState(
                x=x, y=y, yaw=HEADING, u=SPEED_MPS, clearance=3.0 - 0.1 * (t - START_S),
                thrust_left=LEFT_N - 1.0, thrust_right=RIGHT_N), t)
        odometry = Odometry()
        odometry.header.frame_id, odometry.child_frame_id = "odom", "base_link"
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = x, y
        odometry.pose.pose.orientation.z = numpy.sin(HEADING / 2)
        odometry.pose.pose.orientation.w = numpy.cos(HEADING / 2)
        odometry.twist.twist.linear.x = SPEED_MPS
        add("odom", odometry, t)
        add("thruster_command", ThrusterCommand(left=LEFT_N, right=RIGHT_N), t)
    for t in numpy.arange(START_S, END_S, 0.1):
        sailing = t >= SAILS_S - 0.5
        state = (PlannerStatus.ARRIVED if t >= ARRIVES_S - 1e-6 else
                 PlannerStatus.SAILING if sailing else PlannerStatus.PLANNING)
        add("planner_status", PlannerStatus(
            state=state, plans=(1 if sailing else 0) + (1 if t >= 108.0 else 0),
            replans=1 if t >= 108.0 else 0, outcome="solved", length=32.0, duration=16.0,
            first_solution_ms=5.0, planning_ms=20.0 if t < 108.0 else 40.0, samples=100, nodes=40,
            cost=170.0, trajectory_id=1 if sailing else 0), t)
        add("tracker_status", TrackerStatus(
            state=TrackerStatus.TRACKING if sailing else TrackerStatus.IDLE,
            solver_ms_median=0.05, solver_ms_p99=0.2, cycles_on_time=0.99, disturbance=[3.0, -4.0, 0.5]), t)
        wind = Vector3Stamped()
        wind.vector.y = 3.0
        add("wind", wind, t)
    # The second joins the first as if it were one.
    for message, t in ((straight(1, SAILS_S + offset_s, 0.0, 16.0), SAILS_S - 0.5),
                       (straight(2, 109.0 + offset_s, 16.0, 8.0), 108.5)):
        found.append(("trajectory", message, t + offset_s))
    if contact:
        add("contact", ContactEvent(in_contact=True, speed=1.0), contact)
    return sorted(found, key=lambda entry: entry[2])


def write_bag(path, runs=1, prefix="", **options):
    """Each run starts with the clock set back."""
    with rosbag.Bag(path, "w") as bag:
        for run in range(runs):
            for name, message, t in messages(**options):
                bag.write(f"{prefix}/{name}", message, stamp(t))


def write_result(folder, count=1):
    """result.json of missions with tracks: 2 m/s to the east, 0.1 m to port of the reference."""
    missions = []
    os.makedirs(os.path.join(folder, "tracks"), exist_ok=True)
    for k in range(count):
        name = f"pond_{k}.csv"
        with open(os.path.join(folder, "tracks", name), "w", newline="") as file:
            rows = csv.writer(file)
            rows.writerow("t,x,y,psi,u,v,r,roll,pitch,f_left,f_right,x_ref,y_ref,psi_ref".split(","))
            for t in numpy.arange(0.0, 10.001, 0.05):
                way = 2.0 * max(0.0, t - 1.0)
                off = 0.1 if t >= 1.0 else 0.0
                rows.writerow([f"{v:.4f}" for v in (t, way, off, 0, 2 if t >= 1 else 0, 0, 0, 0, 0,
                                                    30, 40, way, 0, 0)])
        missions.append({"scenario": "pond", "mission": k, "vessel": "otter_gazebo",
                         "disturbance": "paper", "seed": 1,
                         "outcome": "stopped" if k == 1 else "arrived",
                         "duration_s": 10.0, "distance_m": 18.1, "min_clearance_m": 1.0 + k,
                         "tracking_error_mean_m": 0.1 + 0.01 * k, "tracking_error_max_m": 0.1 + 0.1 * k,
                         "replans": k, "planning_ms_median": 30.0, "planning_ms_max": 50.0 + k,
                         "tracker_ms_p99": 0.05, "track": "/elsewhere/" + name,
                         **({"reason": "no way <left>"} if k == 1 else {})})
    path = os.path.join(folder, "result.json")
    with open(path, "w") as file:
        json.dump({"missions": missions}, file)
    return path
