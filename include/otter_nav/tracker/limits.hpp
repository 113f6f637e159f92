// Sizes fixed at compile time so that the control loop never allocates.
#pragma once

namespace otter_nav::tracker {

constexpr int kMaxStages = 100;

}  // namespace otter_nav::tracker
