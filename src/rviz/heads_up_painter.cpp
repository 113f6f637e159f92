#include "heads_up_painter.hpp"

#include <QPainter>
#include <QPainterPath>
#include <array>
#include <cmath>

#include "look.hpp"
#include "nautical_palette.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/speed_colour.hpp"

namespace otter_nav::rviz_plugins {
namespace {

using vessel::Thrusters;

constexpr int kEdge = 12;

QImage card(int width, int height) {
  QImage image(width, height, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(look::kCard);
  painter.drawRoundedRect(image.rect(), 8, 8);
  return image;
}

void pick(QPainter& painter, int pixels, const QColor& colour, bool bold = false) {
  QFont font = painter.font();
  font.setPixelSize(pixels);
  font.setBold(bold);
  painter.setFont(font);
  painter.setPen(colour);
}

void writeState(QPainter& painter, const Telemetry& telemetry) {
  std::string state = telemetry.planner() ? telemetry.planner()->state : "no planner";
  std::string reason = telemetry.planner() ? telemetry.planner()->reason : "";
  if (!telemetry.alive()) {
    state = "no news";
    reason = "nothing heard for seconds";
  }
  const QString text = QString::fromStdString(state).toUpper();
  pick(painter, 14, look::kText, true);
  const int width = painter.fontMetrics().horizontalAdvance(text) + 18;
  painter.setPen(Qt::NoPen);
  painter.setBrush(colourOfState(state));
  painter.drawRoundedRect(kEdge, kEdge, width, 24, 5, 5);
  painter.setPen(look::kText);
  painter.drawText(QRect(kEdge, kEdge, width, 24), Qt::AlignCenter, text);
  pick(painter, 11, look::kFaint);
  const QRect beside(kEdge + width + 8, kEdge - 4, kFiguresWidth - 2 * kEdge - width - 8, 32);
  // Two lines; what is longer stands in the panel.
  const QString fitting = painter.fontMetrics().elidedText(QString::fromStdString(reason),
                                                           Qt::ElideRight, 2 * beside.width() - 30);
  painter.drawText(beside, Qt::AlignVCenter | Qt::AlignLeft | Qt::TextWordWrap, fitting);
}

void writeFigure(QPainter& painter, int column, const QString& name, const QString& value,
                 const QString& unit) {
  const int left = kEdge + column * ((kFiguresWidth - 2 * kEdge) / 4);
  pick(painter, 10, look::kFaint);
  painter.drawText(left, 56, name);
  pick(painter, 21, look::kText, true);
  painter.drawText(left, 78, value);
  const int width = painter.fontMetrics().horizontalAdvance(value);
  pick(painter, 10, look::kFaint);
  painter.drawText(left + width + 3, 78, unit);
}

QString figure(double value, int digits = 2) {
  return std::isfinite(value) ? QString::number(value, 'f', digits) : QString("–");
}

void writeFigures(QPainter& painter, const Telemetry& telemetry) {
  const double nan = std::nan("");
  double speed = nan;
  if (telemetry.odometry()) {
    const auto& v = telemetry.odometry()->twist.twist.linear;
    speed = std::hypot(v.x, v.y);
  }
  const bool on_track =
      telemetry.tracker() && (telemetry.tracker()->state == TrackerStatus::TRACKING ||
                              telemetry.tracker()->state == TrackerStatus::HOLDING);
  writeFigure(painter, 0, "SPEED", figure(speed), "m/s");
  writeFigure(painter, 1, "OFF TRACK", figure(on_track ? telemetry.tracker()->position_error : nan),
              "m");
  writeFigure(painter, 2, "ARRIVES IN", minutes(on_track ? telemetry.tracker()->time_left : nan),
              "");
  const bool planned = telemetry.planner() && telemetry.planner()->clearance > 0.0;
  writeFigure(painter, 3, "KEEPS CLEAR", figure(planned ? telemetry.planner()->clearance : nan),
              "m");
}

void drawThrust(QPainter& painter, int row, const QString& side, const QColor& colour,
                double thrust_n, const std::optional<Thrusters>& thrusters) {
  const QRect bar(kEdge + 44, 90 + 18 * row, 250, 12);
  pick(painter, 11, look::kFaint);
  painter.drawText(QRect(kEdge, bar.top() - 2, 44, 16), Qt::AlignVCenter, side);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(255, 255, 255, 40));
  painter.drawRect(bar);
  const double share = thrusters ? shareOfThrust(thrust_n, *thrusters) : 0.0;
  const int middle = bar.center().x();
  const int reach = static_cast<int>(std::lround(share * bar.width() / 2.0));
  painter.setBrush(colour);
  painter.drawRect(QRect(std::min(middle, middle + reach), bar.top(), std::abs(reach), 12));
  painter.setBrush(look::kText);
  painter.drawRect(middle, bar.top() - 2, 1, 16);
  const bool full = std::abs(share) >= kAtLimit;
  pick(painter, 11, full ? look::kWind : look::kText, full);
  painter.drawText(QRect(bar.right() + 8, bar.top() - 2, 84, 16), Qt::AlignVCenter,
                   QString("%1 N%2").arg(figure(thrust_n, 0), full ? " FULL" : ""));
}

void writePlan(QPainter& painter, const Telemetry& telemetry) {
  pick(painter, 11, look::kFaint);
  if (!telemetry.planner() || telemetry.planner()->plans == 0) {
    painter.drawText(kEdge, kFiguresHeight - 14, "no plan yet");
    return;
  }
  const PlannerStatus& plan = *telemetry.planner();
  painter.drawText(
      kEdge, kFiguresHeight - 14,
      QString("plan %1: %2 m in %3 s, made in %4 ms · %5 on the way · tree %6 of %7")
          .arg(plan.plans)
          .arg(figure(plan.length, 0), figure(plan.duration, 0), figure(plan.planning_ms, 0))
          .arg(plan.replans)
          .arg(plan.nodes)
          .arg(plan.samples));
}

// An arrow through the middle that points where the stuff goes.
void drawFlow(QPainter& painter, const QPointF& middle, double radius, double angle_rad,
              const QColor& colour) {
  painter.save();
  painter.translate(middle);
  painter.rotate(-angle_rad * 180.0 / kPi);
  painter.setPen(QPen(colour, 3.0, Qt::SolidLine, Qt::FlatCap));
  painter.drawLine(QPointF(-radius, 0.0), QPointF(radius - 8.0, 0.0));
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawPolygon(QPolygonF({{radius, 0.0}, {radius - 12.0, 6.0}, {radius - 12.0, -6.0}}));
  painter.restore();
}

void drawHull(QPainter& painter, const QPointF& middle, double angle_rad) {
  painter.save();
  painter.translate(middle);
  painter.rotate(-angle_rad * 180.0 / kPi);
  painter.setPen(QPen(look::kCard, 1.0));
  painter.setBrush(look::kText);
  painter.drawPolygon(
      QPolygonF({{13.0, 0.0}, {6.0, 6.0}, {-12.0, 6.0}, {-12.0, -6.0}, {6.0, -6.0}}));
  painter.restore();
}

}  // namespace

QImage paintFigures(const Telemetry& telemetry) {
  QImage image = card(kFiguresWidth, kFiguresHeight);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  writeState(painter, telemetry);
  writeFigures(painter, telemetry);
  std::optional<Thrusters> thrusters;
  if (telemetry.vessel()) {
    thrusters = telemetry.vessel()->thrusters;
  }
  const double nan = std::nan("");
  drawThrust(painter, 0, "port", look::kPort, telemetry.thrust() ? telemetry.thrust()->left : nan,
             thrusters);
  drawThrust(painter, 1, "starb.", look::kStarboard,
             telemetry.thrust() ? telemetry.thrust()->right : nan, thrusters);
  writePlan(painter, telemetry);
  return image;
}

QImage paintRose(const Telemetry& telemetry, double east_on_screen_rad) {
  QImage image = card(kRoseSize, kRoseSize);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPointF middle(kRoseSize / 2.0, 66.0);
  constexpr double kRadius = 50.0;
  painter.setPen(QPen(look::kFaint, 1.0));
  painter.drawEllipse(middle, kRadius, kRadius);
  const std::array<const char*, 4> names = {"E", "N", "W", "S"};
  for (int k = 0; k < 4; ++k) {
    const double angle = east_on_screen_rad + k * kPi / 2.0;
    const QPointF out(std::cos(angle), -std::sin(angle));
    painter.setPen(QPen(look::kFaint, 1.0));
    painter.drawLine(middle + (kRadius - 4.0) * out, middle + kRadius * out);
    const bool north = k == 1;
    pick(painter, north ? 13 : 9, north ? look::kText : look::kFaint, north);
    const QPointF at = middle + (kRadius + 8.0) * out;
    painter.drawText(QRectF(at.x() - 10.0, at.y() - 8.0, 20.0, 16.0), Qt::AlignCenter,
                     names[static_cast<std::size_t>(k)]);
  }
  const auto flow = [&](const std::optional<Eigen::Vector2d>& v, double radius,
                        const QColor& colour) {
    if (v && v->norm() > 0.02) {
      drawFlow(painter, middle, radius, east_on_screen_rad + std::atan2(v->y(), v->x()), colour);
    }
  };
  flow(telemetry.wind(), kRadius - 2.0, look::kWind);
  flow(telemetry.current(), 0.7 * kRadius, look::kCurrent);
  if (telemetry.odometry()) {
    const auto& q = telemetry.odometry()->pose.pose.orientation;
    const double psi_rad = ros_bridge::rollPitchYaw({q.w, q.x, q.y, q.z}).z();
    drawHull(painter, middle, east_on_screen_rad + psi_rad);
  }
  const auto write = [&](int y, const QString& name, const std::optional<Eigen::Vector2d>& v,
                         const QColor& colour) {
    pick(painter, 11, colour, true);
    painter.drawText(QRect(0, y, kRoseSize, 14), Qt::AlignCenter,
                     QString("%1 %2 m/s").arg(name, figure(v ? v->norm() : std::nan(""), 1)));
  };
  write(kRoseSize - 36, "wind", telemetry.wind(), look::kWind);
  write(kRoseSize - 20, "current", telemetry.current(), look::kCurrent);
  return image;
}

QImage paintLegend(int width) {
  QImage image = card(width, kLegendHeight);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  pick(painter, 11, look::kText);
  int x = kEdge;
  const auto entry = [&](int row, int swatch, const QBrush& brush, const QString& text) {
    const int y = 8 + 20 * row;
    painter.setPen(QPen(QColor(255, 255, 255, 120), 1.0));
    painter.setBrush(brush);
    painter.drawRect(x, y, swatch, 12);
    painter.setPen(look::kText);
    painter.drawText(x + swatch + 6, y + 11, text);
    x += swatch + 20 + painter.fontMetrics().horizontalAdvance(text);
  };
  for (const PaletteEntry& shade : kPalette) {
    entry(0, 16, QColor(shade.colour), shade.name);
  }
  x = kEdge;
  QLinearGradient speeds(x, 0, x + 60, 0);
  for (int k = 0; k <= 6; ++k) {
    const auto colour = ros_bridge::speedColour(k / 6.0);
    speeds.setColorAt(k / 6.0, QColor::fromRgbF(colour[0], colour[1], colour[2]));
  }
  entry(1, 60, speeds, "trajectory, slow to full speed");
  entry(1, 16, QColor(30, 140, 115, 140), "clearance it keeps");
  entry(1, 16, QColor(235, 130, 20, 200), "narrower now");
  entry(1, 16, QColor(255, 0, 255), "prediction");
  entry(1, 16, QColor(20, 20, 20), "trail");
  return image;
}

QColor colourOfState(const std::string& state) {
  if (state == PlannerStatus::FAILED || state == "no news") {
    return look::kAlarm;
  }
  if (state == PlannerStatus::SAILING || state == PlannerStatus::REPLANNING) {
    return {25, 118, 192};
  }
  if (state == PlannerStatus::ARRIVED) {
    return {38, 140, 72};
  }
  if (state == PlannerStatus::IDLE || state == "no planner") {
    return {96, 112, 124};
  }
  return {196, 122, 12};
}

QString minutes(double seconds) {
  if (!std::isfinite(seconds)) {
    return "–";
  }
  const int whole = static_cast<int>(std::lround(std::max(0.0, seconds)));
  return QString("%1:%2").arg(whole / 60).arg(whole % 60, 2, 10, QChar('0'));
}

}  // namespace otter_nav::rviz_plugins
