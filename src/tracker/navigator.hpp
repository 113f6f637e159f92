// Where the vessel is and what pushes it: takes odometry that may be late, lost, out of order or
// wrong, and gives the state at any time near now.
#pragma once

#include <string_view>
#include <vector>

#include "otter_nav/tracker/options.hpp"
#include "tracker/estimator.hpp"

namespace otter_nav::tracker {

// Braking by the model alone without odometry; then it is too old to mean anything.
constexpr double kBlindS = 5.0;

enum class Fix {
  kNone,  // no odometry yet
  kGood,
  kBridging,  // the last one is some periods old: the model predicts
  kLost,      // too old to steer by
};

class Navigator {
 public:
  Navigator(const Options& options, const vessel::Parameters& vessel);

  // The clock stands at `now_s`: what is stamped farther ahead of it than the model predicts
  // (wrongly, or before the clock was set back) is lost, and the next odometry is taken whatever
  // its stamp.
  void forgetWhatIsAhead(double now_s) { ahead_ = started_ && isAhead(silence(now_s)); }
  // In order of arrival. The state of a refusal is in reason().
  void addOdometry(double stamp_s, const vessel::State& state);
  // What was sent to the thrusters at `stamp_s`.
  void addCommand(double stamp_s, const vessel::Thrusts& thrusts);
  // Of the last one.
  void replaceCommand(const vessel::Thrusts& thrusts);

  [[nodiscard]] Fix fix(double now_s) const;
  // The state at `time_s`, psi continuous, thrusts following the last command.
  [[nodiscard]] vessel::State predict(double time_s) const;
  [[nodiscard]] const vessel::Disturbance& disturbance() const { return disturbance_; }
  // How waves will move the water, beside the current: still as long as it isn't foreseen.
  [[nodiscard]] WaterMotion water(double time_s) const;
  [[nodiscard]] vessel::DisturbanceEstimate disturbanceEstimate() const {
    return estimator_.disturbanceEstimate();
  }
  // Why odometry was refused last; empty once it is accepted again.
  [[nodiscard]] std::string_view reason() const { return reason_; }

 private:
  struct Sent {
    double stamp_s;
    vessel::Thrusts thrusts;
  };
  [[nodiscard]] long oldest() const;
  [[nodiscard]] Sent& sent(long index);
  [[nodiscard]] const Sent& sent(long index) const;
  // Of the command in force just after `time_s`; before the oldest where none is known.
  [[nodiscard]] long sentBy(double time_s) const;
  [[nodiscard]] vessel::Thrusts thrustsOf(long index) const;
  // Calls `step(thrusts, dt)` for pieces of constant command from the last odometry to `until_s`;
  // `acting` follows the commands with the propellers' lag.
  template <typename Step>
  void forEachPiece(double until_s, vessel::Thrusts& acting, Step step) const;
  // No vessel of this kind does that, whatever carries it.
  [[nodiscard]] bool possible(const vessel::State& state) const;
  [[nodiscard]] bool believable(double stamp_s, const vessel::State& state);
  void reset(const vessel::State& measured);
  // Since the last odometry that was believed; negative when it is stamped ahead of `now_s`.
  [[nodiscard]] double silence(double now_s) const {
    return now_s - (jumping_ ? jump_since_s_ : stamp_s_);
  }
  [[nodiscard]] bool isAhead(double silence_s) const {
    return silence_s < -options_.predict_through_s;
  }
  [[nodiscard]] bool isFinite() const;
  // What is estimated means nothing any more.
  void beginAnew(const vessel::State& measured);
  // What is steered by, after `since_s` under what was felt last.
  void weighCurrents(double since_s);

  OdometryOptions options_;
  double period_s_;
  vessel::Parameters vessel_;
  double impossible_mps_;
  double impossible_radps_;
  Estimator estimator_;
  // The same with waves in the water: what is steered by under way, once it had time to tell them
  // from the current.
  Estimator seaway_;
  // As they were made.
  Estimator new_estimator_;
  Estimator new_seaway_;
  bool foresees_waves_;
  double felt_s_ = 0.0;
  double under_way_s_ = 0.0;
  double seaway_share_ = 0.0;
  vessel::Disturbance disturbance_;
  vessel::Thrusts acting_ = vessel::Thrusts::Zero();
  double stamp_s_ = 0.0;
  bool started_ = false;
  bool ahead_ = false;
  double jump_since_s_ = 0.0;
  bool jumping_ = false;
  std::string_view reason_;
  std::vector<Sent> sent_;  // a ring, of all since the odometry that is predicted from
  long sent_count_ = 0;
};

}  // namespace otter_nav::tracker
