// How panel and heads-up display say the same things in the same words and colours.
#pragma once

#include <QColor>
#include <QString>
#include <string>

namespace otter_nav::rviz_plugins {

namespace look {
inline const QColor kCard(11, 32, 48, 205);
inline const QColor kText(255, 255, 255);
inline const QColor kFaint(168, 190, 205);
inline const QColor kPort(226, 86, 66);  // as the side lights
inline const QColor kStarboard(64, 178, 96);
inline const QColor kWind(255, 190, 60);
inline const QColor kCurrent(90, 200, 240);
inline const QColor kAlarm(226, 60, 50);
}  // namespace look

// By PlannerStatus.state: blue under way, amber for what stands by, red for what went wrong.
[[nodiscard]] QColor colourOfState(const std::string& state);
// "1:05"; a dash for what is no time.
[[nodiscard]] QString minutes(double seconds);

}  // namespace otter_nav::rviz_plugins
