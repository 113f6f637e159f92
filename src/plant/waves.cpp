#include "waves.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/plant/plant_model.hpp"

namespace otter_nav::plant {
namespace {

// A direction off the mean with density cos^2s(angle / 2), by rejection.
double spreadAngle(double exponent, Random& random) {
  constexpr int kMaxDraws = 10000;
  for (int i = 0; i < kMaxDraws; ++i) {
    const double angle = random.uniform(-kPi, kPi);
    if (random.uniform() < std::pow(std::cos(0.5 * angle), 2.0 * exponent)) {
      return angle;
    }
  }
  return 0.0;
}

// Frequencies that cut the spectrum's energy into equal shares, one at a random place in each.
std::vector<double> equalEnergyFrequencies(double peak, double peakedness, int count,
                                           Random& random) {
  constexpr int kCells = 4000;
  const double low = 0.5 * peak;
  const double width = 3.5 * peak / kCells;
  std::vector<double> energy(kCells + 1, 0.0);
  for (int i = 0; i < kCells; ++i) {
    energy[i + 1] = energy[i] + width * jonswapShape(low + (i + 0.5) * width, peak, peakedness);
  }
  std::vector<double> frequencies;
  for (int i = 0; i < count; ++i) {
    const double wanted = energy.back() * (i + random.uniform()) / count;
    const auto above = std::lower_bound(energy.begin() + 1, energy.end() - 1, wanted);
    const double inside = (wanted - *(above - 1)) / (*above - *(above - 1));
    frequencies.push_back(low + width * (static_cast<double>(above - energy.begin()) - 1 + inside));
  }
  return frequencies;
}

}  // namespace

double jonswapShape(double frequency_radps, double peak_radps, double peakedness) {
  const double ratio = peak_radps / frequency_radps;
  const double width = frequency_radps <= peak_radps ? 0.07 : 0.09;
  const double offset = (frequency_radps - peak_radps) / (width * peak_radps);
  return std::pow(ratio, 5) * std::exp(-1.25 * std::pow(ratio, 4)) *
         std::pow(peakedness, std::exp(-0.5 * offset * offset));
}

WaveField::WaveField(const WaveOptions& options, std::uint64_t seed) {
  Random random(seed);
  for (const WaveComponent& wave : options.components) {
    add(wave.amplitude_m, 2.0 * kPi / wave.period_s, wave.direction_rad, 0.0);
  }
  if (options.spectrum.significant_height_m > 0.0) {
    addSpectrum(options.spectrum, random);
  }
}

// Hs = 4 sqrt(m0), and m0 is the sum of a^2 / 2 of equal amplitudes.
void WaveField::addSpectrum(const SpectrumOptions& spectrum, Random& random) {
  const double variance = std::pow(0.25 * spectrum.significant_height_m, 2);
  const double amplitude = std::sqrt(2.0 * variance / spectrum.components);
  const double peak = 2.0 * kPi / spectrum.peak_period_s;
  for (const double frequency :
       equalEnergyFrequencies(peak, spectrum.peakedness, spectrum.components, random)) {
    const double direction =
        spectrum.direction_rad + spreadAngle(spectrum.spreading_exponent, random);
    add(amplitude, frequency, direction, random.uniform(-kPi, kPi));
  }
}

void WaveField::add(double amplitude_m, double frequency_radps, double direction_rad,
                    double phase_rad) {
  trains_.push_back({amplitude_m, frequency_radps, frequency_radps * frequency_radps / kGravity,
                     unitVector(direction_rad), phase_rad});
}

double WaveField::phaseOf(const Train& train, const Eigen::Vector2d& position, double time_s) {
  return train.wave_number_radpm * train.direction.dot(position) - train.frequency_radps * time_s +
         train.phase_rad;
}

double WaveField::elevation(const Eigen::Vector2d& position, double time_s) const {
  double sum = 0.0;
  for (const Train& train : trains_) {
    sum += train.amplitude_m * std::cos(phaseOf(train, position, time_s));
  }
  return sum;
}

// Over the grid, the mean of cos(phase + a x + b y) is cos(phase) cos(a X) cos(b Y), and the fitted
// slopes are -sin(phase) sin(a X) cos(b Y) / X and likewise: no point needs its own cosine.
HullWaves WaveField::underHull(const Eigen::Vector2d& position, double psi_rad, double time_s,
                               const Eigen::Vector2d& half_size, double draft_m) const {
  const Eigen::Vector2d ahead = unitVector(psi_rad);
  const double spread = half_size.squaredNorm();
  HullWaves w;
  for (const Train& train : trains_) {
    const double phase = phaseOf(train, position, time_s);
    const Eigen::Vector2d heading(train.direction.dot(ahead), ahead.x() * train.direction.y() -
                                                                  ahead.y() * train.direction.x());
    const Eigen::Vector2d angle = train.wave_number_radpm * heading.cwiseProduct(half_size);
    const double c = train.amplitude_m * std::cos(phase);
    const double s = train.amplitude_m * std::sin(phase);
    const double mean = std::cos(angle.x()) * std::cos(angle.y());
    const double along = std::sin(angle.x()) * std::cos(angle.y());
    const double across = std::cos(angle.x()) * std::sin(angle.y());
    const Eigen::Vector2d slope(along / half_size.x(), across / half_size.y());
    const double omega = train.frequency_radps;

    w.elevation_m += c * mean;
    w.elevation_rate_mps += omega * s * mean;
    w.slope -= s * slope;
    w.slope_rate_radps += omega * c * slope;
    const double orbital = omega * std::exp(-0.5 * train.wave_number_radpm * draft_m);
    w.orbital_velocity_mps += orbital * c * mean * heading;
    w.orbital_acceleration_mps2 += orbital * omega * s * mean * heading;
    const double turn =
        (half_size.x() * along * heading.y() - half_size.y() * across * heading.x()) / spread;
    w.rotation_radps -= orbital * s * turn;
    w.rotation_rate_radps2 += orbital * omega * c * turn;
  }
  return w;
}

}  // namespace otter_nav::plant
