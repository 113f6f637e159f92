// A way for the hull's rectangle where its centre's says too little, among things that stand no
// farther apart than the hull is long: straight legs ahead and astern, with turns on the spot
// between them. A* over places and headings (hybrid: places are kept as they are and compared by
// cells), in seconds as a slow vessel would take, dearer next to obstacles. What moves counts where
// it is at first; what comes of that is for the verifier.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/vessel/hull.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::planner {

// What a way for the hull must keep: its centre `centre_m`, the discs that cover it `beside_m`. And
// what it is to have beyond that on a heading where there is a choice, for a load from abeam swings
// it; nothing without.
struct HullRoom {
  double centre_m = 0.0;
  double beside_m = 0.0;
  std::function<double(double psi_rad)> swings_m = {};
};

// Workspaces are kept between calls. One thread at a time. The same inputs give the same way.
class HullSearch {
 public:
  explicit HullSearch(const vessel::Hull& hull) : hull_(hull), cover_(hull) {}

  // Poses from start to goal: between neighbours the hull turns on the spot, or goes straight along
  // its heading, ahead or astern. Empty where there is none within `kReachM` of the start, or
  // `expansions_most` places were looked at for each number of headings, or `is_late` says so.
  [[nodiscard]] std::vector<vessel::Pose> find(const feasibility::Obstacles& obstacles,
                                               const vessel::Pose& start, const vessel::Pose& goal,
                                               const HullRoom& room, int expansions_most,
                                               const std::function<bool()>& is_late = {});

  static constexpr double kReachM = 24.0;

  // The most that a way which begins there can keep.
  [[nodiscard]] HullRoom roomAt(const feasibility::Obstacles& obstacles,
                                const vessel::Pose& pose) const;

 private:
  // Of a whole turn: the finer ones where the others find no way, for a hull lies across by 8 cm at
  // half a step of 9 degrees. In tight water neither finds all ways: one place stands for its cell.
  static constexpr int kHeadings[] = {40, 80};
  enum class Motion : std::uint8_t { kTurn, kAhead, kAstern };
  struct Node {
    Eigen::Vector2d position;
    int heading;  // in steps from the start's
    Motion motion;
    float cost_s;
    int from;
  };

  [[nodiscard]] double psiOf(int heading) const;
  [[nodiscard]] double slack(const Eigen::Vector2d& position, double psi_rad) const;
  // How the hull stands, and how far it may still move there.
  struct Stand {
    Eigen::Vector2d position;
    double psi_rad;
    double slack_m;
  };
  [[nodiscard]] bool isClearBetween(const Stand& a, const Stand& b) const;
  // How many times as dear what is done there is as in roomy water.
  [[nodiscard]] double price(double slack_m, double psi_rad) const;
  // A turn on the spot and a straight leg, s; infinite where there is no room.
  [[nodiscard]] double turnCost(const Eigen::Vector2d& position, double psi_rad,
                                double turn_rad) const;
  [[nodiscard]] double legCost(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                               double psi_rad) const;
  [[nodiscard]] bool turnIsClear(const Eigen::Vector2d& position, double psi_rad,
                                 double turn_rad) const;
  [[nodiscard]] bool legIsClear(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                double psi_rad) const;
  [[nodiscard]] std::size_t keyOf(const Node& node) const;
  // To the goal, of the centre alone; measured as far as is asked for.
  [[nodiscard]] double leftS(const Eigen::Vector2d& position);
  [[nodiscard]] Eigen::Vector2d middleOf(int x, int y) const;  // of the coarse grid
  void beginLeft(const Eigen::Vector2d& goal);
  void reachLeft(int x, int y, float cost_s);
  void measureLeft();
  // Makes least_s_ far everywhere.
  void forgetLast();
  void look(int expansions_most, const std::function<bool()>& is_late);
  void push(const Node& node);
  void expand(int k);
  void tryToGoal(int k);
  [[nodiscard]] std::vector<vessel::Pose> posesTo(int k) const;
  [[nodiscard]] std::vector<vessel::Pose> shortened(const std::vector<vessel::Pose>& way) const;

  vessel::Hull hull_;
  feasibility::HullCover cover_;
  const feasibility::Obstacles* obstacles_ = nullptr;
  HullRoom room_;
  vessel::Pose start_;
  vessel::Pose goal_;
  int headings_ = kHeadings[0];
  std::vector<Node> nodes_;
  std::vector<std::pair<float, int>> front_;       // a heap, the least first
  std::vector<float> least_s_;                     // to reach a cell on a heading
  std::vector<float> left_s_;                      // from a cell of the coarse grid to the goal
  std::vector<std::pair<float, int>> left_front_;  // a heap of its cells, the least first
  int found_ = -1;                                 // the node from which the goal is reached
};

}  // namespace otter_nav::planner
