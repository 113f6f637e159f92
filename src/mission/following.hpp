// How the vessel follows what it sails: off it, late on it, or with its heading lost to a gust; and
// what of that asks for another plan, or for a stop (docs/weather.md, Beyond thrust).
#pragma once

#include <limits>
#include <optional>

#include "moment.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "safety.hpp"
#include "sailed.hpp"

namespace otter_nav::mission {

// What it is made of outlives it.
class Following {
 public:
  Following(const SupervisorOptions& options, const Safety& safety,
            const vessel::Parameters& vessel)
      : options_(options), safety_(safety), vessel_(vessel) {}

  // It can't be followed any more: what comes next has to begin where the vessel is.
  [[nodiscard]] bool isFarOff(const Moment& m, const Sailed& sailed) const;
  // So far that another plan is asked for. One that knows wind and current, made from where they
  // have set the vessel, is one that it can follow again: it need not be far off for that.
  [[nodiscard]] bool isLeftBehind(const Moment& m, const Sailed& sailed) const;

  // The same way later, for a vessel that is so far behind on it.
  struct Later {
    trajectory::TimedTrajectory path;
    double behind_m = 0.0;
  };
  // Along its way, by more than waves swing it, and still more from moment to moment: with all its
  // thrust it can't keep up. The same way later is as clear, and can be followed. In strong wind
  // plans are slow, and what runs away from the hull draws it off the headings that a gust leaves
  // it. In a firm load it is not time alone that lacks there.
  [[nodiscard]] std::optional<Later> fallsBehind(const Moment& m, const Sailed& sailed) const;
  // That is sailed: what is put off again and again counts as being left behind.
  void putOff(double now_s, const Later& later);
  // Another plan is asked for: nothing of it is put off yet.
  void startAnew() { late_m_ = 0.0; }

  // Broadside to where it should point and carried off.
  [[nodiscard]] bool hasLostItsHeading(const Moment& m, const Sailed& sailed) const;
  // Off its trajectory, where nothing was verified, for longer than a plan takes, or towards
  // something near. To be asked at each decision.
  [[nodiscard]] bool isSetAside(const Moment& m, const Sailed& sailed);

 private:
  // Off what is sailed, m. The tracker may speak of what it was given before still.
  [[nodiscard]] double error(const Moment& m, const Sailed& sailed) const;
  // Without a plan from where it is, m. In strong wind another plan would meet the same gusts, and
  // the hull comes back by itself: the farther off it may be, the more is clear of what a lost
  // heading takes, here and on its way.
  [[nodiscard]] double mayBeOff(const Moment& m, const Sailed& sailed) const;
  // In strong wind, with something near: going off its way, or soon.
  [[nodiscard]] bool goesAshore(const Moment& m, const Sailed& sailed) const;
  // As it goes it is about to be nearer to something than anything may be.
  [[nodiscard]] bool goesOntoSomething(const Moment& m) const;
  // By how much what is sailed was put off, of late, m: as if the vessel had made good 0.1 m/s of
  // it.
  [[nodiscard]] double lateBy(double now_s) const;

  const SupervisorOptions& options_;
  const Safety& safety_;
  const vessel::Parameters& vessel_;
  double off_since_s_ = 0.0;  // far off
  double late_m_ = 0.0;       // what was put off in all, less what counts as made good since
  double late_at_s_ = 0.0;
};

}  // namespace otter_nav::mission
