// The Otter against the reference implementation, run by run (test/data/otter_mss/README.md).
#include <gtest/gtest.h>

#include <string>

#include "otter_nav/base/angles.hpp"
#include "plant/otter_model.hpp"
#include "replay/replay.hpp"

namespace otter_nav::plant {
namespace {

struct Run {
  const char* file;
  PayloadOptions payload;
  SteadyCurrent current;
};

void PrintTo(const Run& run, std::ostream* out) {
  *out << run.file;
}

PayloadOptions payload(double mass_kg, const Eigen::Vector3d& position = {0.05, 0.0, -0.35}) {
  return {mass_kg, position};
}

class Reference : public testing::TestWithParam<Run> {
 protected:
  [[nodiscard]] static Recording recording() {
    return readRecording(std::string(OTTER_NAV_SOURCE_DIR) + "/test/data/otter_mss/" +
                         GetParam().file + ".csv")
        .value();
  }
};

TEST_P(Reference, IsReproducedOverTheWholeRun) {
  const Recording expected = recording();
  const OtterModel model(GetParam().payload, /*propeller_lag=*/false);
  const Recording computed = replay(model, expected, GetParam().current);
  ASSERT_EQ(computed.rows.size(), expected.rows.size());
  for (std::size_t k = 0; k < expected.rows.size(); ++k) {
    const double worst =
        (computed.rows[k].state - expected.rows[k].state).head<12>().lpNorm<Eigen::Infinity>();
    EXPECT_LT(worst, 1e-6) << "row " << k;
  }
}

TEST_P(Reference, StartsInOurSettledTrim) {
  const OtterModel model(GetParam().payload, /*propeller_lag=*/false);
  const PlantState trim = model.settled();
  const PlantState expected = recording().rows.front().state;
  EXPECT_NEAR(trim[kDown], expected[kDown], 1e-6);
  EXPECT_NEAR(trim[kRoll], expected[kRoll], 1e-6);
  EXPECT_NEAR(trim[kPitch], expected[kPitch], 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Mss, Reference,
    testing::Values(Run{"straight", payload(25.0), {}}, Run{"turn", payload(25.0), {}},
                    Run{"current", payload(25.0), {0.5, kPi / 3.0}},
                    Run{"reverse", payload(25.0), {}}, Run{"spin_payload_45", payload(45.0), {}},
                    Run{"astern_left_empty", payload(0.0), {}},
                    Run{"current_side_payload", payload(20.0, {0.2, 0.15, -0.3}), {0.8, -2.0}}));

}  // namespace
}  // namespace otter_nav::plant
