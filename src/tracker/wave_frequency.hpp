// The frequency of the waves that a hull moves with, from its sway: at crawling pace on a steady
// heading waves alone move it abeam to and fro. In a narrow band the mean square of the speed is
// the displacement's times the frequency squared (Fossen 2021, section 10.2: spectral moments).
#pragma once

namespace otter_nav::tracker {

class WaveFrequency {
 public:
  WaveFrequency();
  // The sway measured now, over ground, `dt_s` after the last; `crawling` from 1 at crawling pace
  // to 0 at speed.
  void add(double sway_mps, double yaw_rate_radps, double crawling, double dt_s);
  // Of the waves' middle; that of a small lake's as long as nothing is known.
  [[nodiscard]] double radps() const { return radps_; }
  // It was found once, or nothing much sways a hull that crawls.
  [[nodiscard]] bool isKnown() const;

 private:
  struct Means {
    double square_mps = 0.0;
    double square_m = 0.0;
  };
  double smooth_mps_ = 0.0;
  double steady_mps_ = 0.0;
  double aside_m_ = 0.0;  // from a position that follows slowly
  double crawled_s_ = 0.0;
  double most_mps_ = 0.0;  // to and fro, since the hull has crawled
  bool found_ = false;
  Means felt_;   // since the hull has crawled, too
  Means known_;  // of crawling that was long enough
  double radps_;
};

}  // namespace otter_nav::tracker
