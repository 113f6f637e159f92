// Manoeuvres that excite what identification has to find (the standard ones of full-scale trials:
// ITTC 7.5-04-02-01). Closed loop on the measured state, clock from outside.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::identification {

enum class ManoeuvreKind {
  kSpeedStep,  // `ahead` for `seconds`, the heading held
  kZigzag,     // `turn` to one side until the heading is `angle_rad` off, then to the other side
  kCircle,     // `turn` until the heading has changed by `angle_rad`
  kSpiral      // `turn` lowered to its negative and raised again in `count` steps each way
};

struct ManoeuvreOptions {
  ManoeuvreKind kind = ManoeuvreKind::kSpeedStep;
  // Shares of the limit ahead: the thrusters' mean, and half their difference, to port positive.
  // A negative mean is a share of the limit astern.
  double ahead = 0.5;
  double turn = 0.0;
  double angle_rad = 0.0;
  int count = 0;         // swings of a zigzag, steps of a spiral
  double seconds = 0.0;  // of a speed step or of each spiral step; else the longest it may take
};

// config/excitation.yaml: the list `manoeuvres`, a mapping each of kind and the kind's own keys,
// angles in degrees (`angle_deg`).
[[nodiscard]] Result<std::vector<ManoeuvreOptions>> readExcitation(config::Section section);

class Manoeuvre;

// Goes through the manoeuvres one after the other.
class Excitation {
 public:
  Excitation(std::vector<ManoeuvreOptions> manoeuvres, const vessel::Thrusters& thrusters);
  ~Excitation();
  Excitation(Excitation&&) noexcept;
  Excitation& operator=(Excitation&&) noexcept;

  // Thrusts for the state at `time_s`; zero when all is done. Where the time goes back, the clock
  // was set, and the manoeuvre begins again. The heading may be wrapped.
  [[nodiscard]] vessel::Thrusts step(double time_s, const vessel::State& state);
  [[nodiscard]] bool finished() const { return current_ >= manoeuvres_.size(); }
  // "3 of 20: zigzag", or "finished".
  [[nodiscard]] std::string progress() const;

 private:
  std::vector<ManoeuvreOptions> manoeuvres_;
  vessel::Thrusters thrusters_;
  std::size_t current_ = 0;
  std::unique_ptr<Manoeuvre> running_;
  double began_s_ = 0.0;
  double last_s_ = 0.0;
  double unwrapped_psi_rad_ = 0.0;
  bool started_ = false;
};

// Both thrusters' shares, the difference kept where one would pass its limit.
[[nodiscard]] vessel::Thrusts thrustsOf(double ahead, double turn,
                                        const vessel::Thrusters& thrusters);

}  // namespace otter_nav::identification
