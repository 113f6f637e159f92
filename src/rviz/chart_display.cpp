#include "chart_display.hpp"

#include <OGRE/OgreManualObject.h>
#include <OGRE/OgreMaterialManager.h>
#include <OGRE/OgreSceneManager.h>
#include <OGRE/OgreSceneNode.h>
#include <OGRE/OgreTechnique.h>
#include <OGRE/OgreTextureManager.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>

#include <QTransform>

#include "otter_nav/ros/grids.hpp"
#include "overlay_image.hpp"

namespace otter_nav::rviz_plugins {
namespace {

using rviz::StatusProperty;

constexpr int kSideMax = 16384;

rviz::RosTopicProperty* topic(rviz::Display* display, const char* name, const char* value,
                              const std::string& type, const char* what) {
  return new rviz::RosTopicProperty(name, value, QString::fromStdString(type), what, display,
                                    SLOT(subscribe()), display);
}

}  // namespace

ChartDisplay::ChartDisplay()
    : chart_topic_(topic(this, "Chart topic", "chart",
                         ros::message_traits::datatype<nav_msgs::OccupancyGrid>(),
                         "What was known of the water beforehand.")),
      map_topic_(topic(this, "Map topic", "map",
                       ros::message_traits::datatype<nav_msgs::OccupancyGrid>(),
                       "What is believed now; updates come on the same name with _updates.")),
      scan_topic_(topic(this, "Scan topic", "scan",
                        ros::message_traits::datatype<sensor_msgs::LaserScan>(),
                        "Where its beams went, water has been seen.")),
      alpha_(new rviz::FloatProperty("Alpha", 1.0F, "1: opaque", this, SLOT(updateAlpha()))) {
  alpha_->setMin(0.0F);
  alpha_->setMax(1.0F);
}

ChartDisplay::~ChartDisplay() {
  if (rectangle_ != nullptr) {
    scene_manager_->destroyManualObject(rectangle_);
    Ogre::MaterialManager::getSingleton().remove(material_);
    if (texture_) {
      Ogre::TextureManager::getSingleton().remove(texture_);
    }
  }
}

void ChartDisplay::onInitialize() {
  const std::string name = uniqueName("chart", this);
  material_ = Ogre::MaterialManager::getSingleton().create(
      name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material_->setReceiveShadows(false);
  Ogre::Pass* pass = material_->getTechnique(0)->getPass(0);
  pass->setLightingEnabled(false);
  pass->setCullingMode(Ogre::CULL_NONE);
  // Drawn first and under everything else, whatever its height.
  pass->setDepthWriteEnabled(false);
  pass->setDepthCheckEnabled(false);
  pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  rectangle_ = scene_manager_->createManualObject(name);
  rectangle_->setRenderQueueGroup(Ogre::RENDER_QUEUE_2);
  scene_node_->attachObject(rectangle_);
}

void ChartDisplay::onEnable() {
  subscribe();
}

void ChartDisplay::onDisable() {
  subscribers_.clear();
}

void ChartDisplay::reset() {
  Display::reset();
  picture_.forgetSeen();
  subscribe();
}

void ChartDisplay::subscribe() {
  subscribers_.clear();
  if (!isEnabled()) {
    return;
  }
  const auto listen = [this](auto message, const std::string& name, auto then) {
    using Message = decltype(message);
    if (!name.empty()) {
      subscribers_.push_back(update_nh_.subscribe<Message>(
          name, 100, [then](const boost::shared_ptr<const Message>& m) { then(m); }));
    }
  };
  const std::string map = map_topic_->getTopicStd();
  listen(nav_msgs::OccupancyGrid(), chart_topic_->getTopicStd(),
         [this](const auto& message) { onChart(*message); });
  listen(nav_msgs::OccupancyGrid(), map, [this](const auto& message) { onMap(*message); });
  listen(map_msgs::OccupancyGridUpdate(), map.empty() ? "" : map + "_updates",
         [this](const auto& message) { onUpdate(*message); });
  listen(sensor_msgs::LaserScan(), scan_topic_->getTopicStd(),
         [this](const auto& message) { scan_ = message; });
}

std::optional<map::OccupancyGrid> ChartDisplay::take(const nav_msgs::OccupancyGrid& message,
                                                     const char* name) {
  auto grid = ros_bridge::toGrid(message, message.header.frame_id);
  if (!grid) {
    setStatusStd(StatusProperty::Error, name, grid.error().message);
    return std::nullopt;
  }
  setStatus(StatusProperty::Ok, name, "received");
  frame_ = message.header.frame_id;
  return std::move(*grid);
}

void ChartDisplay::onChart(const nav_msgs::OccupancyGrid& message) {
  if (auto grid = take(message, "Chart")) {
    picture_.setChart(std::move(*grid));
    showAll();
  }
}

void ChartDisplay::onMap(const nav_msgs::OccupancyGrid& message) {
  auto grid = take(message, "Map");
  if (!grid) {
    return;
  }
  if (message.info.map_load_time != load_time_) {
    picture_.forgetSeen();
    load_time_ = message.info.map_load_time;
  }
  picture_.setMap(std::move(*grid));
  showAll();
}

void ChartDisplay::onUpdate(const map_msgs::OccupancyGridUpdate& message) {
  std::string error;
  const QRect part = picture_.update(message, error);
  if (!error.empty()) {
    setStatusStd(StatusProperty::Warn, "Map updates", error);
  }
  showPart(part);
}

void ChartDisplay::update(float /*wall_dt*/, float /*ros_dt*/) {
  place();
  if (scan_) {
    look(*scan_);
  }
}

// The scan waits for its transform, until the next one comes.
void ChartDisplay::look(const sensor_msgs::LaserScan& scan) {
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  if (picture_.empty() ||
      !context_->getFrameManager()->getTransform(scan.header, position, orientation)) {
    return;
  }
  const Ogre::Quaternion back = scene_node_->getOrientation().Inverse();
  const Ogre::Vector3 place = back * (position - scene_node_->getPosition());
  const Ogre::Vector3 ahead = back * orientation * Ogre::Vector3::UNIT_X;
  QTransform to_map;
  to_map.translate(place.x, place.y);
  to_map.rotateRadians(std::atan2(ahead.y, ahead.x));
  showPart(picture_.see(to_map.map(fanOf(scan))));
  scan_.reset();
}

void ChartDisplay::place() {
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  if (!frame_.empty() &&
      context_->getFrameManager()->getTransform(frame_, ros::Time(), position, orientation)) {
    scene_node_->setPosition(position);
    scene_node_->setOrientation(orientation);
  }
}

void ChartDisplay::showAll() {
  const map::GridGeometry& g = picture_.geometry();
  const QImage& image = picture_.image();
  if (image.width() > kSideMax || image.height() > kSideMax) {
    setStatus(StatusProperty::Error, "Map", QString("more than %1 cells a side").arg(kSideMax));
    return;
  }
  if (!texture_ || static_cast<int>(texture_->getWidth()) != image.width() ||
      static_cast<int>(texture_->getHeight()) != image.height()) {
    if (texture_) {
      Ogre::TextureManager::getSingleton().remove(texture_);
    }
    texture_ = makeTexture(material_->getName() + " texture", image.size());
    Ogre::Pass* pass = material_->getTechnique(0)->getPass(0);
    pass->removeAllTextureUnitStates();
    Ogre::TextureUnitState* unit = pass->createTextureUnitState();
    unit->setTexture(texture_);
    unit->setTextureFiltering(Ogre::TFO_BILINEAR);
    unit->setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
    updateAlpha();
  }
  upload(image, image.rect(), *texture_);
  const auto west = static_cast<float>(g.origin.x());
  const auto south = static_cast<float>(g.origin.y());
  const auto east = static_cast<float>(g.origin.x() + g.width * g.resolution_m);
  const auto north = static_cast<float>(g.origin.y() + g.height * g.resolution_m);
  rectangle_->clear();
  rectangle_->begin(material_->getName(), Ogre::RenderOperation::OT_TRIANGLE_FAN);
  const auto corner = [this](float x, float y, float u, float v) {
    rectangle_->position(x, y, 0.0F);
    rectangle_->textureCoord(u, v);
  };
  corner(west, south, 0.0F, 0.0F);
  corner(east, south, 1.0F, 0.0F);
  corner(east, north, 1.0F, 1.0F);
  corner(west, north, 0.0F, 1.0F);
  rectangle_->end();
  context_->queueRender();
}

void ChartDisplay::showPart(const QRect& part) {
  if (texture_ && !part.isEmpty()) {
    upload(picture_.image(), part, *texture_);
    context_->queueRender();
  }
}

void ChartDisplay::updateAlpha() {
  Ogre::Pass* pass = material_->getTechnique(0)->getPass(0);
  if (pass->getNumTextureUnitStates() > 0) {
    pass->getTextureUnitState(0)->setAlphaOperation(Ogre::LBX_MODULATE, Ogre::LBS_TEXTURE,
                                                    Ogre::LBS_MANUAL, 1.0, alpha_->getFloat());
    context_->queueRender();
  }
}

}  // namespace otter_nav::rviz_plugins
