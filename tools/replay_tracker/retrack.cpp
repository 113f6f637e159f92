#include "replay_tracker/retrack.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <sstream>
#include <utility>

#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/vessel/thrusters.hpp"
#include "replay_tracker/simulated_hull.hpp"

namespace otter_nav::replay {
namespace {

using tracker::Tracker;

std::string seconds(double value) {
  std::ostringstream out;
  out.precision(3);
  out << std::fixed << value << " s";
  return out.str();
}

// Hands the recorded odometry over as the node did.
class OdometryFeed {
 public:
  explicit OdometryFeed(const std::vector<RecordedOdometry>& all) : all_(all) {}

  // What `cycle` took; an error where the recording has more or less.
  Status give(const RecordedCycle& cycle, Tracker& tracker) {
    if (!begun_ && cycle.number > 1 && cycle.odometry_taken > 0) {
      taken_ = cycle.odometry_taken - 1;  // begun cold: the rest is not to be had
    }
    begun_ = true;
    const std::uint64_t wanted = cycle.odometry_taken - taken_;
    taken_ = cycle.odometry_taken;
    if (wanted == 0) {
      return {};
    }
    std::vector<const RecordedOdometry*> here;
    for (; next_ < all_.size() && all_[next_].stamp_s <= cycle.odometry_stamp_s; ++next_) {
      here.push_back(&all_[next_]);
    }
    if (here.size() > wanted) {
      // In lockstep a message sent again is no second one.
      here.erase(std::unique(here.begin(), here.end(),
                             [](const auto* a, const auto* b) { return a->stamp_s == b->stamp_s; }),
                 here.end());
    }
    if (first_ && here.size() > wanted) {  // what came before the tracker began
      here.erase(here.begin(), here.end() - static_cast<std::ptrdiff_t>(wanted));
    }
    first_ = false;
    for (const RecordedOdometry* odometry : here) {
      tracker.addOdometry(odometry->stamp_s, odometry->state, odometry->bow_up_rad);
    }
    if (here.size() != wanted) {
      return failure("step " + std::to_string(cycle.number) + " at " + seconds(cycle.time_s) +
                     " took " + std::to_string(wanted) + " odometry messages, the recording has " +
                     std::to_string(here.size()) + " of them");
    }
    return {};
  }

 private:
  const std::vector<RecordedOdometry>& all_;
  std::size_t next_ = 0;
  std::uint64_t taken_ = 0;
  bool begun_ = false;  // with the run's first step
  bool first_ = true;   // no odometry yet
};

// The last with that id recorded before the step, else the next after it: a latched message may
// have come later to the recorder.
template <typename Recorded>
const Recorded* lastBefore(const RecordedCycle& cycle, std::uint32_t id,
                           const std::vector<Recorded>& all) {
  const Recorded* found = nullptr;
  for (const Recorded& each : all) {
    if (each.id == id && (found == nullptr || each.position < cycle.position)) {
      found = &each;
    }
  }
  return found;
}

// Hands the trajectories over before the steps that took them.
class OrderFeed {
 public:
  explicit OrderFeed(const std::vector<RecordedOrder>& all) : all_(all) {}

  Status give(const RecordedCycle& cycle, bool lockstep, Tracker& tracker) {
    if (cycle.order_taken == taken_) {
      return {};
    }
    taken_ = cycle.order_taken;
    const RecordedOrder* order = lastBefore(cycle, taken_, all_);
    if (order == nullptr) {
      return failure("trajectory " + std::to_string(taken_) + ", taken at " +
                     seconds(cycle.time_s) + ", is not in the recording");
    }
    if (order->timed.trajectory.empty()) {
      tracker.requestStop("asked to stop", lockstep ? order->timed.start_time_s : 0.0, order->id);
      return {};
    }
    return tracker.setTrajectory(order->timed, order->id);
  }

 private:
  const std::vector<RecordedOrder>& all_;
  std::uint32_t taken_ = 0;
};

// And the near obstacles.
class NearFeed {
 public:
  explicit NearFeed(const std::vector<RecordedNearObstacles>& all) : all_(all) {}

