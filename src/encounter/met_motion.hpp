// How somebody goes by the places where the sensors met her. Her track is drawn on by what was
// taken for her motion before, and cuts the corners; what is remembered of her way is to have them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "otter_nav/traffic/track.hpp"

namespace otter_nav::encounter {

// Place and velocity, map frame: x m, y m, v_x m/s, v_y m/s.
struct GoesOn {
  double stamp_s = 0.0;
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
};

// In `dt`, s, with a velocity that strays at random.
struct Straying {
  explicit Straying(double dt);
  Eigen::Matrix4d moves = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d adds = Eigen::Matrix4d::Zero();  // to the covariance
};

// Standard deviation of a velocity that is worth remembering, m/s.
inline constexpr double kKnownMps = 0.8;

class MetMotion {
 public:
  // What is new of her and worth remembering; of a track that doesn't tell where she was met, the
  // track itself.
  [[nodiscard]] std::optional<GoesOn> follow(const traffic::Track& track);
  // Whether she was lost since this was asked last: no stretch leads from before to now.
  [[nodiscard]] bool wasLost();

 private:
  // By the place alone; whether it fits what was known.
  [[nodiscard]] bool update(const traffic::Track::Met& met);
  // Whether she can have come there from where she was met last, turning as she liked.
  [[nodiscard]] bool canBeAt(const traffic::Track::Met& met, double speed_mps) const;

  GoesOn now_;
  traffic::Track::Met last_;
  bool lost_ = false;
};

}  // namespace otter_nav::encounter
