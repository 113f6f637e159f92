// What rviz finds here (plugin_description.xml).
#include <pluginlib/class_list_macros.hpp>

#include "chart_display.hpp"
#include "heads_up_display.hpp"
#include "mission_panel.hpp"

PLUGINLIB_EXPORT_CLASS(otter_nav::rviz_plugins::ChartDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(otter_nav::rviz_plugins::HeadsUpDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(otter_nav::rviz_plugins::MissionPanel, rviz::Panel)
