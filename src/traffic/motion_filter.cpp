#include "motion_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::traffic {
namespace {

// How a model moves and what comes after it.
struct Law {
  double acceleration;                               // density of a white one, m^2/s^3
  double turn_change;                                // and of the turn rate's change, rad^2/s^3
  double turn_decay_s;                               // a turn rate dies out; 0: there is none
  double holds_s;                                    // on average
  std::array<double, MotionFilter::kModels> follow;  // then, shares
};
constexpr std::array<Law, MotionFilter::kModels> kLaws = {
    {{0.0002, 0.0, 0.0, 120.0, {0.0, 1.0, 0.0, 0.0}},
     {0.2, 0.002, 20.0, 2.0, {0.9, 0.0, 0.1, 0.0}},
     {0.005, 0.0002, 100.0, 60.0, {0.0, 1.0, 0.0, 0.0}},
     {0.2, 0.0, 20.0, 0.8, {0.7, 0.3, 0.0, 0.0}}}};
constexpr std::size_t kStraight = 0;
constexpr std::size_t kBeginsToTurn = 1;
constexpr std::size_t kAnew = 3;
constexpr std::array<double, MotionFilter::kModels> kAtFirst = {0.9, 0.09, 0.01, 0.0};
constexpr double kAnewCounts = 0.3;  // weight from which its velocity is told

constexpr double kAnySpeedMps = 2.5;  // standard deviation of an unknown velocity, each axis
constexpr double kAnyTurnRadps = 0.2;
constexpr double kAnyTurnAmongManyRadps = 0.6;  // of who may be off on a new course at any time
constexpr double kNoTurnRadps = 1e-3;
constexpr double kLeastWeight = 1e-4;
// Heading less course: of anybody at first, and how it strays, rad^2/s.
constexpr double kLeewayRad = 0.1;
constexpr double kLeewayStrays = 0.00002;
constexpr double kQuarterRad = 0.5 * kPi;

MotionCovariance noise(double acceleration, double turn_change, double dt) {
  MotionCovariance q = MotionCovariance::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    q(axis, axis) = acceleration * dt * dt * dt / 3.0;
    q(axis, axis + 2) = q(axis + 2, axis) = acceleration * dt * dt / 2.0;
    q(axis + 2, axis + 2) = acceleration * dt;
  }
  q(4, 4) = turn_change * dt;
  q(5, 5) = kLeewayStrays * dt;
  return q;
}

// Coordinated turn: the velocity turns with omega, the position is its integral; with its Jacobian.
MotionState turned(const MotionState& x, double dt, double decay_s, MotionCovariance& f) {
  const double w = x[4];
  const double angle = w * dt;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const bool straight = std::abs(angle) < 1e-4;
  // sin(a) / w, (1 - cos(a)) / w and their slopes in w.
  const double a = straight ? dt : s / w;
  const double b = straight ? 0.5 * angle * dt : (1.0 - c) / w;
  const double da = straight ? -dt * dt * angle / 3.0 : (dt * c - a) / w;
  const double db = straight ? 0.5 * dt * dt : (dt * s - b) / w;
  const double vx = x[2];
  const double vy = x[3];
  const double kept = std::exp(-dt / decay_s);
  MotionState y;
  y << x[0] + a * vx - b * vy, x[1] + b * vx + a * vy, c * vx - s * vy, s * vx + c * vy, kept * w,
      x[5];
  f.setIdentity();
  f.block<2, 2>(0, 2) << a, -b, b, a;
  f.block<2, 2>(2, 2) << c, -s, s, c;
  f.col(4) << da * vx - db * vy, db * vx + da * vy, -dt * (s * vx + c * vy), dt * (c * vx - s * vy),
      kept, 0.0;
  return y;
}

template <int N>
double distance2Of(const Measurement& m, const MotionState& x, const MotionCovariance& p,
                   double& determinant) {
  const Eigen::Matrix<double, N, N> s =
      p.topLeftCorner<N, N>() + m.covariance.topLeftCorner<N, N>();
  const Eigen::Matrix<double, N, 1> off = m.value.head<N>() - x.head<N>();
  determinant = s.determinant();
  return off.dot(s.inverse() * off);
}
double distance2Of(const Measurement& m, const MotionState& x, const MotionCovariance& p,
                   double& determinant) {
  return m.has_velocity ? distance2Of<4>(m, x, p, determinant)
                        : distance2Of<2>(m, x, p, determinant);
}

