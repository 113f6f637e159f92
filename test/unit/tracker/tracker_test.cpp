#include "otter_nav/tracker/tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/vessel/hull.hpp"
#include "otter_nav/vessel/thrusters.hpp"
#include "tracker/orbital_motion.hpp"

namespace otter_nav::tracker {
namespace {

using vessel::kPsi;

const std::string kSource = OTTER_NAV_SOURCE_DIR;

// Tracker and the model as its plant, 100 Hz.
class TrackerTest : public ::testing::Test {
 protected:
  TrackerTest() : tracker_(Tracker::create(load(), vessel_)) {}

  static Options load() {
    const auto options = config::load<Options>(kSource + "/config/tracker.yaml");
    EXPECT_TRUE(options) << options.error().message;
    return *options;
  }

  // A straight line east from rest to rest.
  static trajectory::Trajectory line(double length_m, double duration_s) {
    vessel::FlatPoint start;
    vessel::FlatPoint end;
    end.position.x() = length_m;
    return trajectory::Trajectory({trajectory::hermitePiece(start, end, duration_s)});
  }

  Command sail(double duration_s, bool odometry = true) {
    Command command;
    for (int i = 0; i < static_cast<int>(duration_s * 100.0 + 0.5); ++i) {
      if (odometry) {
        tracker_->addOdometry(now_s_, state_);
      }
      command = tracker_->step(now_s_);
      EXPECT_TRUE(command.thrusts.allFinite());
      EXPECT_GE(vessel::thrustMargin(command.thrusts, vessel_.thrusters), -1e-9);
      state_ = rk4Step(
          [&](double, const vessel::State& x) {
            return vessel::stateDerivative(x, command.thrusts, vessel_.manoeuvring,
                                           vessel_.thrusters, disturbance_);
          },
          0.0, state_, 0.01);
      now_s_ += 0.01;
    }
    return command;
  }

