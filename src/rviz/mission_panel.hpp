// rviz panel "Mission": what the mission does and why, the operator's wishes, the goals of the
// route, thrusts and tracking error. It speaks to planner_node, route_node and the action move_base
// by their topics and services alone.
#pragma once

#include <otter_nav/Route.h>
#include <ros/node_handle.h>
#include <rviz/panel.h>

#include <memory>

#include "telemetry.hpp"

class QLabel;
class QListWidget;
class QPushButton;

namespace otter_nav::rviz_plugins {

class MinutePlot;
class ThrustGauge;
struct Answer;

// Children have object names, by which tests find them.
class MissionPanel : public rviz::Panel {
  Q_OBJECT
 public:
  explicit MissionPanel(QWidget* parent = nullptr);
  ~MissionPanel() override;

 private:
  QPushButton* addButton(const char* name, const char* text, const char* tip);
  QWidget* makeGoals();
  QWidget* makeThrusts();
  QWidget* makeError();

  // Asks a service of that name without waiting; what it says is shown when it comes.
  void ask(const std::string& service);
  void cancel();
  void changeGoals(const std::vector<geometry_msgs::Pose>& goals);
  void removeGoal();
  void moveGoal();
  void onRoute(const Route& route);

  void refresh();
  void refreshState();
  void refreshButtons();
  void refreshThrusts();
  void refreshError();

  ros::NodeHandle node_;
  Telemetry telemetry_;
  Route route_;
  std::shared_ptr<Answer> answer_;  // of the last question
  ros::Subscriber route_subscriber_;
  ros::Publisher route_publisher_;
  ros::Publisher cancel_publisher_;

  QLabel* state_;
  QLabel* reason_;
  QLabel* answer_label_;
  QPushButton* pause_;
  QPushButton* hold_;
  QPushButton* resume_;
  QPushButton* stop_;
  QPushButton* cancel_;
  QListWidget* goals_ = nullptr;
  QPushButton* add_ = nullptr;
  QPushButton* remove_ = nullptr;
  QPushButton* sooner_ = nullptr;
  QPushButton* sail_ = nullptr;
  QLabel* route_label_ = nullptr;
  ThrustGauge* port_ = nullptr;
  ThrustGauge* starboard_ = nullptr;
  QLabel* port_label_ = nullptr;
  QLabel* starboard_label_ = nullptr;
  QLabel* saturation_ = nullptr;
  QLabel* error_label_ = nullptr;
  MinutePlot* plot_ = nullptr;
};

}  // namespace otter_nav::rviz_plugins