double density(const Measurement& m, const MotionState& x, const MotionCovariance& p) {
  double determinant = 1.0;
  const double distance2 = distance2Of(m, x, p, determinant);
  const double turns = m.has_velocity ? 4.0 * kPi * kPi : 2.0 * kPi;
  return std::exp(-0.5 * distance2) / (turns * std::sqrt(determinant));
}

// One Kalman update of state and covariance.
template <int N>
void correct(const Measurement& m, MotionState& x, MotionCovariance& p) {
  const Eigen::Matrix<double, N, N> s =
      p.topLeftCorner<N, N>() + m.covariance.topLeftCorner<N, N>();
  const Eigen::Matrix<double, 6, N> gain = p.leftCols<N>() * s.inverse();
  x += gain * (m.value.head<N>() - x.head<N>());
  const Eigen::Matrix<double, N, 6> rows = p.topRows<N>();
  p -= gain * rows;
}

}  // namespace

MotionFilter::MotionFilter(const Measurement& first, double stamp_s) : stamp_s_(stamp_s) {
  for (Model& model : models_) {
    model.x.head<4>() = first.value;
    model.P.topLeftCorner<4, 4>() = first.covariance;
    if (!first.has_velocity) {
      model.P.block<2, 2>(2, 2).diagonal().setConstant(kAnySpeedMps * kAnySpeedMps);
    }
  }
  for (std::size_t m = 0; m < kModels; ++m) {
    const double turn = m == kStraight ? kNoTurnRadps : kAnyTurnRadps;
    models_[m].weight = kAtFirst[m];
    models_[m].P(4, 4) = turn * turn;
    models_[m].P(5, 5) = kLeewayRad * kLeewayRad;
  }
}

// The models' estimates as each model's start, by how probable it is to have come from there.
void MotionFilter::mix(double dt_s, double anew_per_s) {
  const std::array<Model, kModels> before = models_;
  const double anew = 1.0 - std::exp(-dt_s * anew_per_s);
  for (std::size_t to = 0; to < kModels; ++to) {
    Model& model = models_[to];
    PerModel share{};
    model.weight = 0.0;
    for (std::size_t from = 0; from < kModels; ++from) {
      const double leaves = 1.0 - std::exp(-dt_s / kLaws[from].holds_s);
      share[from] =
          before[from].weight * (from == to ? 1.0 - leaves : leaves * kLaws[from].follow[to]);
      if (from != kAnew) {
        share[from] = to == kAnew ? anew * before[from].weight : (1.0 - anew) * share[from];
      }
      model.weight += share[from];
    }
    if (model.weight <= 0.0) {
      continue;
    }
    if (to == kAnew) {
      mixAnew(before, share);
      continue;
    }
    model.x.setZero();
    for (std::size_t from = 0; from < kModels; ++from) {
      share[from] /= model.weight;
      model.x += share[from] * before[from].x;
    }
    model.P.setZero();
    for (std::size_t from = 0; from < kModels; ++from) {
      const MotionState off = before[from].x - model.x;
      model.P += share[from] * (before[from].P + off * off.transpose());
    }
    if (to == kBeginsToTurn) {  // at any rate
      const double any = anew_per_s > 0.0 ? kAnyTurnAmongManyRadps : kAnyTurnRadps;
      model.P(4, 4) += (share[kStraight] + share[kAnew]) * any * any;
    }
  }
}

// Whoever takes a new course keeps her speed; where she is off to nobody knows.
void MotionFilter::mixAnew(const std::array<Model, kModels>& before, const PerModel& share) {
  std::array<Model, kModels> from = before;
  Model& model = models_[kAnew];
  for (std::size_t m = 0; m < kModels; ++m) {
    if (m == kAnew) {
      continue;
    }
    const double speed2 = from[m].x.segment<2>(2).squaredNorm();
    from[m].x.tail<4>().setZero();
    from[m].P.rightCols<4>().setZero();
    from[m].P.bottomRows<4>().setZero();
    from[m].P.block<2, 2>(2, 2).diagonal().setConstant(0.5 * speed2);
    from[m].P(4, 4) = kNoTurnRadps * kNoTurnRadps;
    from[m].P(5, 5) = kLeewayRad * kLeewayRad;
  }
  model.x.setZero();
  for (std::size_t m = 0; m < kModels; ++m) {
    model.x += share[m] / model.weight * from[m].x;
  }
  model.P.setZero();
  for (std::size_t m = 0; m < kModels; ++m) {
    const MotionState off = from[m].x - model.x;
    model.P += share[m] / model.weight * (from[m].P + off * off.transpose());
  }
}

bool MotionFilter::isUsed(std::size_t model) const {
  return model != kAnew || models_[model].weight > 0.0;
}