  vessel::Parameters vessel_;
  vessel::Disturbance disturbance_;
  std::unique_ptr<Tracker> tracker_;
  vessel::State state_ = vessel::State::Zero();
  double now_s_ = 100.0;
};

TEST_F(TrackerTest, IsIdleWithoutATrajectory) {
  const Command command = sail(0.5);
  EXPECT_EQ(command.mode, Mode::kIdle);
  EXPECT_EQ(command.thrusts, vessel::Thrusts::Zero());
}

TEST_F(TrackerTest, SailsALineAndHoldsItsEndUnderAForce) {
  disturbance_.force_n = {-4.0, 3.0};
  ASSERT_TRUE(tracker_->setTrajectory({line(30.0, 20.0), now_s_}));
  Command command = sail(15.0);
  EXPECT_EQ(command.mode, Mode::kTracking);
  EXPECT_LT(command.tracking_error_m, 0.05);
  // A steady course doesn't tell a force from a current; their sum counts.
  const double pull =
      command.disturbance.mean.force_n.x() +
      vessel_.manoeuvring.surge_drag_kgps * command.disturbance.mean.current_mps.x();
  EXPECT_NEAR(pull, -4.0, 0.5);
  command = sail(65.0);
  EXPECT_EQ(command.mode, Mode::kHolding);
  EXPECT_LT((state_.head<2>() - Eigen::Vector2d(30.0, 0.0)).norm(), 1.0);
}

// Of an outline that looks at the hull, each 10 cm.
std::vector<Eigen::Vector2d> wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  std::vector<Eigen::Vector2d> points;
  const int steps = static_cast<int>((to - from).norm() / 0.1);
  for (int k = 0; k <= steps; ++k) {
    points.push_back(from + (to - from) * k / steps);
  }
  return points;
}

class AlongAWall : public TrackerTest {
 protected:
  // What a hull on a line of 30 m from rest to rest has to a wall `beside_m` from its outline at
  // the least, when past 10 m it is set toward the wall by `aside_mps` at once.
  double least(double beside_m, double aside_mps, bool is_known, double from_s = 0.0) {
    tracker_ = Tracker::create(load(), vessel_);
    state_.setZero();
    const double side_m = 0.5 * vessel_.hull.beam_m;
    if (is_known) {
      const double y = side_m + beside_m;
      EXPECT_TRUE(tracker_->setNearObstacles({from_s, wall({0.0, y}, {30.0, y})}, 5));
    }
    EXPECT_TRUE(tracker_->setTrajectory({line(30.0, 24.0), now_s_}));
    double nearest_m = 1.0;
    bool pushed = false;
    while (state_.x() < 20.0) {
      EXPECT_EQ(sail(0.05).near_taken, is_known ? 5U : 0U);
      if (!pushed && state_.x() > 10.0) {
        state_[vessel::kSway] += aside_mps;
        pushed = true;
      }
      for (const Eigen::Vector2d& corner :
           vessel::outline(vessel_.hull, state_.head<2>(), state_[vessel::kPsi])) {
        nearest_m = std::min(nearest_m, side_m + beside_m - corner.y());
      }
    }
    return nearest_m;
  }
};

// Most of it is gone before anything can be done: who has to turn to come back brings the stern
// nearer first.
TEST_F(AlongAWall, GivesLessAwayToWhatItKnowsToBeThere) {
  const double unknown_m = least(0.2, 0.15, false);
  const double known_m = least(0.2, 0.15, true);
  EXPECT_LT(unknown_m, 0.0);
  EXPECT_GT(known_m, 0.0);
  EXPECT_GT(least(0.25, 0.1, true), least(0.25, 0.1, false) + 0.01);
}

TEST_F(AlongAWall, KeepsToATrajectoryThatPassesClose) {
  for (const double beside_m : {0.02, 0.1, 0.2, 0.3}) {
    EXPECT_NEAR(least(beside_m, 0.0, true), beside_m, 0.01) << beside_m;
  }
}

TEST_F(AlongAWall, KeepsToATrajectoryThatLeadsIntoSomething) {
  EXPECT_NEAR(least(-0.4, 0.0, true), least(-0.4, 0.0, false), 0.01);
}

TEST_F(AlongAWall, KnowsWhatIsNearFromItsStartOn) {
  const double start_s = now_s_ + 1000.0;
  EXPECT_NEAR(least(0.2, 0.15, true, start_s), least(0.2, 0.15, false), 1e-9);
}

TEST_F(TrackerTest, RefusesNearObstaclesThatMakeNoSense) {
  NearObstacles near;
  near.points = {{1.0, std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_FALSE(tracker_->setNearObstacles(near));
  near.points = {{1.0, 2.0}};
  near.start_s = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(tracker_->setNearObstacles(near));
  near.start_s = 0.0;
  near.points.assign(kMostNearObstacles + 1, {1.0, 2.0});
  const Status many = tracker_->setNearObstacles(near);
  ASSERT_FALSE(many);
  EXPECT_EQ(many.error().message, "501 near obstacles are more than 500");
}

class Stopped : public TrackerTest {
 protected:
  void stop() {
    const auto otter = vessel::loadParameters(kSource + "/config/vessels/otter.yaml");
    ASSERT_TRUE(otter) << otter.error().message;
    vessel_ = *otter;
    tracker_ = Tracker::create(load(), vessel_);
    state_.setZero();
    disturbance_ = {};
    sail(0.1);
    tracker_->requestStop("on request");
    EXPECT_EQ(sail(1.0).mode, Mode::kStopped);
  }

  // How far the bow is off at most within 20 s of a swell of 0.1 m and 5 s from abeam.
  double swing(const std::vector<Eigen::Vector2d>& near) {
    stop();
    EXPECT_TRUE(tracker_->setNearObstacles({0.0, near}));
    double most_rad = 0.0;
    for (int k = 0; k < 200; ++k) {
      disturbance_.current_mps.y() = 0.125 * std::cos(0.4 * kPi * 0.1 * k);
      sail(0.1);
      most_rad = std::max(most_rad, std::abs(state_[kPsi]));
      EXPECT_LT(state_.head<2>().norm(), 0.3);
    }
    return most_rad;
  }
};

TEST_F(Stopped, LiesStillInASwellWhereNothingIsNear) {
  EXPECT_LT(swing({}), 0.4 * swing(wall({-5.0, 1.5}, {5.0, 1.5})));
}

TEST_F(Stopped, ComesBackFromWhereItWasSetTo) {
  stop();
  ASSERT_TRUE(tracker_->setNearObstacles({}));
  state_.y() += 0.8;
  sail(30.0);
  EXPECT_LT(state_.head<2>().norm(), 0.2);
}

// Abeam of 20 N a hull with 20 kg/s of drag is set aside by 1 m/s: a turn there, as at a launch
// that was planned for still water, yields to the place where it is made.
TEST_F(TrackerTest, TurnsOnlyAsFarAsThePlaceCanBeKept) {
  disturbance_.force_n = {-20.0, 0.0};
  const auto turn = [](double psi_rad) {
    return trajectory::Trajectory(
        {trajectory::spinPiece(Eigen::Vector2d::Zero(), 0.0, psi_rad, 8.0)});
  };
  ASSERT_TRUE(tracker_->setTrajectory({turn(0.0), now_s_}));
  sail(7.0);
  ASSERT_LT(state_.head<2>().norm(), 0.1);
  ASSERT_TRUE(tracker_->setTrajectory({turn(0.5 * kPi), now_s_}));
  for (int k = 0; k < 7; ++k) {
    EXPECT_LT(sail(1.0).tracking_error_m, 0.3);
  }
}

// Nothing that is measured afterwards may be taken for older than it.
TEST_F(TrackerTest, StopsForOdometryStampedAheadAndTakesWhatComesNext) {
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}));
  sail(10.0);
  tracker_->addOdometry(now_s_ + 1000.0, state_);
  Command command = tracker_->step(now_s_);
  EXPECT_EQ(command.mode, Mode::kStopping);
  EXPECT_EQ(command.reason, "odometry lost");
  now_s_ += 0.01;
  sail(8.0);
  state_[0] += 3.0;  // which is seen
  command = sail(1.0);
  EXPECT_EQ(command.mode, Mode::kStopped);
  EXPECT_LT((command.estimate - state_).head<2>().norm(), 0.1);
}

