#include "mission_widgets.hpp"

#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

namespace otter_nav::rviz_plugins {

ThrustGauge::ThrustGauge(const QColor& colour, QWidget* parent) : QWidget(parent), colour_(colour) {
  setMinimumHeight(16);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ThrustGauge::setShare(double share) {
  if (share != share_) {
    share_ = share;
    update();
  }
}

void ThrustGauge::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  const QRect bar = rect().adjusted(0, 2, -1, -2);
  painter.fillRect(bar, palette().color(QPalette::Base));
  const int middle = bar.center().x();
  const int end = middle + static_cast<int>(std::lround(share_ * bar.width() / 2.0));
  painter.fillRect(
      QRect(QPoint(std::min(middle, end), bar.top()), QPoint(std::max(middle, end), bar.bottom())),
      colour_);
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawRect(bar);
  painter.setPen(palette().color(QPalette::Text));
  painter.drawLine(middle, 0, middle, height());
}

MinutePlot::MinutePlot(const LastMinute& values, QWidget* parent)
    : QWidget(parent), values_(values) {
  setMinimumHeight(80);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void MinutePlot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  const QRectF plot = QRectF(rect()).adjusted(46.0, 6.0, -6.0, -16.0);
  // The scale steps, so that it does not breathe with the curve.
  constexpr std::array<double, 9> kScales = {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 50.0};
  const auto scale = std::lower_bound(kScales.begin(), kScales.end() - 1, values_.max());
  QFont font = painter.font();
  font.setPixelSize(10);
  painter.setFont(font);
  for (const double share : {0.0, 0.5, 1.0}) {
    const double y = plot.bottom() - share * plot.height();
    painter.setPen(palette().color(QPalette::Midlight));
    painter.drawLine(QPointF(plot.left(), y), QPointF(plot.right(), y));
    painter.setPen(palette().color(QPalette::Text));
    painter.drawText(QRectF(0.0, y - 7.0, 42.0, 14.0), Qt::AlignRight | Qt::AlignVCenter,
                     QString::number(share * *scale) + (share == 1.0 ? " m" : ""));
  }
  painter.drawText(QRectF(plot.left(), plot.bottom() + 2.0, plot.width(), 14.0), Qt::AlignLeft,
                   "60 s ago");
  painter.drawText(QRectF(plot.left(), plot.bottom() + 2.0, plot.width(), 14.0), Qt::AlignRight,
                   "now");
  QPolygonF curve;
  for (const LastMinute::Sample& sample : values_.samples()) {
    const double ago_s = values_.samples().back().time_s - sample.time_s;
    curve << QPointF(plot.right() - ago_s / LastMinute::kLengthS * plot.width(),
                     plot.bottom() - std::min(1.0, sample.value / *scale) * plot.height());
  }
  painter.setPen(QPen(QColor(25, 118, 192), 1.5));
  painter.drawPolyline(curve);
}

}  // namespace otter_nav::rviz_plugins