void MotionFilter::predict(double time_s, double anew_per_s) {
  const double dt = time_s - stamp_s_;
  if (!(dt > 0.0)) {
    return;
  }
  stamp_s_ = time_s;
  if (anew_per_s <= 0.0 && models_[kAnew].weight < kLeastWeight) {
    models_[kAnew].weight = 0.0;
  }
  mix(dt, anew_per_s);
  for (std::size_t m = 0; m < kModels; ++m) {
    Model& model = models_[m];
    if (!isUsed(m)) {
      continue;
    }
    MotionCovariance f = MotionCovariance::Identity();
    if (m == kStraight) {
      f(0, 2) = f(1, 3) = dt;
      f(4, 4) = 0.0;
      model.x = f * model.x;
    } else {
      model.x = turned(model.x, dt, kLaws[m].turn_decay_s, f);
    }
    model.P = f * model.P * f.transpose() + noise(kLaws[m].acceleration, kLaws[m].turn_change, dt);
    if (m == kStraight) {
      model.P(4, 4) = kNoTurnRadps * kNoTurnRadps;
    }
  }
}

MotionFilter::PerModel MotionFilter::likelihoods(const Measurement& measurement) const {
  PerModel by_model{};
  for (std::size_t m = 0; m < kModels; ++m) {
    by_model[m] = isUsed(m) ? density(measurement, models_[m].x, models_[m].P) : 0.0;
  }
  return by_model;
}

double MotionFilter::likelihood(const PerModel& by_model) const {
  double all = 0.0;
  for (std::size_t m = 0; m < kModels; ++m) {
    all += models_[m].weight * by_model[m];
  }
  return all;
}

double MotionFilter::distance2(const Measurement& measurement) const {
  double determinant = 1.0;
  return distance2Of(measurement, state(), covariance(), determinant);
}

double MotionFilter::gateDistance2(const Measurement& measurement) const {
  const double together = distance2(measurement);
  const Model& anew = models_[kAnew];
  if (anew.weight < kLeastWeight) {
    return together;
  }
  double determinant = 1.0;
  return std::min(together, distance2Of(measurement, anew.x, anew.P, determinant));
}

void MotionFilter::update(const std::vector<Candidate>& candidates) {
  // A candidate that no model makes possible at all tells nothing of where she is.
  double none = 1.0;
  std::vector<double> likely;  // by all models
  likely.reserve(candidates.size());
  for (const Candidate& candidate : candidates) {
    likely.push_back(likelihood(candidate.likelihoods));
    none -= likely.back() > 0.0 ? candidate.probability : 0.0;
  }
  none = std::max(0.0, none);
  for (std::size_t m = 0; m < kModels; ++m) {
    if (!isUsed(m)) {
      continue;
    }
    Model& model = models_[m];
    // How much more probable this model makes what was seen than all models together do.
    double evidence = none;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      evidence += likely[k] > 0.0
                      ? candidates[k].probability * candidates[k].likelihoods[m] / likely[k]
                      : 0.0;
    }
    model.weight *= std::max(evidence, 1e-12);
    if (evidence <= 0.0) {
      continue;  // stays where it is, and hardly counts
    }
    const Model before = model;
    MotionState x = none / evidence * before.x;
    MotionCovariance p = none / evidence * (before.P + before.x * before.x.transpose());
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (likely[k] <= 0.0) {
        continue;
      }
      const Candidate& candidate = candidates[k];
      const double share = candidate.probability * candidate.likelihoods[m] / likely[k] / evidence;
      MotionState one = before.x;
      MotionCovariance its = before.P;
      if (candidate.measurement.has_velocity) {
        correct<4>(candidate.measurement, one, its);
      } else {
        correct<2>(candidate.measurement, one, its);
      }
      x += share * one;
      p += share * (its + one * one.transpose());
    }
    p -= x * x.transpose();
    model.x = x;
    model.P = 0.5 * (p + p.transpose());
  }
  normalize();
}

void MotionFilter::update(const Measurement& measurement) {
  update({{measurement, likelihoods(measurement), 1.0}});
}

