// rviz display "Heads-up": figures, wind and current, and a legend in front of the 3D view.
#pragma once

#include <rviz/display.h>

#include <memory>

#include "overlay_image.hpp"
#include "telemetry.hpp"

namespace rviz {
class BoolProperty;
class StringProperty;
}  // namespace rviz

namespace otter_nav::rviz_plugins {

class HeadsUpDisplay : public rviz::Display {
  Q_OBJECT
 public:
  HeadsUpDisplay();
  ~HeadsUpDisplay() override;
  void update(float wall_dt, float ros_dt) override;
  void reset() override;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private Q_SLOTS:
  void updateVessel();

 private:
  rviz::BoolProperty* legend_wanted_;
  rviz::StringProperty* vessel_;
  std::unique_ptr<Telemetry> telemetry_;
  std::unique_ptr<OverlayImage> figures_;
  std::unique_ptr<OverlayImage> rose_;
  std::unique_ptr<OverlayImage> legend_;
  float since_drawn_s_ = 0.0F;
};

}  // namespace otter_nav::rviz_plugins
