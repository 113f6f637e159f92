#include "plan_worker.hpp"

#include <ros/console.h>

#include <utility>

#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/guide_paths.hpp"

namespace otter_nav::nodes {
namespace {

using std::chrono::steady_clock;

// topology_node itself waits for its map for a while, and a search takes far less than a second.
constexpr std::chrono::seconds kAnswersWithin{5};
// Who has been waited for in vain is not asked for a while: each time would cost the whole wait.
constexpr std::chrono::seconds kAsksAgainAfter{30};

// A call on its way into the node's thread.
class Delivery : public ros::CallbackInterface {
 public:
  explicit Delivery(std::function<void()> deliver) : deliver_(std::move(deliver)) {}
  CallResult call() override {
    deliver_();
    return Success;
  }

 private:
  std::function<void()> deliver_;
};

}  // namespace

PlanWorker::PlanWorker(const Options& options, const vessel::Parameters& vessel, OnDone on_done)
    : options_(options),
      planner_(options.planner, vessel),
      on_done_(std::move(on_done)),
      watch_(node_.createSteadyTimer(ros::WallDuration(0.5),
                                     [this](const ros::SteadyTimerEvent&) { watchTheCall(); })),
      thread_([this] { run(); }) {}

PlanWorker::~PlanWorker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    running_ = false;
    if (asked_) {
      topology_.shutdown();
    }
  }
  changed_.notify_all();
  thread_.join();
  ros::getGlobalCallbackQueue()->removeByID(deliveryId());
}

void PlanWorker::start(mission::PlanRequest request, const map::DistanceField& field,
                       const ros::Time& map_stamp) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    next_ = Task{std::move(request), field, map_stamp, forgotten_};
  }
  changed_.notify_all();
}

void PlanWorker::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  next_.reset();
  ++forgotten_;
}

void PlanWorker::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (running_) {
    changed_.wait(lock, [this] { return next_.has_value() || !running_; });
    if (!running_) {
      return;
    }
    Task task = std::move(*std::exchange(next_, std::nullopt));
    lock.unlock();
    plan(task);
    lock.lock();
  }
}

void PlanWorker::plan(Task& task) {
  const auto begin = steady_clock::now();
  planner::Termination termination;
  if (options_.budget_s) {
    // At rest in narrow water there is time to look for a way to creep.
    constexpr double kToCreepTimes = 5.0;
    const planner::Query& query = task.request.query;
    const double times = query.may_creep && query.may_end_early ? kToCreepTimes : 1.0;
    termination = planner::wallClock(times * *options_.budget_s, options_.max_iterations);
  } else {
    termination.max_iterations = options_.max_iterations;
  }
  task.request.query.guide_path = guidePath(task);
  feasibility::Obstacles obstacles = task.field;
  if (!task.request.others.empty()) {
    obstacles.add(task.request.others);
  }
  planner::Plan plan = planner_.plan(obstacles.startingAt(task.request.start_time_s),
                                     task.request.query, termination);
  const std::chrono::duration<double, std::milli> taken = steady_clock::now() - begin;
  ros::getGlobalCallbackQueue()->addCallback(
      boost::make_shared<Delivery>([this, request = std::move(task.request), plan = std::move(plan),
                                    ms = taken.count(), forgotten = task.forgotten] {
        if (forgotten == forgotten_) {
          on_done_(request, plan, ms);
        }
      }),
      deliveryId());
}

std::vector<Eigen::Vector2d> PlanWorker::guidePath(const Task& task) {
  if (!options_.use_topology_node || steady_clock::now() < asks_again_) {
    return {};
  }
  const planner::Query& query = task.request.query;
  FindGuidePath call;
  const std::string& frame = ros_bridge::frames().map;
  call.request.start = ros_bridge::toPose(query.guideStart(), frame, task.map_stamp);
  call.request.goal =
      ros_bridge::toPose({query.goal.flat.position, query.goal.psi_rad}, frame, task.map_stamp);
  call.request.clearance = query.limits.clearance_m;
  call.request.map_stamp = task.map_stamp;
  if (!ask(call)) {
    ROS_WARN_THROTTLE(10.0, "find_guide_path does not answer; the planner finds its own way");
    return {};
  }
  return call.response.guide_path.found != 0 ? ros_bridge::toPoints(call.response.guide_path.points)
                                             : std::vector<Eigen::Vector2d>{};
}

bool PlanWorker::ask(FindGuidePath& call) {
  if (!topology_.isValid()) {
    topology_ = node_.serviceClient<FindGuidePath>("find_guide_path", true);
  }
  if (!topology_.isValid()) {
    return false;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!running_) {
      return false;
    }
    given_up_ = false;
    asked_ = steady_clock::now();
  }
  const bool answered = topology_.call(call);
  const std::lock_guard<std::mutex> lock(mutex_);
  asked_.reset();
  if (!answered && given_up_) {
    asks_again_ = steady_clock::now() + kAsksAgainAfter;
  }
  return answered;
}

void PlanWorker::watchTheCall() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (asked_ && !given_up_ && steady_clock::now() - *asked_ > kAnswersWithin) {
    given_up_ = true;
    topology_.shutdown();  // the call comes back without an answer
  }
}

}  // namespace otter_nav::nodes
