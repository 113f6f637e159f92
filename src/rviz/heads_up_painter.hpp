// Paints the heads-up display's cards: figures of the run, wind and current, what the colours mean.
#pragma once

#include <QImage>

#include "telemetry.hpp"

namespace otter_nav::rviz_plugins {

inline constexpr int kFiguresWidth = 404;
inline constexpr int kFiguresHeight = 164;
inline constexpr int kRoseSize = 164;
inline constexpr int kLegendHeight = 48;
inline constexpr int kLegendWidth = 780;

[[nodiscard]] QImage paintFigures(const Telemetry& telemetry);
// `east_on_screen_rad`: where east points in the picture, counter-clockwise from the right.
[[nodiscard]] QImage paintRose(const Telemetry& telemetry, double east_on_screen_rad);
[[nodiscard]] QImage paintLegend(int width);

}  // namespace otter_nav::rviz_plugins
