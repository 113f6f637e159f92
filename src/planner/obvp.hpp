// The optimal boundary value problem between two states of the trees (paper, section IV-B): the
// quintic of least J = sigma T + integral of |u|^2, u the jerk, with the duration free. The paper's
// text has half of |u|^2 and sets J itself to zero; its closed form has |u|^2, and a minimum needs
// the derivative: both are taken so here.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "otter_nav/trajectory/piece.hpp"

namespace otter_nav::planner {

// A state of the trees: position and its first two derivatives, earth frame, SI.
struct KinoState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
};

// J as a function of the duration: sigma T + c1/T + c2/T^2 + ... + c5/T^5.
class SteerCost {
 public:
  SteerCost(const KinoState& from, const KinoState& to, double sigma);
  [[nodiscard]] double at(double duration_s) const;
  // The duration of least J: a positive root of the degree-6 polynomial T^6 J'(T), or nothing
  // when the states coincide.
  [[nodiscard]] std::optional<double> bestDuration() const;

 private:
  double sigma_;
  double c1_, c2_, c3_, c4_, c5_;
};

struct Steer {
  double duration_s = 0.0;
  double cost = 0.0;
};

// The least-cost transfer, or nothing when the states coincide.
[[nodiscard]] std::optional<Steer> steer(const KinoState& from, const KinoState& to, double sigma);

// The quintic of least integral of |jerk|^2 between the states in `duration_s` (alpha, beta, gamma
// of the paper as polynomial coefficients).
[[nodiscard]] trajectory::Piece quinticPiece(const KinoState& from, const KinoState& to,
                                             double duration_s);

// sigma T + integral of |jerk|^2 of a piece of any degree up to 7.
[[nodiscard]] double pieceCost(const trajectory::Piece& piece, double sigma);

}  // namespace otter_nav::planner
