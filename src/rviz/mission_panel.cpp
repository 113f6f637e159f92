#include "mission_panel.hpp"

#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/PoseArray.h>
#include <ros/service.h>
#include <std_srvs/Trigger.h>

#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>
#include <cmath>
#include <mutex>
#include <thread>

#include "look.hpp"
#include "mission_widgets.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/ros/call_service.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"

namespace otter_nav::rviz_plugins {
namespace {

constexpr int kRefreshMs = 100;

QLabel* label(const char* name) {
  auto* made = new QLabel;
  made->setObjectName(name);
  made->setWordWrap(true);
  return made;
}

QString describe(std::size_t number, const geometry_msgs::Pose& goal) {
  const auto& q = goal.orientation;
  const double psi_rad = ros_bridge::rollPitchYaw({q.w, q.x, q.y, q.z}).z();
  // As a compass has it: from north, clockwise.
  const int course = static_cast<int>(std::lround(450.0 - psi_rad * 180.0 / kPi)) % 360;
  return QString("%1   x %2   y %3   %4°")
      .arg(number)
      .arg(goal.position.x, 0, 'f', 1)
      .arg(goal.position.y, 0, 'f', 1)
      .arg(course, 3, 10, QChar('0'));
}

}  // namespace

// Filled by the thread that asks; outlives the panel if need be.
struct Answer {
  std::mutex mutex;
  bool here = false;
  std::string text;
};

MissionPanel::MissionPanel(QWidget* parent)
    : rviz::Panel(parent),
      telemetry_(node_),
      state_(label("state")),
      reason_(label("reason")),
      answer_label_(label("answer")),
      pause_(addButton("pause", "Pause", "Stop in good order and keep the mission")),
      hold_(addButton("hold", "Hold", "Keep this place, with or without a mission")),
      resume_(addButton("resume", "Resume", "Go on with the mission")),
      stop_(addButton("stop", "STOP", "Stop in good order and end the mission")),
      cancel_(addButton("cancel", "Cancel goal", "Cancel the action's goal: stop, then idle")) {
  auto* column = new QVBoxLayout(this);
  column->setSpacing(4);
  column->setContentsMargins(6, 6, 6, 6);
  QFont big = state_->font();
  big.setPointSizeF(1.4 * big.pointSizeF());
  big.setBold(true);
  state_->setFont(big);
  state_->setAlignment(Qt::AlignCenter);
  column->addWidget(state_);
  column->addWidget(reason_);
  auto* buttons = new QGridLayout;
  buttons->addWidget(pause_, 0, 0);
  buttons->addWidget(hold_, 0, 1);
  buttons->addWidget(resume_, 0, 2);
  buttons->addWidget(stop_, 1, 0);
  buttons->addWidget(cancel_, 1, 1, 1, 2);
  stop_->setStyleSheet("QPushButton { background: #c62828; color: white; font-weight: bold; }");
  column->addLayout(buttons);
  column->addWidget(answer_label_);
  column->addWidget(makeGoals(), 1);
  column->addWidget(makeThrusts());
  column->addWidget(makeError());

  connect(pause_, &QPushButton::clicked, this, [this] { ask("planner_node/pause"); });
  connect(hold_, &QPushButton::clicked, this, [this] { ask("planner_node/hold"); });
  connect(resume_, &QPushButton::clicked, this, [this] { ask("planner_node/resume"); });
  connect(stop_, &QPushButton::clicked, this, [this] { ask("planner_node/stop"); });
  connect(cancel_, &QPushButton::clicked, this, [this] { cancel(); });
  route_subscriber_ = node_.subscribe<Route>(
      "route", 1, [this](const RouteConstPtr& message) { onRoute(*message); });
  route_publisher_ = node_.advertise<geometry_msgs::PoseArray>("route/set", 1);
  cancel_publisher_ = node_.advertise<actionlib_msgs::GoalID>("move_base/cancel", 1);
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] { refresh(); });
  timer->start(kRefreshMs);
  refresh();
}

MissionPanel::~MissionPanel() = default;

QPushButton* MissionPanel::addButton(const char* name, const char* text, const char* tip) {
  auto* button = new QPushButton(text, this);
  button->setObjectName(name);
  button->setToolTip(tip);
  return button;
}

