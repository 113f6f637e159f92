// Where others have been and how they went on from there. Who comes by again on the same course, on
// a round or to and fro, will probably go on so again, corners and all.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "otter_nav/traffic/track.hpp"

namespace otter_nav::encounter {

class Habits {
 public:
  // Several times a second.
  void observe(const std::vector<traffic::Track>& tracks);

  // Places after each step of `step_s` from `from_s` on, the first then: how somebody went on who
  // was there on such a course before. Empty: nobody was, or nothing much came of it.
  [[nodiscard]] std::vector<Eigen::Vector2d> foretell(const traffic::Track& track, double from_s,
                                                      double step_s, int steps) const;
  // How fast her course has been turning for a while, rad/s, if it has done so steadily.
  [[nodiscard]] std::optional<double> steadyTurn(const traffic::Track& track) const;

 private:
  struct Record {
    double time_s = 0.0;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    int id = 0;
    // Of the same track.
    int before = -1;
    int next = -1;
  };
  struct Match {
    int record = -1;
    double share = 0.0;  // of the stretch to the next one
  };
  [[nodiscard]] Match match(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                            int id, double before_s) const;
  void forgetOldest();

  std::vector<Record> records_;
  std::map<int, int> last_;  // of each track
};

}  // namespace otter_nav::encounter
