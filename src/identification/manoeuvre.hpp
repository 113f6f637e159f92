// One manoeuvre under way.
#pragma once

#include <memory>

#include "otter_nav/identification/manoeuvres.hpp"

namespace otter_nav::identification {

// Shares of thrust: mean and half the difference.
struct Shares {
  double ahead = 0.0;
  double turn = 0.0;
};

class Manoeuvre {
 public:
  // `psi_rad`: where it begins.
  Manoeuvre(const ManoeuvreOptions& options, double psi_rad)
      : options_(options), psi_rad_(psi_rad) {}
  virtual ~Manoeuvre() = default;
  // `elapsed_s` since the manoeuvre began, `psi_rad` unwrapped.
  virtual Shares step(double elapsed_s, double psi_rad, double yaw_rate_radps) = 0;
  [[nodiscard]] bool finished() const { return finished_; }

 protected:
  ManoeuvreOptions options_;
  double psi_rad_;
  bool finished_ = false;
};

[[nodiscard]] std::unique_ptr<Manoeuvre> makeManoeuvre(const ManoeuvreOptions& options,
                                                       double psi_rad);

}  // namespace otter_nav::identification