  Status give(const RecordedCycle& cycle, bool lockstep, Tracker& tracker) {
    if (cycle.near_taken == taken_) {
      return {};
    }
    taken_ = cycle.near_taken;
    const RecordedNearObstacles* recorded = lastBefore(cycle, taken_, all_);
    if (recorded == nullptr) {
      return failure("near obstacles " + std::to_string(taken_) + ", taken at " +
                     seconds(cycle.time_s) + ", are not in the recording");
    }
    tracker::NearObstacles near = recorded->near;
    if (!lockstep) {
      near.start_s = 0.0;
    }
    return tracker.setNearObstacles(std::move(near), recorded->id);
  }

 private:
  const std::vector<RecordedNearObstacles>& all_;
  std::uint32_t taken_ = 0;
};

// Sets the weights that each step had.
class WeightsFeed {
 public:
  explicit WeightsFeed(const Settings& settings) : settings_(settings) {}

  void give(const tracker::Weights& recorded, Tracker& tracker) {
    tracker::Weights weights = recorded;
    for (const auto one : settings_.pinned) {
      weights.*one = settings_.options.flatness.*one;
    }
    if (!(weights == given_)) {
      given_ = weights;
      tracker.setWeights(weights);
    }
  }

 private:
  const Settings& settings_;
  tracker::Weights given_ = settings_.options.flatness;
};

bool tracks(const tracker::Command& command) {
  return command.mode == tracker::Mode::kTracking || command.mode == tracker::Mode::kHolding;
}

}  // namespace

Figures figures(const std::vector<Step>& steps, const vessel::Thrusters& limits) {
  constexpr double kNear = 0.005;
  Figures f;
  f.steps = steps.size();
  std::size_t tracked = 0;
  double squared_n = 0.0;
  double thrust_n = 0.0;
  double rate_nps = 0.0;
  double saturated = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& s = steps[i];
    const vessel::Thrusts& thrusts = s.command.thrusts;
    const vessel::Thrusts difference = thrusts - s.recorded.thrusts_n;
    // Written so that a difference that is not a number counts as the worst.
    if (!(difference.cwiseAbs().maxCoeff() <= f.difference_max_n)) {
      f.difference_max_n = difference.cwiseAbs().maxCoeff();
      f.difference_max_time_s = s.recorded.time_s;
    }
    squared_n += difference.squaredNorm();
    thrust_n += thrusts.squaredNorm();
    saturated +=
        static_cast<double>((thrusts.array() >= (1.0 - kNear) * limits.ahead_max_n).count() +
                            (thrusts.array() <= -(1.0 - kNear) * limits.astern_max_n).count());
    f.yaw_rate_rms_radps += std::pow(s.command.estimate[vessel::kYawRate], 2);
    if (i > 0) {
      const double dt = s.recorded.time_s - steps[i - 1].recorded.time_s;
      rate_nps += dt > 0.0 ? ((thrusts - steps[i - 1].command.thrusts) / dt).squaredNorm() : 0.0;
    }
    if (tracks(s.command)) {
      ++tracked;
      f.error_mean_m += s.command.tracking_error_m;
      f.error_max_m = std::max(f.error_max_m, s.command.tracking_error_m);
    }
  }
  const double n = static_cast<double>(std::max<std::size_t>(1, steps.size()));
  f.difference_rms_n = std::sqrt(squared_n / (2.0 * n));
  f.thrust_rms_n = std::sqrt(thrust_n / (2.0 * n));
  f.thrust_rate_rms_nps = std::sqrt(rate_nps / (2.0 * std::max(1.0, n - 1.0)));
  f.saturated_share = saturated / (2.0 * n);
  f.yaw_rate_rms_radps = std::sqrt(f.yaw_rate_rms_radps / n);
  f.error_mean_m /= static_cast<double>(std::max<std::size_t>(1, tracked));
  return f;
}