TEST_F(TrackerTest, StopsWhenTheClockIsSetBackAndTakesOdometryOfItsNewTime) {
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}));
  sail(10.0);
  now_s_ -= 50.0;
  EXPECT_EQ(sail(0.1, false).reason, "odometry lost");
  EXPECT_EQ(sail(6.0, false).mode, Mode::kFault);
  EXPECT_EQ(sail(2.0).mode, Mode::kStopped);
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}));
  EXPECT_EQ(sail(1.0).mode, Mode::kTracking);
}

// Odometry of the new time may come before the next step, so that none is missed.
TEST_F(TrackerTest, StopsWhereItIsWhenClockAndOdometryAreSetBackTogether) {
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}));
  sail(10.0);
  const double far_m = state_[0];
  ASSERT_GT(far_m, 10.0);
  now_s_ -= 50.0;
  const Command command = sail(0.1);
  EXPECT_EQ(command.mode, Mode::kStopping);
  EXPECT_EQ(command.reason, "the clock was set back");
  sail(20.0);
  EXPECT_GT(state_[0], far_m);
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}));
  EXPECT_EQ(sail(1.0).mode, Mode::kTracking);
}

TEST_F(TrackerTest, BridgesAShortGapAndStopsOnALongOne) {
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}));
  sail(10.0);
  EXPECT_EQ(sail(0.3, false).mode, Mode::kTracking);
  EXPECT_EQ(sail(2.0).mode, Mode::kTracking);
  const Command lost = sail(1.0, false);
  EXPECT_EQ(lost.mode, Mode::kStopping);
  EXPECT_EQ(lost.reason, "odometry lost");
  const Command blind = sail(10.0, false);
  EXPECT_EQ(blind.mode, Mode::kFault);
  EXPECT_EQ(blind.thrusts, vessel::Thrusts::Zero());
  EXPECT_EQ(sail(1.0).mode, Mode::kStopped);
}

