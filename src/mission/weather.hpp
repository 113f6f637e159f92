// What wind and current do on the way, learned from the tracker's estimate: what blows on the
// whole, the worst of the gusts, and what that does to a tracked hull.
#pragma once

#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::mission {

class Weather {
 public:
  explicit Weather(const vessel::Parameters& vessel) : vessel_(vessel) {}

  // The estimate at `now_s`; times rise.
  void feel(double now_s, const vessel::Disturbance& estimate);
  // The vessel's sway beside the one that its trajectory has, m/s; times rise.
  void feelSway(double now_s, double off_mps);
  // The estimate begins at nothing and has found what blows by then; until it has, it is no ground
  // to change a plan.
  [[nodiscard]] bool isKnown() const;
  // The estimate of more than a light load still rises in the first seconds.
  [[nodiscard]] bool rises() const;

  // Until it was felt for as long as the memory reaches gusts are guessed, and the mean of seconds
  // is that of one of them: whether it may be strong.
  [[nodiscard]] bool mayTurnOutStrong() const;

  // On the whole: means over the last half minute or so.
  [[nodiscard]] const vessel::Disturbance& mean() const { return mean_; }
  // The hardest gust to be expected: the mean with the wind (force, moment) of two standard
  // deviations more, or of the fastest seen lately if that is more. Before much was seen it is
  // taken to gust by a fifth.
  [[nodiscard]] vessel::Disturbance gust() const;

  // The mean wind turns the hull with much of the thrusters' moment: a gust may take its heading.
  [[nodiscard]] bool isStrong() const { return turnsWith(kStrongShare); }
  // Or would be with three tenths more wind.
  [[nodiscard]] bool isNearlyStrong() const { return turnsWith(kNearlyShare * kStrongShare); }
  // The mean wind's moment and what else turns the hull, on the worst heading, N m.
  [[nodiscard]] double greatestMoment() const;
  // Of all thrust ahead that the mean pushes with, on the worst heading.
  [[nodiscard]] double meanShare() const;
  // Of a thruster's limit that the gust takes beside the mean, at the heading where it is most:
  // what plans leave over. In [0, 1].
  [[nodiscard]] double gustShare() const;
  // Of a thruster's limit that holds the heading while waves move the hull abeam: the moment of
  // Munk, which goes with that and with the speed, at the speed that the rest of the thrust gives.
  // In [0, 1).
  [[nodiscard]] double waveShare() const;
  // The sway has been felt for more than a wave.
  [[nodiscard]] bool knowsWaves() const;
  // The speed over ground, m/s, to sail at: `usual_mps` where the gust leaves moment enough to hold
  // the headings of all courses, else the fastest that does, or the one that leaves most
  // (docs/weather.md).
  [[nodiscard]] double sailingSpeed(double usual_mps) const;
  // How far, m, the gust sets a tracked hull aside at most (docs/weather.md).
  [[nodiscard]] double gustReach() const;
  // How far a hull that lost its heading is set aside in gusts until it lies into the wind, and
  // where to: earth frame, m.
  [[nodiscard]] Eigen::Vector2d drift() const;

 private:
  static constexpr double kStrongShare = 0.4;  // of the thrusters' moment
  static constexpr double kNearlyShare = 0.6;  // of that
  [[nodiscard]] bool turnsWith(double share) const;
  // A quantity's mean and variance with a fading memory, and its largest size lately.
  struct Spread {
    double mean = 0.0;
    double variance = 0.0;
    double most = 0.0;
    void add(double value, double share, double fade);
    // The mean scaled by this is the gust's.
    [[nodiscard]] double extreme(double prior) const;
  };

  // The same with another gust taken for granted before much was seen, of the mean.
  [[nodiscard]] vessel::Disturbance gust(double prior) const;
  // Of the thrusters' moment, what `hard` takes at this velocity over ground on the heading that
  // suits it best; more than 1 where the path says nothing of the heading.
  [[nodiscard]] double turningShare(const Eigen::Vector2d& velocity,
                                    const vessel::Disturbance& hard) const;
  // Whether the mean leaves thrust for it.
  [[nodiscard]] bool hasThrustFor(const Eigen::Vector2d& velocity) const;

  vessel::Parameters vessel_;
  vessel::Disturbance mean_;
  Spread wind_mps_, force_n_, moment_nm_;
  Spread sway_off_mps_;
  double sway_felt_s_ = 0.0;
  double last_sway_s_ = 0.0;
  double felt_s_ = 0.0;
  double last_s_ = 0.0;
  bool started_ = false;
};

}  // namespace otter_nav::mission