QWidget* MissionPanel::makeGoals() {
  auto* box = new QGroupBox("Goals, sailed in this order");
  auto* grid = new QGridLayout(box);
  goals_ = new QListWidget;
  goals_->setObjectName("goals");
  goals_->setMinimumHeight(60);
  add_ = addButton("add", "Add marker", "Add the goal marker's pose (drag it in the view)");
  sooner_ = addButton("sooner", "Sooner", "Sail the chosen goal before the one above it");
  remove_ = addButton("remove", "Remove", "Remove the chosen goal");
  sail_ = addButton("sail", "Sail", "Sail them all");
  route_label_ = label("route_reason");
  grid->addWidget(goals_, 0, 0, 1, 4);
  grid->addWidget(add_, 1, 0);
  grid->addWidget(sooner_, 1, 1);
  grid->addWidget(remove_, 1, 2);
  grid->addWidget(sail_, 1, 3);
  grid->addWidget(route_label_, 2, 0, 1, 4);
  connect(add_, &QPushButton::clicked, this, [this] { ask("route_node/add_marker"); });
  connect(sooner_, &QPushButton::clicked, this, [this] { moveGoal(); });
  connect(remove_, &QPushButton::clicked, this, [this] { removeGoal(); });
  connect(sail_, &QPushButton::clicked, this, [this] { ask("route_node/sail"); });
  return box;
}

QWidget* MissionPanel::makeThrusts() {
  auto* box = new QGroupBox("Thrust");
  auto* grid = new QGridLayout(box);
  port_ = new ThrustGauge(look::kPort);
  starboard_ = new ThrustGauge(look::kStarboard);
  port_->setObjectName("port");
  starboard_->setObjectName("starboard");
  port_label_ = label("port_thrust");
  starboard_label_ = label("starboard_thrust");
  saturation_ = label("saturation");
  grid->addWidget(new QLabel("port"), 0, 0);
  grid->addWidget(port_, 0, 1);
  grid->addWidget(port_label_, 0, 2);
  grid->addWidget(new QLabel("starboard"), 1, 0);
  grid->addWidget(starboard_, 1, 1);
  grid->addWidget(starboard_label_, 1, 2);
  grid->addWidget(saturation_, 2, 0, 1, 3);
  grid->setColumnStretch(1, 1);
  return box;
}

QWidget* MissionPanel::makeError() {
  auto* box = new QGroupBox("Tracking error, last minute");
  auto* column = new QVBoxLayout(box);
  plot_ = new MinutePlot(telemetry_.error());
  error_label_ = label("error");
  column->addWidget(plot_);
  column->addWidget(error_label_);
  return box;
}

void MissionPanel::ask(const std::string& service) {
  answer_ = std::make_shared<Answer>();
  answer_label_->setText("…");
  const std::string name = node_.resolveName(service);
  // rviz draws meanwhile, and a node that hangs does not hang it.
  std::thread([answer = answer_, name] {
    std_srvs::Trigger call;
    std::string text = "nobody offers " + name;
    if (ros::service::exists(name, false) && ros_bridge::callService(name, call)) {
      text = call.response.success ? "" : call.response.message;
    }
    const std::lock_guard<std::mutex> lock(answer->mutex);
    answer->here = true;
    answer->text = text;
  }).detach();
}

void MissionPanel::cancel() {
  // An empty id means all goals.
  cancel_publisher_.publish(actionlib_msgs::GoalID());
}

void MissionPanel::changeGoals(const std::vector<geometry_msgs::Pose>& goals) {
  geometry_msgs::PoseArray message;
  message.header.frame_id = ros_bridge::frames().map;
  message.poses = goals;
  route_publisher_.publish(message);
}

void MissionPanel::removeGoal() {
  std::vector<geometry_msgs::Pose> goals = route_.goals;
  const int chosen = goals_->currentRow();
  if (chosen >= 0 && chosen < static_cast<int>(goals.size())) {
    goals.erase(goals.begin() + chosen);
    changeGoals(goals);
  }
}

void MissionPanel::moveGoal() {
  std::vector<geometry_msgs::Pose> goals = route_.goals;
  const int chosen = goals_->currentRow();
  if (chosen >= 1 && chosen < static_cast<int>(goals.size())) {
    std::swap(goals[static_cast<std::size_t>(chosen)], goals[static_cast<std::size_t>(chosen) - 1]);
    changeGoals(goals);
  }
}

