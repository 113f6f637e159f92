#include "otter_nav/ais/local_frame.hpp"

#include <GeographicLib/LocalCartesian.hpp>

namespace otter_nav::ais {

struct LocalFrame::Plane {
  GeographicLib::LocalCartesian cartesian;
};

LocalFrame::LocalFrame(const Datum& datum)
    : plane_(std::make_unique<Plane>(
          Plane{GeographicLib::LocalCartesian(datum.latitude_deg, datum.longitude_deg, 0.0)})) {}
LocalFrame::~LocalFrame() = default;
LocalFrame::LocalFrame(LocalFrame&&) noexcept = default;
LocalFrame& LocalFrame::operator=(LocalFrame&&) noexcept = default;

Eigen::Vector2d LocalFrame::toMap(double latitude_deg, double longitude_deg) const {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  plane_->cartesian.Forward(latitude_deg, longitude_deg, 0.0, x, y, z);
  return {x, y};
}

Eigen::Vector2d LocalFrame::toDegrees(const Eigen::Vector2d& position) const {
  double latitude = 0.0;
  double longitude = 0.0;
  double height = 0.0;
  plane_->cartesian.Reverse(position.x(), position.y(), 0.0, latitude, longitude, height);
  return {latitude, longitude};
}

}  // namespace otter_nav::ais
