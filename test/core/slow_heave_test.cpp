// Motion that excites the stiffness and hardly the damping.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "driven_strut.h"

namespace suspension_health_monitor {
namespace {

// Drives, rests and then heaves at 0.6 rad/s, a tenth of a cycle per block, with a spring that has lost a fifth. There
// the stiffness' regressor stands 2.9 / 0.6 = 5 times further out of the noise than the damping's.
struct SlowHeave {
  explicit SlowHeave(double amplitude, std::uint64_t seed = 11) : strut(liveOptions(), seed) {
    strut.drive(2000, roadBetween(0.0, 1e9));
    strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
    damping_before = strut.la().damping_to_mass;
    strut.noise = 0.006;
    strut.b0 = kLeft * kB0;
    const double start = strut.time();
    for (int k = 0; k < kSeconds; ++k) {
      strut.drive(
          50, [=](double t) { return amplitude * std::min(1.0, (t - start) / 30.0) * std::sin(0.6 * (t - start)); });
      const StrutEstimate& now = strut.estimate();
      if (!now.valid()) continue;
      const double damping_off = std::abs(now.damping_to_mass - kB1) / now.damping_to_mass_stddev;
      worst_damping = std::max(worst_damping, damping_off);
    }
  }

  static constexpr int kSeconds = 300;
  static constexpr double kLeft = 0.8;

  DrivenStrut strut;
  double damping_before;
  double worst_damping = 0.0;  // error of a valid one, in standard deviations
};

TEST(SlowHeave, LeavesTheDampingWhatItWas) {
  const SlowHeave heave(0.9);
  EXPECT_NEAR(heave.strut.la().damping_to_mass / heave.damping_before, 1.0, 0.05);
  EXPECT_LT(heave.worst_damping, 4.0);
}

TEST(SlowHeave, AtTheEdgeOfExcitationTheDampingKnowsHowUncertainItIs) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) EXPECT_LT(SlowHeave(1.3, seed).worst_damping, 4.0) << seed;
}

}  // namespace
}  // namespace suspension_health_monitor