void MissionPanel::onRoute(const Route& route) {
  const int chosen = goals_->currentRow();
  route_ = route;
  goals_->clear();
  for (std::size_t i = 0; i < route.goals.size(); ++i) {
    goals_->addItem(describe(i + 1, route.goals[i]));
    if (i == 0 && route.sailing) {
      goals_->item(0)->setText(goals_->item(0)->text() + "   under way");
    }
  }
  goals_->setCurrentRow(chosen);
  route_label_->setText(QString::fromStdString(route.reason));
  route_label_->setVisible(!route.reason.empty());
}

void MissionPanel::refresh() {
  refreshState();
  refreshButtons();
  refreshThrusts();
  refreshError();
}

void MissionPanel::refreshState() {
  const bool known = telemetry_.planner() && telemetry_.alive();
  const std::string state = known                  ? telemetry_.planner()->state
                            : telemetry_.planner() ? "no news"
                                                   : "no planner";
  state_->setText(QString::fromStdString(state).toUpper());
  state_->setStyleSheet(
      QString("QLabel { background: %1; color: white; border-radius: 4px; padding: 4px; }")
          .arg(colourOfState(state).name()));
  QString reason = known ? QString::fromStdString(telemetry_.planner()->reason) : "";
  if (known && telemetry_.tracker() && !telemetry_.tracker()->reason.empty()) {
    reason += (reason.isEmpty() ? "tracker: " : "; tracker: ") +
              QString::fromStdString(telemetry_.tracker()->reason);
  }
  reason_->setText(reason);
  if (answer_) {
    const std::lock_guard<std::mutex> lock(answer_->mutex);
    if (answer_->here) {
      answer_label_->setText(QString::fromStdString(answer_->text));
    }
  }
  answer_label_->setVisible(!answer_label_->text().isEmpty());
}

void MissionPanel::refreshButtons() {
  const std::string state = telemetry_.planner() ? telemetry_.planner()->state : "";
  const std::string why = telemetry_.planner() ? telemetry_.planner()->reason : "";
  const bool rests = state == PlannerStatus::PAUSED || state == PlannerStatus::HOLDING ||
                     why == PlannerStatus::PAUSED || why == PlannerStatus::HOLDING;
  const bool none = state.empty() || state == PlannerStatus::IDLE ||
                    state == PlannerStatus::ARRIVED || state == PlannerStatus::FAILED;
  pause_->setEnabled(!none && !rests);
  hold_->setEnabled(!state.empty() && state != PlannerStatus::HOLDING);
  resume_->setEnabled(rests);
  cancel_->setEnabled(!none);
  sail_->setEnabled(!route_.goals.empty() && !route_.sailing);
  remove_->setEnabled(goals_->currentRow() >= 0);
  sooner_->setEnabled(goals_->currentRow() >= 1);
}

void MissionPanel::refreshThrusts() {
  if (!telemetry_.thrust()) {
    port_label_->setText("–");
    starboard_label_->setText("–");
    saturation_->setText("no commands heard");
    return;
  }
  const ThrusterCommand& thrust = *telemetry_.thrust();
  port_label_->setText(QString("%1 N").arg(thrust.left, 0, 'f', 0));
  starboard_label_->setText(QString("%1 N").arg(thrust.right, 0, 'f', 0));
  if (!telemetry_.vessel()) {
    saturation_->setText("limits unknown: no tracker tells its vessel");
    return;
  }
  const vessel::Thrusters& thrusters = telemetry_.vessel()->thrusters;
  port_->setShare(shareOfThrust(thrust.left, thrusters));
  starboard_->setShare(shareOfThrust(thrust.right, thrusters));
  saturation_->setText(QString("at a limit %1 % of the last minute (%2 N ahead, %3 N astern)")
                           .arg(100.0 * telemetry_.saturated().mean(), 0, 'f', 0)
                           .arg(thrusters.ahead_max_n, 0, 'f', 0)
                           .arg(thrusters.astern_max_n, 0, 'f', 0));
}

void MissionPanel::refreshError() {
  plot_->update();
  if (telemetry_.error().samples().empty()) {
    error_label_->setText("no tracker heard");
    return;
  }
  error_label_->setText(QString("now %1 m, mean %2 m, largest %3 m")
                            .arg(telemetry_.error().samples().back().value, 0, 'f', 2)
                            .arg(telemetry_.error().mean(), 0, 'f', 2)
                            .arg(telemetry_.error().max(), 0, 'f', 2));
}

}  // namespace otter_nav::rviz_plugins
