#include "plan_worker.hpp"

#include <otter_nav/FindGuidePath.h>
#include <ros/console.h>

#include <chrono>
#include <utility>

#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/guide_paths.hpp"

namespace otter_nav::nodes {
namespace {

// A result on its way into the node's thread.
class Delivery : public ros::CallbackInterface {
 public:
  Delivery(PlanWorker::OnDone on_done, PlanDone done)
      : on_done_(std::move(on_done)), done_(std::move(done)) {}
  CallResult call() override {
    on_done_(done_);
    return Success;
  }

 private:
  PlanWorker::OnDone on_done_;
  PlanDone done_;
};

geometry_msgs::PoseStamped poseMessage(const Eigen::Vector2d& position, double psi_rad) {
  geometry_msgs::PoseStamped message;
  message.header.frame_id = ros_bridge::kMapFrame;
  message.pose = ros_bridge::toPose(position, psi_rad);
  return message;
}

}  // namespace

PlanWorker::PlanWorker(const Options& options, const vessel::Parameters& vessel, OnDone on_done)
    : options_(options),
      desk_(options.planner, vessel),
      on_done_(std::move(on_done)),
      thread_([this] { run(); }) {}

PlanWorker::~PlanWorker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    running_ = false;
  }
  changed_.notify_all();
  thread_.join();
}

void PlanWorker::start(PlanTask task) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    next_ = std::move(task);
  }
  changed_.notify_all();
}

void PlanWorker::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (running_) {
    changed_.wait(lock, [this] { return next_.has_value() || !running_; });
    if (!running_) {
      return;
    }
    const PlanTask task = std::move(*std::exchange(next_, std::nullopt));
    lock.unlock();
    ros::getGlobalCallbackQueue()->addCallback(boost::make_shared<Delivery>(on_done_, plan(task)));
    lock.lock();
  }
}

PlanDone PlanWorker::plan(const PlanTask& task) {
  const auto begin = std::chrono::steady_clock::now();
  planner::Termination termination;
  if (options_.budget_s) {
    termination = planner::wallClock(*options_.budget_s, options_.max_iterations);
  } else {
    termination.max_iterations = options_.max_iterations;
  }
  PlanDone done;
  done.request = task.request;
  done.plan = desk_.plan(task.request, task.field, guidePath(task), termination);
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
  done.wall_ms = taken.count();
  return done;
}

std::vector<Eigen::Vector2d> PlanWorker::guidePath(const PlanTask& task) {
  if (!options_.use_topology_node) {
    return {};
  }
  if (!topology_.isValid()) {
    topology_ = node_.serviceClient<FindGuidePath>("find_guide_path", true);
  }
  FindGuidePath call;
  call.request.start = poseMessage(task.request.start.position, task.request.start_psi_rad);
  call.request.goal = poseMessage(task.request.goal.position, task.request.goal.psi_rad);
  call.request.map_stamp = task.map_stamp;
  if (!topology_.isValid() || !topology_.call(call)) {
    ROS_WARN_THROTTLE(10.0, "find_guide_path does not answer; the planner finds its own way");
    return {};
  }
  return call.response.guide_path.found != 0 ? ros_bridge::toPoints(call.response.guide_path.points)
                                             : std::vector<Eigen::Vector2d>{};
}

}  // namespace otter_nav::nodes
