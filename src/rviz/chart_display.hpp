// rviz display "Nautical chart": what is known of the water, in a chart's colours
// (nautical_palette.hpp). It lives from `chart`, `map`, `map_updates` and `scan` alone, so from a
// recording too.
#pragma once

#include <OGRE/OgreMaterial.h>
#include <OGRE/OgreTexture.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/subscriber.h>
#include <rviz/display.h>
#include <sensor_msgs/LaserScan.h>

#include <string>
#include <vector>

#include "chart_picture.hpp"

namespace Ogre {
class ManualObject;
}
namespace rviz {
class FloatProperty;
class RosTopicProperty;
}  // namespace rviz

namespace otter_nav::rviz_plugins {

class ChartDisplay : public rviz::Display {
  Q_OBJECT
 public:
  ChartDisplay();
  ~ChartDisplay() override;
  void reset() override;
  void update(float wall_dt, float ros_dt) override;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private Q_SLOTS:
  void subscribe();
  void updateAlpha();

 private:
  // What a message holds, or nothing, and the status says why.
  [[nodiscard]] std::optional<map::OccupancyGrid> take(const nav_msgs::OccupancyGrid& message,
                                                       const char* name);
  void onChart(const nav_msgs::OccupancyGrid& message);
  void onMap(const nav_msgs::OccupancyGrid& message);
  void onUpdate(const map_msgs::OccupancyGridUpdate& message);
  void look(const sensor_msgs::LaserScan& scan);
  // Makes texture and rectangle anew if the grid is another one.
  void showAll();
  void showPart(const QRect& part);
  void place();

  rviz::RosTopicProperty* chart_topic_;
  rviz::RosTopicProperty* map_topic_;
  rviz::RosTopicProperty* scan_topic_;
  rviz::FloatProperty* alpha_;
  std::vector<ros::Subscriber> subscribers_;
  ChartPicture picture_;
  std::string frame_;
  ros::Time load_time_;
  sensor_msgs::LaserScanConstPtr scan_;  // to be looked at when its transform is there
  map::GridGeometry drawn_;              // of the rectangle
  Ogre::ManualObject* rectangle_ = nullptr;
  Ogre::MaterialPtr material_;
  Ogre::TexturePtr texture_;
};

}  // namespace otter_nav::rviz_plugins
