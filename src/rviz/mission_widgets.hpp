// What the mission panel draws itself.
#pragma once

#include <QWidget>

#include "telemetry.hpp"

namespace otter_nav::rviz_plugins {

// A thruster's command as a share of its limit: astern to the left, ahead to the right.
class ThrustGauge : public QWidget {
 public:
  explicit ThrustGauge(const QColor& colour, QWidget* parent = nullptr);
  void setShare(double share);
  [[nodiscard]] double share() const { return share_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QColor colour_;
  double share_ = 0.0;
};

// Values of the last minute over time, with a scale.
class MinutePlot : public QWidget {
 public:
  explicit MinutePlot(const LastMinute& values, QWidget* parent = nullptr);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  const LastMinute& values_;
};

}  // namespace otter_nav::rviz_plugins
