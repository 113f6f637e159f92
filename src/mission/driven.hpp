// What wind and current drive the vessel onto, and the ways out of that: more room ahead or astern
// along the wind's line, or an escape by thrusts of its own (docs/weather.md, Beyond thrust).
#pragma once

#include <limits>

#include "moment.hpp"
#include "otter_nav/stopping/escape.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "safety.hpp"
#include "sailed.hpp"

namespace otter_nav::mission {

// What it is made of outlives it.
class Driven {
 public:
  Driven(const Safety& safety, const vessel::Parameters& vessel)
      : safety_(safety), vessel_(vessel) {}

  // Bow or stern to it, with something near, or to leeward nearer than a lost heading takes, and a
  // better place ahead or astern. It had to stop so often hereabouts, and looks for a place to set
  // out from, or for a wider one to wait in.
  [[nodiscard]] bool liesOffALeeShore(const Moment& m, int stops, bool to_wait);
  // So far ahead, m (negative: astern), as it was found last; and the way there.
  [[nodiscard]] double roomToMake() const { return room_m_; }
  [[nodiscard]] trajectory::Trajectory legToMakeIt(const Moment& m) const;

  enum class Lies { kOnItsWay, kOffPlans, kEscaping };
  // Something, by wind and current, in the seconds that the tracker foresees, while its thrust is
  // spent on turning the hull; and there are thrusts by which it passes. On a plan there may be
  // little room, and a load that turns no hull lets it keep its place with little; what is foreseen
  // soon after an escape from there is the same again. Where it lies bow to strong wind, and slowly
  // drifts onto something beyond those seconds, a way out is sought now: later there may be none.
  [[nodiscard]] bool isDrivenOntoSomething(const Moment& m, const Sailed& sailed, Lies lies);
  // That way out, to be sailed from now on.
  [[nodiscard]] trajectory::Trajectory takeEscape(double now_s);

 private:
  const Safety& safety_;
  const vessel::Parameters& vessel_;
  double room_m_ = 0.0;
  stopping::Escape escape_;
  double escaped_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace otter_nav::mission
