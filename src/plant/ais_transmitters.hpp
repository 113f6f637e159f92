// The class B transmitters of other vessels. Source: ITU-R M.1371-5, annex 1, table 2: a position
// (type 18) every 30 s, at 2 knots or less every 3 minutes, from 14 knots every 15 s, from 23 knots
// every 5 s; the static report (type 24, parts A and B) every 6 minutes, and once after the first
// position.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "otter_nav/ais/local_frame.hpp"
#include "otter_nav/ais/message.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/plant/signals.hpp"
#include "otter_nav/vessel/scripted_vessel.hpp"

namespace otter_nav::plant {

class AisTransmitters {
 public:
  AisTransmitters(const ais::Datum& datum, std::uint64_t seed) : frame_(datum), random_(seed) {}

  // Forgets what was; each transmitter starts at a random place of its interval.
  void set(const std::vector<vessel::ScriptedVessel>& scripts, double time_s);
  // The sentences that are due by `time_s` are appended.
  void advance(const std::vector<OtherVessel>& others, double time_s,
               std::vector<std::string>& sentences);

 private:
  struct Transmitter {
    bool on = false;
    double next_position_s = 0.0;
    double next_static_s = 0.0;
  };
  void send(const ais::Message& message, std::vector<std::string>& sentences);
  [[nodiscard]] ais::Message positionOf(const OtherVessel& other, double time_s);

  ais::LocalFrame frame_;
  Random random_;
  std::vector<Transmitter> transmitters_;  // in the vessels' order
  int sequence_ = 0;
};

}  // namespace otter_nav::plant
