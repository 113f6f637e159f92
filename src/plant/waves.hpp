// Long-crested linear waves in deep water (Fossen 2021, section 10.2) and how a two-pontoon hull
// feels them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "otter_nav/base/random.hpp"
#include "otter_nav/plant/options.hpp"

namespace otter_nav::plant {

// The water under a hull, averaged over the four points (+-x, +-y) of its grid: plane fits, so
// waves shorter than the hull cancel as they should. Heading frame: ahead, port, up.
struct HullWaves {
  double elevation_m = 0.0;
  double elevation_rate_mps = 0.0;  // rates are those of the water, at a fixed place
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // d elevation / d ahead, d port
  Eigen::Vector2d slope_rate_radps = Eigen::Vector2d::Zero();
  Eigen::Vector2d orbital_velocity_mps = Eigen::Vector2d::Zero();  // ahead, port
  Eigen::Vector2d orbital_acceleration_mps2 = Eigen::Vector2d::Zero();
  double rotation_radps = 0.0;  // of the orbital velocities about the vertical
  double rotation_rate_radps2 = 0.0;
};

class WaveField {
 public:
  WaveField(const WaveOptions& options, std::uint64_t seed);

  [[nodiscard]] bool empty() const { return trains_.empty(); }
  // The surface's height over mean water level at a point of the map.
  [[nodiscard]] double elevation(const Eigen::Vector2d& position, double time_s) const;
  // `half_size` is the grid's (x, y), m; orbital motion is taken at half the draft.
  [[nodiscard]] HullWaves underHull(const Eigen::Vector2d& position, double psi_rad, double time_s,
                                    const Eigen::Vector2d& half_size, double draft_m) const;

 private:
  struct Train {
    double amplitude_m;
    double frequency_radps;
    double wave_number_radpm;
    Eigen::Vector2d direction;
    double phase_rad;
  };
  void addSpectrum(const SpectrumOptions& spectrum, Random& random);
  void add(double amplitude_m, double frequency_radps, double direction_rad, double phase_rad);
  [[nodiscard]] static double phaseOf(const Train& train, const Eigen::Vector2d& position,
                                      double time_s);

  std::vector<Train> trains_;
};

// JONSWAP's shape at a frequency, not normalised (Hasselmann and others 1973).
[[nodiscard]] double jonswapShape(double frequency_radps, double peak_radps, double peakedness);

}  // namespace otter_nav::plant