TEST_F(TrackerTest, DropsOdometryThatIsNotFiniteOrJumps) {
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}));
  sail(10.0);
  vessel::State bad = state_;
  bad[1] = std::numeric_limits<double>::quiet_NaN();
  tracker_->addOdometry(now_s_, bad);
  EXPECT_EQ(tracker_->step(now_s_).reason, "odometry is not finite");
  bad = state_;
  bad[1] += 20.0;
  tracker_->addOdometry(now_s_ + 0.001, bad);
  const Command command = tracker_->step(now_s_ + 0.002);
  EXPECT_EQ(command.reason, "odometry jumps");
  EXPECT_LT(command.tracking_error_m, 0.5);
  now_s_ += 0.01;
  EXPECT_TRUE(sail(0.1).reason.empty());
}

// Behind its trajectory a vessel catches up, but not beyond the speed limit.
TEST_F(TrackerTest, KeepsToTheSpeedLimitWhenBehind) {
  vessel::FlatPoint from;
  from.velocity.x() = 1.0;
  vessel::FlatPoint to = from;
  to.position.x() = 60.0;
  const trajectory::Trajectory steady({trajectory::hermitePiece(from, to, 60.0)});
  struct Case {
    double behind_m;  // the second is led back along a curve of its own
    double limit;
  };
  for (const auto& [behind_m, limit] :
       {Case{1.5, 1.0}, Case{1.5, 1.2}, Case{5.0, 1.0}, Case{5.0, 1.2}}) {
    state_.setZero();
    state_[vessel::kX] = -behind_m;
    state_[vessel::kSurge] = 0.9;
    now_s_ += 1000.0;
    tracker_ = Tracker::create(load(), vessel_);
    sail(0.02);
    ASSERT_TRUE(tracker_->setTrajectory({steady, now_s_, limit}));
    double fastest = 0.0;
    for (int i = 0; i < 300; ++i) {
      sail(0.1);
      fastest = std::max(fastest, state_.segment<2>(vessel::kSurge).norm());
    }
    EXPECT_LT(fastest, 1.03 * limit);
    EXPECT_GT(fastest, 0.97 * limit);
  }
}

// A plan by the manoeuvring model may go astern for a moment, slower than walking: the hull isn't
// turned round for that, nor if the way is given anew just then.
class TrackerOfAnOtter : public ::testing::TestWithParam<bool> {};

