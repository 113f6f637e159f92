#include "archipelago/encounters.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/random.hpp"

namespace otter_nav::scenario {
namespace {

constexpr double kMeetS = 100.0;
constexpr double kEndS = 300.0;
constexpr double kOwnMps = 2.0;
constexpr double kSlowMps = 1.4;

// Of another vessel; we go north.
struct Course {
  double deg = 0.0;  // clockwise from ours
  double mps = kOwnMps;
  double turn_s = kEndS;  // before the end: when she turns
  double then_deg = 0.0;
};

Course slow(double deg) {
  return {deg, kSlowMps};
}

Eigen::Vector2d velocity(double deg, double mps) {
  const double rad = deg * kPi / 180.0;
  return {mps * std::sin(rad), mps * std::cos(rad)};
}

Encounter meeting(const std::vector<Course>& courses) {
  Encounter encounter;
  const double half_way = kMeetS * kOwnMps;
  encounter.mission = {
      "encounter", {{0.0, -half_way}, kPi / 2.0}, {{0.0, half_way}, kPi / 2.0}, kOwnMps};
  for (const Course& course : courses) {
    const Eigen::Vector2d way = velocity(course.deg, course.mps);
    vessel::ScriptedVessel vessel;
    vessel.id = static_cast<int>(encounter.vessels.size()) + 1;
    vessel.hull = {6.0, 2.0};
    vessel.speeds_mps = {course.mps};
    vessel.waypoints = {-kMeetS * way, (course.turn_s - kMeetS) * way};
    if (course.turn_s < kEndS) {
      vessel.waypoints.emplace_back(vessel.waypoints.back() +
                                    (kEndS - course.turn_s) *
                                        velocity(course.then_deg, course.mps));
    }
    encounter.vessels.push_back(std::move(vessel));
  }
  return encounter;
}

std::vector<Encounter> meetings(const std::vector<std::vector<Course>>& cases) {
  std::vector<Encounter> encounters;
  encounters.reserve(cases.size());
  for (const std::vector<Course>& courses : cases) {
    encounters.push_back(meeting(courses));
  }
  return encounters;
}

constexpr double kFieldEndM = 34.0;   // where we start and end, from the middle
constexpr double kFieldSideM = 20.0;  // and at most to either side of it
constexpr double kFieldMps = 4.0;
constexpr double kSquareM = 4.0;
constexpr double kInsideM = 37.0;  // middles of squares, from the field's middle on each axis
constexpr double kRoundsS = 300.0;

struct Difficulty {
  const char* name;
  int squares;
  double mps_max;
};
constexpr Difficulty kDifficulties[] = {{"easy", 5, 2.0}, {"medium", 12, 3.0}, {"hard", 24, 4.0}};

// A loop's corners around the origin; the last leads back to the first.
using Loop = std::vector<Eigen::Vector2d>;

Loop drawLoop(Random& random) {
  constexpr int kCircleLegs = 36;
  const double shape = random.uniform();
  const double radius = random.uniform(5.0, 15.0);
  const double first = random.uniform(-kPi, kPi);
  if (shape < 0.25) {  // to and fro
    return {radius * unitVector(first), -radius * unitVector(first)};
  }
  const bool is_circle = shape > 0.6;
  const int corners = is_circle ? kCircleLegs : 3 + static_cast<int>(4.0 * random.uniform());
  Loop loop;
  for (int k = 0; k < corners; ++k) {
    const double reach = is_circle ? radius : radius * random.uniform(0.7, 1.0);
    loop.emplace_back(reach * unitVector(first + 2.0 * kPi * k / corners));
  }
  if (random.uniform() < 0.5) {
    std::reverse(loop.begin(), loop.end());
  }
  return loop;
}

// On a loop somewhere in the field, from somewhere on it.
vessel::ScriptedVessel drawSquare(Random& random, double mps_max, int id) {
  Loop loop = drawLoop(random);
  double reach = 0.0;
  for (const Eigen::Vector2d& corner : loop) {
    reach = std::max(reach, corner.cwiseAbs().maxCoeff());
  }
  const double free = kInsideM - reach;
  const Eigen::Vector2d middle(random.uniform(-free, free), random.uniform(-free, free));
  vessel::ScriptedVessel square;
  square.id = id;
  square.hull = {kSquareM, kSquareM};
  square.speeds_mps = {random.uniform(1.0, mps_max)};
  const auto from = static_cast<std::size_t>(random.uniform() * static_cast<double>(loop.size()));
  const double share = random.uniform();
  const auto corner = [&](std::size_t k) -> Eigen::Vector2d {
    return middle + loop[(from + k) % loop.size()];
  };
  square.waypoints = {corner(0) + share * (corner(1) - corner(0))};
  double length = 0.0;
  for (std::size_t k = 1; length < kRoundsS * square.speeds_mps.front(); ++k) {
    length += (corner(k) - square.waypoints.back()).norm();
    square.waypoints.push_back(corner(k));
  }
  return square;
}

bool leavesRoomToStart(const vessel::ScriptedVessel& square, const Eigen::Vector2d& start) {
  constexpr double kRoomM = 10.0;
  constexpr double kFirstS = 6.0;
  for (double t = 0.0; t <= kFirstS; t += 0.5) {
    if ((vessel::motionAt(square, t).pose.position - start).norm() < kRoomM) {
      return false;
    }
  }
  return true;
}

Encounter drawField(const Difficulty& difficulty, Random& random) {
  const double ahead = 0.5 * kPi * std::floor(4.0 * random.uniform());
  const Eigen::Vector2d along = unitVector(ahead);
  const auto end = [&](double side) {
    const double aside = random.uniform(-kFieldSideM, kFieldSideM);
    return vessel::Pose{side * kFieldEndM * along + aside * across(along), ahead};
  };
  Encounter field;
  field.kind = difficulty.name;
  const vessel::Pose start = end(-1.0);
  const vessel::Pose goal = end(1.0);
  field.mission = {"encounter", start, goal, kFieldMps};
  while (static_cast<int>(field.vessels.size()) < difficulty.squares) {
    vessel::ScriptedVessel square =
        drawSquare(random, difficulty.mps_max, static_cast<int>(field.vessels.size()) + 1);
    if (leavesRoomToStart(square, start.position)) {
      field.vessels.push_back(std::move(square));
    }
  }
  return field;
}

}  // namespace

std::vector<Encounter> imazuCases() {
  return meetings({{{180.0}},
                   {{-90.0}},
                   {slow(0.0)},
                   {{45.0}},
                   {{180.0}, {-90.0}},
                   {{-10.0}, {-45.0}},
                   {slow(0.0), {-45.0}},
                   {{180.0}, {-90.0}},
                   {{-30.0}, {-90.0}},
                   {{-90.0}, {15.0}},
                   {{90.0}, {-30.0}},
                   {{180.0}, {-45.0}, {-10.0}},
                   {{180.0}, {10.0}, {45.0}},
                   {{-10.0}, {-45.0}, {-90.0}},
                   {slow(0.0), {-45.0}, {-90.0}},
                   {slow(45.0), {90.0}, {-90.0}},
                   {slow(0.0), {10.0}, {-45.0}},
                   {{-135.0}, {-15.0}, {-30.0}},
                   {{15.0}, {-15.0}, {-135.0}},
                   {slow(0.0), {-15.0}, {-90.0}},
                   {{-15.0}, {15.0}, {-90.0}},
                   {slow(0.0), {-45.0}, {-90.0}}});
}

std::vector<Encounter> stubbornCaptains() {
  return meetings({{{60.0}},
                   {slow(90.0)},
                   {{120.0, 2.6}},
                   {{45.0, 2.6}},
                   {{0.0, 2.8}},
                   {{20.0, 3.0}},
                   {{180.0, kOwnMps, 60.0, 150.0}},
                   {{90.0, kOwnMps, 80.0, 130.0}}});
}

std::vector<Encounter> movingFields(std::uint64_t seed, int each) {
  std::vector<Encounter> fields;
  for (const Difficulty& difficulty : kDifficulties) {
    for (int k = 0; k < each; ++k) {
      // A field is the same however many are asked for.
      Random random(seed * 1000003U + static_cast<std::uint64_t>(difficulty.squares) * 1009U +
                    static_cast<std::uint64_t>(k));
      fields.push_back(drawField(difficulty, random));
    }
  }
  return fields;
}

map::OccupancyGrid openWater(double side_m) {
  constexpr double kCellM = 0.5;
  const auto cells = static_cast<int>(std::lround(side_m / kCellM));
  map::OccupancyGrid water;
  water.geometry = {cells, cells, kCellM, {-side_m / 2.0, -side_m / 2.0}};
  water.cells.assign(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells),
                     map::Cell::kFree);
  return water;
}

}  // namespace otter_nav::scenario
