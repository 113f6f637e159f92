// How often a mission may still try: rounds of attempts from rest (each tries all clearances), and
// stops on the way.
#pragma once

#include <limits>

namespace otter_nav::mission {

class RetryBudget {
 public:
  RetryBudget(int rounds_max, int stops_max) : rounds_max_(rounds_max), stops_max_(stops_max) {}

  void newGoal(double now_s) {
    stops_ = 0;
    nearest_m_ = std::numeric_limits<double>::infinity();
    newRounds(now_s);
  }
  // False if it was the last round; else the next comes after a pause, for the map may change.
  bool roundLost(double now_s) {
    pause(now_s);
    return ++rounds_ < rounds_max_;
  }
  // False if there were too many stops; else all rounds are to be had again. Those with way made
  // towards the goal since the ones before, of which `left_m` is left, begin the count anew.
  bool stopped(double now_s, double left_m) {
    constexpr double kMadeGoodM = 10.0;
    if (left_m < nearest_m_ - kMadeGoodM) {
      stops_ = 0;
      nearest_m_ = left_m;
    }
    if (++stops_ > stops_max_) {
      return false;
    }
    newRounds(now_s);
    return true;
  }
  // A part of the way was sailed as planned: all rounds are to be had again from there.
  void madeGood(double now_s) { newRounds(now_s); }
  void pause(double now_s) {
    constexpr double kPauseS = 0.5;
    not_before_s_ = now_s + kPauseS;
  }
  [[nodiscard]] bool pauses(double now_s) const { return now_s < not_before_s_; }
  [[nodiscard]] int rounds() const { return rounds_; }
  [[nodiscard]] int stops() const { return stops_; }

 private:
  void newRounds(double now_s) {
    rounds_ = 0;
    not_before_s_ = now_s;
  }

  int rounds_max_;
  int stops_max_;
  int rounds_ = 0;
  int stops_ = 0;
  double nearest_m_ = std::numeric_limits<double>::infinity();
  double not_before_s_ = 0.0;
};

}  // namespace otter_nav::mission
