#include "otter_nav/trajectory/trajectory.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/trajectory/polynomial/quadrature.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::trajectory {
namespace {

constexpr double kAtRestMps = 1e-4;

// Where the bow points, roughly: the course through the water, or at rest its limit from within.
Eigen::Vector2d aheadVector(const Piece& piece, double t, const vessel::FlatPoint& z,
                            const Eigen::Vector2d& current) {
  const Eigen::Vector2d through_water = z.velocity - current;
  if (through_water.squaredNorm() > kAtRestMps * kAtRestMps) {
    return through_water;
  }
  const double inward = std::min(1e-2, 0.25 * piece.duration_s);
  const double inside = t < 0.5 * piece.duration_s ? t + inward : t - inward;
  return piece.flat(inside).velocity - current;
}

void sampleSpin(const Piece& piece, double t, const vessel::InverseDynamics& inverse, Sample& s) {
  const Eigen::Vector3d psi = piece.spinHeading(t);
  const Eigen::Vector2d e = unitVector(psi[0]);
  const Eigen::Vector2d& v = s.flat.velocity;
  s.state << s.flat.position, wrapAngle(psi[0]), e.dot(v), cross(e, v), psi[1];
  s.tau = inverse.held(e, psi[1], psi[2], v, s.flat.acceleration).tau;
  s.heading_force_n = std::numeric_limits<double>::infinity();
}

void sampleSail(const Piece& piece, double t, const vessel::InverseDynamics& inverse,
                const Eigen::Vector2d& current, Sample& s) {
  const vessel::FlatState flat = inverse.state(s.flat, aheadVector(piece, t, s.flat, current));
  s.state = flat.state;
  s.tau = flat.tau;
  s.heading_force_n = flat.heading_force_n;
}

}  // namespace

Trajectory::Trajectory(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
  starts_.reserve(pieces_.size() + 1);
  double start = 0.0;
  starts_.push_back(start);
  for (const Piece& piece : pieces_) {
    start += piece.duration_s;
    starts_.push_back(start);
  }
}

std::size_t Trajectory::pieceAt(double t_s) const {
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), t_s);
  const auto index = static_cast<std::ptrdiff_t>(after - starts_.begin()) - 1;
  const auto last = static_cast<std::ptrdiff_t>(pieces_.size()) - 1;
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(index, 0, last));
}

vessel::FlatPoint Trajectory::flat(double t_s) const {
  const double t = std::clamp(t_s, 0.0, duration());
  const std::size_t i = pieceAt(t);
  return pieces_[i].flat(t - starts_[i]);
}

Sample Trajectory::sample(double t_s, const vessel::Parameters& vessel,
                          const vessel::Disturbance& disturbance) const {
  const double t = std::clamp(t_s, 0.0, duration());
  const std::size_t i = pieceAt(t);
  return sampleIn(i, t - starts_[i], vessel, disturbance);
}

Sample Trajectory::sampleIn(std::size_t piece, double t_in_piece_s,
                            const vessel::Parameters& vessel,
                            const vessel::Disturbance& disturbance) const {
  const Piece& p = pieces_[piece];
  const vessel::InverseDynamics inverse(vessel, disturbance);
  Sample s;
  s.flat = p.flat(t_in_piece_s);
  if (p.kind == PieceKind::kSpin) {
    sampleSpin(p, t_in_piece_s, inverse, s);
  } else {
    sampleSail(p, t_in_piece_s, inverse, disturbance.current_mps, s);
  }
  s.t_s = starts_[piece] + t_in_piece_s;
  s.thrusts = vessel::thrustsFromTau(s.tau, vessel.thrusters);
  return s;
}

double length(const Trajectory& trajectory) {
  // Four parts of each piece.
  constexpr int kParts = 4;
  double total = 0.0;
  for (const Piece& piece : trajectory.pieces()) {
    const double half = piece.duration_s / (2.0 * kParts);
    for (int part = 0; part < kParts; ++part) {
      for (std::size_t k = 0; k < kGauss.at.size(); ++k) {
        total += kGauss.weight[k] * half *
                 piece.flat(half * (2 * part + 1 + kGauss.at[k])).velocity.norm();
      }
    }
  }
  return total;
}

}  // namespace otter_nav::trajectory
