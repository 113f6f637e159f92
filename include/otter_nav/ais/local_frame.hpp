// The map frame on the globe: east and north of a datum, WGS 84.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace otter_nav::ais {

// The map's origin.
struct Datum {
  double latitude_deg = 63.4385;
  double longitude_deg = 10.3987;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("latitude_deg", o.latitude_deg, {-90.0, 90.0}, "north");
    fields("longitude_deg", o.longitude_deg, {-180.0, 180.0}, "east");
  }
};

class LocalFrame {
 public:
  explicit LocalFrame(const Datum& datum);
  ~LocalFrame();
  LocalFrame(LocalFrame&&) noexcept;
  LocalFrame& operator=(LocalFrame&&) noexcept;

  // Metres east and north in the plane that touches the ellipsoid at the datum.
  [[nodiscard]] Eigen::Vector2d toMap(double latitude_deg, double longitude_deg) const;
  // Latitude and longitude, degrees, of a point of that plane.
  [[nodiscard]] Eigen::Vector2d toDegrees(const Eigen::Vector2d& position) const;

 private:
  struct Plane;
  std::unique_ptr<Plane> plane_;
};

}  // namespace otter_nav::ais