Result<std::vector<Step>> retrack(const RecordedRun& run, const Settings& settings,
                                  const vessel::Parameters& vessel, const Window& window, Sent sent,
                                  bool partial, std::vector<std::string>& notes) {
  const auto tracker = Tracker::create(settings.options, vessel);
  WeightsFeed weights(settings);
  OdometryFeed odometry(run.odometry);
  OrderFeed orders(run.orders);
  NearFeed near(run.near);
  std::vector<Step> steps;
  std::size_t holes = 0;
  std::string first_hole;
  std::uint64_t last = run.from_commands ? 0 : run.cycles.front().number - 1;
  for (const RecordedCycle& cycle : run.cycles) {
    if (window.to_s && cycle.time_s > *window.to_s) {
      break;
    }
    Status status;
    if (!run.from_commands && cycle.number != last + 1) {
      status = failure("the steps " + std::to_string(last + 1) + " to " +
                       std::to_string(cycle.number - 1) + " before " + seconds(cycle.time_s) +
                       " are not in the recording");
    }
    last = cycle.number;
    const Status fed = odometry.give(cycle, *tracker);
    const Status ordered = orders.give(cycle, run.lockstep, *tracker);
    const Status told = near.give(cycle, run.lockstep, *tracker);
    for (const Status* each :
         std::initializer_list<const Status*>{&status, &fed, &ordered, &told}) {
      if (!*each) {
        if (!partial) {
          return failure(each->error().message + "; --partial goes on without");
        }
        first_hole = holes++ == 0 ? each->error().message : first_hole;
      }
    }
    Step step;
    step.recorded = cycle;
    if (!run.from_commands) {
      weights.give(cycle.weights, *tracker);
    }
    step.command = tracker->step(cycle.time_s);
    if (sent == Sent::kRecorded) {
      tracker->replaceCommand(cycle.thrusts_n);
    }
    tracker->prepare(step.command.stamp_s + settings.options.period_s);
    if (window.has(cycle.time_s)) {
      steps.push_back(std::move(step));
    }
  }
  if (holes > 0) {
    notes.push_back(std::to_string(holes) + " holes, the first: " + first_hole);
  }
  if (steps.empty()) {
    return failure("no step of the run, " + seconds(run.cycles.front().time_s) + " to " +
                   seconds(run.cycles.back().time_s) + ", lies between --from and --to");
  }
  return steps;
}

Result<std::vector<Step>> sailAgain(const RecordedRun& run, const Settings& settings,
                                    const vessel::Parameters& vessel, Hull hull,
                                    const Window& window) {
  const auto first = std::find_if(
      run.cycles.begin(), run.cycles.end(),
      [&](const RecordedCycle& cycle) { return cycle.tracking && window.has(cycle.time_s); });
  if (first == run.cycles.end()) {
    return failure("the tracker follows no trajectory between --from and --to");
  }
  auto vessel_model =
      hull == Hull::kPlant ? SimulatedHull::plant(vessel) : SimulatedHull::model(vessel);
  if (!vessel_model) {
    return failure(vessel_model.error().message);
  }
  SimulatedHull& simulated = **vessel_model;
  simulated.place(first->estimate, first->thrusts_n);
  const tracker::Options& options = settings.options;
  const auto tracker = Tracker::create(options, vessel);
  WeightsFeed weights(settings);
  OrderFeed orders(run.orders);
  NearFeed near(run.near);
  std::vector<Step> steps;
  for (auto cycle = first; cycle != run.cycles.end(); ++cycle) {
    if (!window.has(cycle->time_s)) {
      break;
    }
    const Status ordered = orders.give(*cycle, run.lockstep, *tracker);
    const Status told = near.give(*cycle, run.lockstep, *tracker);
    if (const Status status = firstFailure(ordered, told); !status) {
      return failure(status.error().message);
    }
    tracker->addOdometry(cycle->time_s + options.odometry.latency_s, simulated.state());
    Step step;
    step.recorded = *cycle;
    step.truth = simulated.state();
    weights.give(cycle->weights, *tracker);
    step.command = tracker->step(cycle->time_s);
    tracker->prepare(cycle->time_s + options.period_s);
    if (tracks(step.command)) {
      step.command.tracking_error_m =
          (step.truth.head<2>() - step.command.reference.head<2>()).norm();
    }
    const auto after = cycle + 1;
    const double dt_s =
        after == run.cycles.end() ? options.period_s : after->time_s - cycle->time_s;
    simulated.advance(step.command.thrusts, cycle->disturbance, dt_s);
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace otter_nav::replay
