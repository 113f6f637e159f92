#include "archipelago/encounters.hpp"

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

// A circle that a square goes round on, in legs of 10 degrees.
struct Ring {
  Eigen::Vector2d centre;
  double radius_m = 0.0;
  double mps = 0.0;
  double phase_rad = 0.0;
  double sense = 1.0;  // counter-clockwise, or -1
};

constexpr double kFieldM = 80.0;
constexpr double kFieldEndM = 34.0;  // where we start and end, from the middle
constexpr double kSquareM = 4.0;
constexpr double kRoundsS = 300.0;

Ring drawRing(Random& random) {
  Ring ring;
  ring.radius_m = random.uniform(5.0, 15.0);
  const double reach = kFieldM / 2.0 - ring.radius_m;
  ring.centre.x() = random.uniform(-reach, reach);
  ring.centre.y() = random.uniform(-reach, reach);
  ring.mps = random.uniform(1.0, 2.5);
  ring.phase_rad = random.uniform(-kPi, kPi);
  ring.sense = random.uniform() < 0.5 ? 1.0 : -1.0;
  return ring;
}

bool clearOfEnds(const Ring& ring) {
  constexpr double kClearM = 8.0;
  for (const double y : {-kFieldEndM, kFieldEndM}) {
    if ((ring.centre - Eigen::Vector2d(0.0, y)).norm() < ring.radius_m + kClearM) {
      return false;
    }
  }
  return true;
}

vessel::ScriptedVessel onRing(const Ring& ring, int id) {
  constexpr double kLegRad = kPi / 18.0;
  vessel::ScriptedVessel square;
  square.id = id;
  square.hull = {kSquareM, kSquareM};
  square.speeds_mps = {ring.mps};
  const double leg_m = 2.0 * ring.radius_m * std::sin(kLegRad / 2.0);
  const int legs = static_cast<int>(std::ceil(kRoundsS * ring.mps / leg_m));
  for (int k = 0; k <= legs; ++k) {
    const double angle = ring.phase_rad + ring.sense * k * kLegRad;
    square.waypoints.emplace_back(ring.centre + ring.radius_m * unitVector(angle));
  }
  return square;
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

std::vector<Encounter> movingFields() {
  std::vector<Encounter> fields;
  for (const int squares : {5, 5, 5, 5, 12, 12, 12}) {
    Random random(fields.size() + 1);
    Encounter field;
    field.mission = {
        "encounter", {{0.0, -kFieldEndM}, kPi / 2.0}, {{0.0, kFieldEndM}, kPi / 2.0}, 4.0};
    while (static_cast<int>(field.vessels.size()) < squares) {
      const Ring ring = drawRing(random);
      if (clearOfEnds(ring)) {
        field.vessels.push_back(onRing(ring, static_cast<int>(field.vessels.size()) + 1));
      }
    }
    fields.push_back(std::move(field));
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
