// Whether the vessel is at its goal, on its heading or on the one that wind and current let it have
// there (docs/weather.md, Rest).
#pragma once

#include <string>

#include "moment.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"
#include "safety.hpp"
#include "sailed.hpp"

namespace otter_nav::mission {

// Of one moment; what it is made of outlives it.
class Arrival {
 public:
  Arrival(const Moment& moment, const SupervisorOptions& options, const Safety& safety,
          const vessel::Parameters& vessel, const Sailed& sailed, const vessel::Pose& goal)
      : moment_(moment),
        options_(options),
        safety_(safety),
        vessel_(vessel),
        sailed_(sailed),
        goal_(goal) {}

  // By whatever way.
  [[nodiscard]] bool isThere() const;
  // At the end of what is sailed: there, or as near to the goal's heading as it comes.
  [[nodiscard]] bool hasArrived() const;
  // A trajectory that ends elsewhere belongs to a goal that was replaced: nothing to wait for.
  [[nodiscard]] bool settlesNoMore() const;

  [[nodiscard]] double distance() const;    // to the goal, m
  [[nodiscard]] double headingOff() const;  // the goal's, rad
  // The plan gave the goal's heading up, and its own can be held: in strong wind the hull is not
  // turned round as soon as the wind slackens or veers. The next gust would take the heading again.
  [[nodiscard]] bool staysOffGoalHeading() const;
  // Why it arrives on another heading than the goal's; empty if it doesn't.
  [[nodiscard]] std::string whyOffHeading() const;

 private:
  [[nodiscard]] bool liesAtTheGoal() const;
  // Its way is over, and it lies in the wind with the goal's heading beyond abeam of it, where
  // strong wind takes the moment that the next try would need as well.
  [[nodiscard]] bool doesNotComeRound() const;
  [[nodiscard]] bool goalHeadingYields() const;
  [[nodiscard]] const Weather& weather() const { return safety_.weather(); }

  const Moment& moment_;
  const SupervisorOptions& options_;
  const Safety& safety_;
  const vessel::Parameters& vessel_;
  const Sailed& sailed_;
  const vessel::Pose& goal_;
};

}  // namespace otter_nav::mission