TEST_P(TrackerOfAnOtter, KeepsItsHeadingOnAMomentAstern) {
  const auto options = config::load<Options>(kSource + "/config/tracker.yaml");
  ASSERT_TRUE(options) << options.error().message;
  const auto vessel = vessel::loadParameters(kSource + "/config/vessels/otter.yaml");
  ASSERT_TRUE(vessel) << vessel.error().message;
  const auto tracker = Tracker::create(*options, *vessel);
  vessel::FlatPoint ahead;
  ahead.velocity.x() = 0.25;
  vessel::FlatPoint nearby = ahead;
  nearby.position.x() = 0.2;
  vessel::FlatPoint end;
  end.position.x() = 1.5;
  const trajectory::Trajectory path(
      {trajectory::hermitePiece(ahead, nearby, 5.0), trajectory::hermitePiece(nearby, end, 8.0)});
  vessel::State state = vessel::State::Zero();
  state[vessel::kSurge] = 0.25;
  double now_s = 10.0;
  double slowest = 0.0;
  int given_anew = 0;
  tracker->addOdometry(now_s, state);
  ASSERT_TRUE(tracker->setTrajectory({path, now_s}));
  while (now_s < 10.0 + path.duration()) {
    tracker->addOdometry(now_s, state);
    const Command command = tracker->step(now_s);
    state = rk4Step(
        [&](double, const vessel::State& x) {
          return vessel::stateDerivative(x, command.thrusts, vessel->manoeuvring, vessel->thrusters,
                                         {});
        },
        0.0, state, 0.01);
    now_s += 0.01;
    if (given_anew == 0 && GetParam() && path.flat(now_s - 10.0).velocity.x() < -0.05) {
      ++given_anew;
      ASSERT_TRUE(tracker->setTrajectory({path, 10.0}));
    }
    slowest = std::min(slowest, state[vessel::kSurge]);
    ASSERT_LT(std::abs(wrapAngle(state[vessel::kPsi])), 0.2) << "at " << now_s - 10.0 << " s";
  }
  EXPECT_EQ(given_anew, GetParam() ? 1 : 0);
  EXPECT_LT(slowest, -0.05);
  EXPECT_LT((state.head<2>() - end.position).norm(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(GivenOnceAndAgain, TrackerOfAnOtter, ::testing::Bool());

// Largest distance from a straight way across waves that take the hull along, once it has been
// under way for a while.
double worstAcrossWaves(bool foresees) {
  auto options = config::load<Options>(kSource + "/config/tracker.yaml");
  const auto vessel = vessel::loadParameters(kSource + "/config/vessels/otter.yaml");
  EXPECT_TRUE(options && vessel);
  if (!foresees) {
    options->estimator.wave_velocity_mps = 0.0;
  }
  const auto tracker = Tracker::create(*options, *vessel);
  vessel::FlatPoint from;
  from.velocity.x() = 1.6;
  vessel::FlatPoint to = from;
  to.position.x() = 96.0;
  const trajectory::Trajectory path({trajectory::hermitePiece(from, to, 60.0)});
  const auto waterAt = [](double t) -> WaterMotion {
    constexpr double kRadps = 1.9;
    constexpr double kOrbitalMps = 0.25;
    const Eigen::Vector2d to_leeward(0.5, 0.8);
    return {kOrbitalMps * std::sin(kRadps * t) * to_leeward,
            kRadps * kOrbitalMps * std::cos(kRadps * t) * to_leeward};
  };
  vessel::State state = vessel::State::Zero();
  state[vessel::kSurge] = 1.6;
  tracker->addOdometry(0.0, state);
  EXPECT_TRUE(tracker->setTrajectory({path, 0.0}));
  double worst = 0.0;
  for (double now_s = 0.0; now_s < 59.0; now_s += 0.01) {
    tracker->addOdometry(now_s, state);
    const Command command = tracker->step(now_s);
    state = rk4Step(
        [&](double t, const vessel::State& x) {
          return derivativeInWater(x, command.thrusts, *vessel, {}, waterAt(t));
        },
        now_s, state, 0.01);
    if (now_s > 20.0) {
      worst = std::max(worst, (state.head<2>() - path.flat(now_s + 0.01).position).norm());
    }
  }
  return worst;
}

TEST(TrackerInWaves, KeepsNearerToItsWayWhereItForeseesThem) {
  const double unforeseen = worstAcrossWaves(false);
  EXPECT_GT(unforeseen, 0.05);
  EXPECT_LT(worstAcrossWaves(true), 0.85 * unforeseen);
}

// What is sent is cut as the bow comes up (BowGuard says how), and what turns the hull is kept.
TEST_F(TrackerTest, PushesNothingAheadWithTheBowHigh) {
  const auto push = [&](double bow_up_rad) {
    tracker_ = Tracker::create(load(), vessel_);
    state_.setZero();
    now_s_ += 1000.0;
    sail(0.02);
    EXPECT_TRUE(tracker_->setTrajectory({line(60.0, 25.0), now_s_}));
    sail(3.0);
    state_[vessel::kPsi] -= 0.1;
    vessel::Thrusts thrusts;
    for (int i = 0; i < 10; ++i) {
      tracker_->addOdometry(now_s_, state_, bow_up_rad);
      thrusts = tracker_->step(now_s_).thrusts;
      now_s_ += 0.01;
    }
    return thrusts;
  };
  EXPECT_GT(push(0.0).sum(), 0.4 * vessel_.thrusters.ahead_max_n);
  const vessel::Thrusts high = push(0.65);
  EXPECT_LE(high.sum(), 1e-9);
  EXPECT_GT(high[vessel::kRight] - high[vessel::kLeft], 5.0);
}

// A bow that is high, on a trailer or when it was seen last, starts no thrusters.
TEST_F(TrackerTest, PushesNothingIdleOrBlindWhateverTheBowDoes) {
  const auto step = [&](bool odometry, double bow_up_rad) {
    if (odometry) {
      tracker_->addOdometry(now_s_, state_, bow_up_rad);
    }
    const Command command = tracker_->step(now_s_);
    now_s_ += 0.01;
    return command;
  };
  Command command;
  for (int i = 0; i < 50; ++i) {
    command = step(true, 0.9);
  }
  EXPECT_EQ(command.mode, Mode::kIdle);
  EXPECT_EQ(command.thrusts, vessel::Thrusts::Zero());
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 25.0), now_s_}));
  step(true, 0.9);
  for (int i = 0; i < 80; ++i) {
    command = step(false, 0.0);
  }
  EXPECT_EQ(command.mode, Mode::kStopping);
  EXPECT_GT(command.thrusts.minCoeff(), -1.0) << "the bow isn't known any more";
  for (int i = 0; i < 1000; ++i) {
    command = step(false, 0.0);
  }
  EXPECT_EQ(command.mode, Mode::kFault);
  EXPECT_EQ(command.thrusts, vessel::Thrusts::Zero());
}