void MotionFilter::update(const Sides& sides) {
  constexpr double kAstray = 0.03;  // what is taken for her sides may be something else
  constexpr double kAnyCourseRad = 0.2 * kQuarterRad;
  constexpr double kNoLessShare = 0.5;
  constexpr double kSigmas = 3.0;
  constexpr double kLeastSpeedMps = 0.3;
  std::array<bool, kModels> told{};
  double told_weight = 0.0;
  double likelihood = 0.0;
  for (std::size_t m = 0; m < kModels; ++m) {
    Model& model = models_[m];
    const Eigen::Vector2d velocity = model.x.segment<2>(2);
    const double speed2 = std::max(velocity.squaredNorm(), kLeastSpeedMps * kLeastSpeedMps);
    Eigen::Matrix<double, 1, 6> slope = Eigen::Matrix<double, 1, 6>::Zero();
    slope[2] = -velocity.y() / speed2;
    slope[3] = velocity.x() / speed2;
    slope[5] = 1.0;
    const double off = std::remainder(
        sides.direction_rad - std::atan2(velocity.y(), velocity.x()) - model.x[5], kQuarterRad);
    const double variance =
        slope * model.P * slope.transpose() + sides.deviation_rad * sides.deviation_rad;
    const double deviation = std::sqrt(variance);
    told[m] = isUsed(m) && deviation < kAnyCourseRad;
    if (!told[m]) {
      continue;
    }
    told_weight += model.weight;
    model.weight *= kAstray / kQuarterRad + (1.0 - kAstray) *
                                                std::exp(-0.5 * off * off / variance) /
                                                (std::sqrt(2.0 * kPi) * deviation);
    likelihood += model.weight;
    if (std::abs(off) < kSigmas * deviation) {
      const MotionState gain = model.P * slope.transpose() / variance;
      model.x += off * gain;
      const Eigen::Matrix<double, 1, 6> row = slope * model.P;
      model.P -= gain * row;
      model.P = 0.5 * (model.P + model.P.transpose()).eval();
    }
  }
  // Of a model whose course may be any: as likely as any direction is, and hardly less than by the
  // others: sides that stay as they are, scan after scan, say little against a new course on which
  // they would do so too.
  const double others = told_weight > 0.0 ? likelihood / told_weight : 0.0;
  const double any = std::max(1.0 / kQuarterRad, kNoLessShare * others);
  for (std::size_t m = 0; m < kModels; ++m) {
    models_[m].weight *= told[m] ? 1.0 : any;
  }
  normalize();
}

void MotionFilter::normalize() {
  double sum = 0.0;
  for (std::size_t m = 0; m < kModels; ++m) {
    sum += isUsed(m) ? models_[m].weight : 0.0;
  }
  double clamped = 0.0;
  for (std::size_t m = 0; m < kModels; ++m) {
    if (isUsed(m)) {
      models_[m].weight = std::clamp(models_[m].weight / sum, kLeastWeight, 1.0 - kLeastWeight);
      clamped += models_[m].weight;
    }
  }
  for (Model& model : models_) {
    model.weight /= clamped;
  }
}

void MotionFilter::shift(const Eigen::Vector2d& by) {
  for (Model& model : models_) {
    model.x.head<2>() += by;
  }
}

std::size_t MotionFilter::usualModels() const {
  const double anew = models_[kAnew].weight;
  return anew > kAnewCounts ? kModels : kAnew;
}

MotionState MotionFilter::meanOf(std::size_t models) const {
  MotionState mean = MotionState::Zero();
  for (std::size_t m = 0; m < models; ++m) {
    mean += models_[m].weight * models_[m].x;
  }
  return mean;
}

MotionCovariance MotionFilter::covarianceAround(std::size_t models, const MotionState& mean) const {
  MotionCovariance all = MotionCovariance::Zero();
  for (std::size_t m = 0; m < models; ++m) {
    const MotionState off = models_[m].x - mean;
    all += models_[m].weight * (models_[m].P + off * off.transpose());
  }
  return all;
}

MotionState MotionFilter::state() const {
  return meanOf(kModels);
}
MotionCovariance MotionFilter::covariance() const {
  return covarianceAround(kModels, state());
}

MotionState MotionFilter::usualState() const {
  const double left_out = usualModels() < kModels ? models_[kAnew].weight : 0.0;
  return meanOf(usualModels()) / (1.0 - left_out);
}
MotionCovariance MotionFilter::usualCovariance() const {
  const double left_out = usualModels() < kModels ? models_[kAnew].weight : 0.0;
  return covarianceAround(usualModels(), usualState()) / (1.0 - left_out);
}

MotionCovariance MotionFilter::likelyCovariance() const {
  constexpr double kCertain = 0.985;
  const double left_out = usualModels() < kModels ? models_[kAnew].weight : 0.0;
  for (const Model& model : models_) {
    if (model.weight > kCertain * (1.0 - left_out)) {
      return model.P;
    }
  }
  return usualCovariance();
}

}  // namespace otter_nav::traffic
