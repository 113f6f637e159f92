#include "control_loop.hpp"

#include <pthread.h>
#include <ros/console.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "pacer.hpp"

namespace otter_nav::nodes {
namespace {

// The loop's time runs by its own period and leans towards the clock, whose steps (a simulator's,
// say) would otherwise shake the reference.
class SmoothTime {
 public:
  explicit SmoothTime(double period_s) : period_s_(period_s) {}

  double next(double clock_s) {
    time_s_ += period_s_;
    const double error_s = clock_s - time_s_;
    time_s_ += std::abs(error_s) > kJumpS ? error_s : kGain * error_s;
    return time_s_;
  }

 private:
  static constexpr double kJumpS = 0.5;
  static constexpr double kGain = 0.02;
  double period_s_;
  double time_s_ = 0.0;
};

// Ahead of everything that is not this urgent, where the system allows it.
void askForRealTime() {
  sched_param parameters{};
  parameters.sched_priority = 50;
  if (pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) != 0) {
    ROS_INFO("The control loop runs at normal priority (SCHED_FIFO is not permitted)");
  }
}

}  // namespace

double timedStep(tracker::Tracker& tracker, double now_s, tracker::Command& command) {
  const auto start = std::chrono::steady_clock::now();
  command = tracker.step(now_s);
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  return taken.count();
}

ControlLoop::ControlLoop(const Options& options, tracker::Tracker& tracker,
                         CycleStatistics& statistics, std::function<double()> now_s,
                         std::function<void(const ControlOutput&)> publish)
    : options_(options),
      tracker_(tracker),
      statistics_(statistics),
      now_s_(std::move(now_s)),
      publish_(std::move(publish)) {
  sem_init(&available_, 0, 0);
  publisher_ = std::thread([this] { publishAll(); });
  controller_ = std::thread([this] { control(); });
}

ControlLoop::~ControlLoop() {
  running_ = false;
  controller_.join();
  sem_post(&available_);
  publisher_.join();
  sem_destroy(&available_);
}

void ControlLoop::control() {
  askForRealTime();
  SmoothTime time(options_.period_s);
  Pacer pacer(options_.period_s / options_.speed);
  ControlOutput output;
  pacer.start();
  for (int step = 0; running_; ++step) {
    const double late_s = pacer.waitForNextTurn();
    const double now_s = time.next(now_s_());
    const double solver_ms = timedStep(tracker_, now_s, output.command);
    output.has_prediction = step % options_.prediction_interval == 0;
    if (output.has_prediction) {
      output.prediction = tracker_.prediction();
    }
    if (outputs_.push(output)) {
      sem_post(&available_);
    }
    statistics_.add(solver_ms, late_s * 1e3);
    tracker_.prepare(now_s + options_.period_s);
  }
}

void ControlLoop::publishAll() {
  ControlOutput output;
  while (running_) {
    sem_wait(&available_);
    while (outputs_.pop(output)) {
      publish_(output);
    }
  }
}

}  // namespace otter_nav::nodes