// A speed that isn't true leads no farther than one that the vessel has.
TEST_F(TrackerTest, StopsNearWhateverSpeedItIsTold) {
  sail(0.1);
  vessel::State told = state_;
  told[vessel::kSurge] = 3.0 * vessel_.top_speed_mps;
  for (int i = 0; i < 20; ++i) {
    tracker_->addOdometry(now_s_, told);
    tracker_->step(now_s_);
    now_s_ += 0.01;
  }
  tracker_->requestStop("asked");
  tracker_->addOdometry(now_s_, told);
  tracker_->step(now_s_);
  now_s_ += 0.01;
  const double braking_mps2 =
      2.0 * vessel_.thrusters.astern_max_n / vessel_.manoeuvring.surge_inertia_kg;
  const double top_speed_mps = vessel_.top_speed_mps;
  sail(40.0);
  EXPECT_LT(state_.head<2>().norm(), 1.5 * top_speed_mps * top_speed_mps / braking_mps2);
}

// Weights come in from the next step on.
TEST_F(TrackerTest, TakesNewWeights) {
  const auto offset = [&](double position) {
    tracker_ = Tracker::create(load(), vessel_);
    Weights weights = tracker_->options().flatness;
    weights.position = position;
    tracker_->setWeights(weights);
    state_.setZero();
    now_s_ += 1000.0;
    sail(0.02);
    EXPECT_TRUE(tracker_->setTrajectory({line(40.0, 25.0), now_s_}));
    state_[vessel::kX] = -0.3;
    return sail(0.3).thrusts.sum();
  };
  EXPECT_GT(offset(1000.0), 1.2 * offset(1.0));
}

TEST_F(TrackerTest, RefusesTrajectoriesThatCannotBeSailed) {
  sail(0.1);
  const auto refused = [&](trajectory::Trajectory t, double start_s, const std::string& why) {
    const Status status = tracker_->setTrajectory({std::move(t), start_s});
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().message.find(why), std::string::npos) << status.error().message;
  };
  refused(trajectory::Trajectory(), now_s_, "no pieces");
  refused(line(10.0, 5.0), now_s_ - 6.0, "ended");
  refused(line(100.0, 20.0), now_s_, "m/s");  // up to 11 m/s
  refused(line(10.0, 5.0), std::numeric_limits<double>::quiet_NaN(), "start time");
  trajectory::Piece piece = line(10.0, 5.0).pieces()[0];
  trajectory::Piece broken = piece;
  broken.position(0, 3) = std::numeric_limits<double>::infinity();
  refused(trajectory::Trajectory({piece, broken}), now_s_, "pieces[1]: a coefficient");
  refused(trajectory::Trajectory({piece, piece}), now_s_, "pieces[1] begins");
  piece.duration_s = 0.0;
  refused(trajectory::Trajectory({piece}), now_s_, "duration");
}

