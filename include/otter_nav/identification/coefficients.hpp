// The manoeuvring model's coefficients as one vector, so that estimation can index them by number
// and name them in messages. The order is that of vessel::ManoeuvringModel and of the vessel file.
#pragma once

#include <Eigen/Core>
#include <array>

#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::identification {

enum CoefficientIndex : int {
  kSurgeInertia = 0,
  kSwayInertia,
  kYawInertia,
  kSurgeCentripetal,
  kSwayCentripetal,
  kMunk,
  kSurgeDrag,
  kSwayDrag,
  kYawDrag,
  kSurgeDragQuadratic,
  kSwayDragQuadratic,
  kYawDragQuadratic,
  kSwayFromYaw,
  kYawFromSway,
  kCoefficientCount
};

using Coefficients = Eigen::Matrix<double, kCoefficientCount, 1>;

// Keys of the vessel file's manoeuvring_model.
extern const std::array<const char*, kCoefficientCount> kCoefficientNames;

[[nodiscard]] Coefficients coefficientsOf(const vessel::ManoeuvringModel& model);
[[nodiscard]] vessel::ManoeuvringModel modelOf(const Coefficients& coefficients);

}  // namespace otter_nav::identification
