// Planning in a thread of its own, one request at a time, with the guide path asked of
// topology_node. Results come back in the node's thread. A topology_node that has stopped without
// dying is not waited for: the planner finds its own way then.
#pragma once

#include <otter_nav/FindGuidePath.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/planner/planner.hpp"

namespace otter_nav::nodes {

class PlanWorker {
 public:
  struct Options {
    planner::Options planner;
    // Without a wall-clock budget only the iterations bound a plan, and it is the same each time.
    std::optional<double> budget_s;
    int max_iterations = 20000;
    bool use_topology_node = true;
  };
  // The request, its answer, and the wall time it took, ms.
  using OnDone =
      std::function<void(const mission::PlanRequest&, const planner::Plan&, double wall_ms)>;

  PlanWorker(const Options& options, const vessel::Parameters& vessel, OnDone on_done);
  ~PlanWorker();
  PlanWorker(const PlanWorker&) = delete;
  PlanWorker& operator=(const PlanWorker&) = delete;

  // Replaces a request that has not begun. The field is copied.
  void start(mission::PlanRequest request, const map::DistanceField& field,
             const ros::Time& map_stamp);
  // Of what was asked so far nothing is answered any more.
  void forget();

 private:
  struct Task {
    mission::PlanRequest request;
    map::DistanceField field;
    ros::Time map_stamp;
    int forgotten;  // times, when it was asked
  };
  void run();
  // Of the results on their way into the node's thread, which none outlives this.
  [[nodiscard]] std::uint64_t deliveryId() const { return reinterpret_cast<std::uint64_t>(this); }
  void plan(Task& task);
  [[nodiscard]] std::vector<Eigen::Vector2d> guidePath(const Task& task);
  [[nodiscard]] bool ask(FindGuidePath& call);
  // In the node's thread: ends a call that has not been answered in time.
  void watchTheCall();

  Options options_;
  planner::Planner planner_;
  OnDone on_done_;
  ros::NodeHandle node_;
  ros::ServiceClient topology_;
  std::chrono::steady_clock::time_point asks_again_;  // not before
  int forgotten_ = 0;                                 // times; the node's thread alone has it

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Task> next_;
  bool running_ = true;
  std::optional<std::chrono::steady_clock::time_point> asked_;  // while topology_node is called
  bool given_up_ = false;                                       // that call
  ros::SteadyTimer watch_;
  std::thread thread_;
};

}  // namespace otter_nav::nodes