// Where others steer, the estimate does not take their doing for the sea's.
TEST_F(TrackerTest, KnowsWhatWasSentInsteadOfItsCommand) {
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}));
  const auto misled = Tracker::create(load(), vessel_);
  ASSERT_TRUE(misled->setTrajectory({line(60.0, 30.0), now_s_}));
  const vessel::Thrusts sent(12.0, 12.0);
  Command told;
  Command untold;
  for (int i = 0; i < 500; ++i) {
    for (Tracker* each : {tracker_.get(), misled.get()}) {
      each->addOdometry(now_s_, state_);
    }
    told = tracker_->step(now_s_);
    tracker_->replaceCommand(sent);
    untold = misled->step(now_s_);
    state_ = rk4Step(
        [&](double, const vessel::State& x) {
          return vessel::stateDerivative(x, sent, vessel_.manoeuvring, vessel_.thrusters, {});
        },
        0.0, state_, 0.01);
    now_s_ += 0.01;
  }
  EXPECT_LT(told.outside_force_n.norm(), 0.5);
  EXPECT_GT(untold.outside_force_n.norm(), 5.0);
}

TEST_F(TrackerTest, NumbersItsStepsAndWhatTheyWereMadeWith) {
  sail(0.1);
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}, 7));
  const Command command = sail(0.2);
  EXPECT_EQ(command.cycle, 30U);
  EXPECT_EQ(command.odometry_taken, 30U);
  EXPECT_NEAR(command.odometry_stamp_s, command.stamp_s, 1e-12);
  EXPECT_EQ(command.order_taken, 7U);
  tracker_->requestStop("asked", now_s_ + 0.1, 8);
  const Command before = sail(0.1);
  EXPECT_EQ(before.order_taken, 8U);
  EXPECT_EQ(before.mode, Mode::kTracking);
  EXPECT_EQ(sail(0.05).reason, "asked");
}

// A stop that is asked for while a swing has the hull aside of the spot it holds keeps that spot.
TEST_F(TrackerTest, StopsAtTheSpotThatItHoldsWhateverTheSwing) {
  ASSERT_TRUE(tracker_->setTrajectory({line(6.0, 10.0), now_s_}));
  ASSERT_EQ(sail(14.0).mode, Mode::kHolding);
  const Eigen::Vector2d spot(6.0, 0.0);
  ASSERT_LT((state_.head<2>() - spot).norm(), 0.05);
  state_.x() += 0.15;
  state_[vessel::kPsi] += 0.2;
  sail(0.2);
  tracker_->requestStop("the operator said so");
  EXPECT_EQ(sail(10.0).mode, Mode::kStopped);
  EXPECT_LT((state_.head<2>() - spot).norm(), 0.05);
  EXPECT_LT(std::abs(wrapAngle(state_[vessel::kPsi])), 0.05);
}

TEST_F(TrackerTest, StopsOnRequestAndSailsOnWithTheNextTrajectory) {
  ASSERT_TRUE(tracker_->setTrajectory({line(60.0, 30.0), now_s_}));
  sail(10.0);
  tracker_->requestStop("the operator said so");
  EXPECT_EQ(sail(0.1).reason, "the operator said so");
  EXPECT_EQ(sail(15.0).mode, Mode::kStopped);
  EXPECT_LT(state_.tail<3>().norm(), 0.2);
  vessel::FlatPoint start;
  start.position = state_.head<2>();
  vessel::FlatPoint end;
  end.position = start.position + Eigen::Vector2d(20.0, 0.0);
  ASSERT_TRUE(tracker_->setTrajectory(
      {trajectory::Trajectory({trajectory::hermitePiece(start, end, 15.0)}), now_s_}));
  EXPECT_EQ(sail(1.0).mode, Mode::kTracking);
}

}  // namespace
}  // namespace otter_nav::tracker
