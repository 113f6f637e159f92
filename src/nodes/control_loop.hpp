// The tracker's own clockwork when nobody steps it: a thread that wakes at absolute times, steps
// the tracker and hands its output to a second thread to publish. The first thread neither
// allocates nor waits for anybody.
#pragma once

#include <semaphore.h>

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <functional>
#include <thread>

#include "cycle_statistics.hpp"
#include "otter_nav/tracker/tracker.hpp"

namespace otter_nav::nodes {

// One step's outcome; the prediction is filled now and then.
struct ControlOutput {
  tracker::Command command;
  bool has_prediction = false;
  tracker::Prediction prediction;
};

class ControlLoop {
 public:
  struct Options {
    double period_s = 0.01;        // of the tracker's time
    double speed = 1.0;            // tracker's time over wall time
    int prediction_interval = 10;  // steps
  };
  // `now_s` is the time of the tracker's world, s (steps of a clock are smoothed); `publish` runs
  // in the second thread.
  ControlLoop(const Options& options, tracker::Tracker& tracker, CycleStatistics& statistics,
              std::function<double()> now_s, std::function<void(const ControlOutput&)> publish);
  ~ControlLoop();
  ControlLoop(const ControlLoop&) = delete;
  ControlLoop& operator=(const ControlLoop&) = delete;

 private:
  void control();
  void publishAll();

  Options options_;
  tracker::Tracker& tracker_;
  CycleStatistics& statistics_;
  std::function<double()> now_s_;
  std::function<void(const ControlOutput&)> publish_;
  boost::lockfree::spsc_queue<ControlOutput, boost::lockfree::capacity<32>> outputs_;
  sem_t available_{};
  std::atomic<bool> running_{true};
  std::thread publisher_;
  std::thread controller_;
};

// One step of the tracker, timed: the command, and the time it took in ms.
double timedStep(tracker::Tracker& tracker, double now_s, tracker::Command& command);

}  // namespace otter_nav::nodes
