#include "heads_up_display.hpp"

#include <OGRE/OgreCamera.h>
#include <OGRE/OgreViewport.h>
#include <rviz/display_context.h>
#include <rviz/ogre_helpers/render_system.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/string_property.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>

#include <cmath>

#include "heads_up_painter.hpp"

namespace otter_nav::rviz_plugins {
namespace {

constexpr float kPeriodS = 0.1F;  // of wall time between two drawings
constexpr int kMargin = 10;

}  // namespace

HeadsUpDisplay::HeadsUpDisplay()
    : legend_wanted_(new rviz::BoolProperty("Legend", true, "What the colours mean.", this)),
      vessel_(new rviz::StringProperty(
          "Vessel", "",
          "Whose thrust limits to show: a name of config/vessels or a file; empty: the one the "
          "tracker tells.",
          this, SLOT(updateVessel()), this)) {}

HeadsUpDisplay::~HeadsUpDisplay() = default;

void HeadsUpDisplay::onInitialize() {
  rviz::RenderSystem::get()->prepareOverlays(scene_manager_);
  figures_ = std::make_unique<OverlayImage>(uniqueName("figures", this));
  rose_ = std::make_unique<OverlayImage>(uniqueName("rose", this));
  legend_ = std::make_unique<OverlayImage>(uniqueName("legend", this));
}

void HeadsUpDisplay::onEnable() {
  telemetry_ = std::make_unique<Telemetry>(update_nh_);
  updateVessel();
  since_drawn_s_ = kPeriodS;
}

void HeadsUpDisplay::onDisable() {
  telemetry_.reset();
  for (const auto* overlay : {&figures_, &rose_, &legend_}) {
    if (*overlay) {
      (*overlay)->hide();
    }
  }
}

void HeadsUpDisplay::reset() {
  Display::reset();
  if (isEnabled()) {
    onEnable();
  }
}

void HeadsUpDisplay::updateVessel() {
  if (telemetry_ && !telemetry_->setVessel(vessel_->getStdString())) {
    setStatusStd(rviz::StatusProperty::Error, "Vessel", "there is none of that name");
  } else {
    deleteStatus("Vessel");
  }
}

void HeadsUpDisplay::update(float wall_dt, float /*ros_dt*/) {
  since_drawn_s_ += wall_dt;
  const rviz::ViewController* view = context_->getViewManager()->getCurrent();
  if (!telemetry_ || since_drawn_s_ < kPeriodS || view == nullptr) {
    return;
  }
  since_drawn_s_ = 0.0F;
  const Ogre::Camera* camera = view->getCamera();
  const Ogre::Viewport* window = camera->getViewport();
  if (window == nullptr) {
    return;
  }
  const int width = window->getActualWidth();
  const int height = window->getActualHeight();
  const Ogre::Vector3 right = camera->getDerivedRight();
  figures_->show(paintFigures(*telemetry_), kMargin, kMargin);
  rose_->show(paintRose(*telemetry_, -std::atan2(right.y, right.x)), width - kRoseSize - kMargin,
              kMargin);
  if (legend_wanted_->getBool()) {
    legend_->show(paintLegend(std::min(width - 2 * kMargin, kLegendWidth)), kMargin,
                  height - kLegendHeight - kMargin);
  } else {
    legend_->hide();
  }
}

}  // namespace otter_nav::rviz_plugins
