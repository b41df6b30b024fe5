// Motion that excites the stiffness and hardly the damping.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "driven_strut.h"

namespace suspension_health_monitor {
namespace {

// Drives, rests and then heaves at 0.6 rad/s with a spring that has lost a fifth. There the stiffness' regressor stands
// 2.9 / 0.6 = 5 times further out of the noise than the damping's.
struct SlowHeave {
  explicit SlowHeave(double amplitude, std::uint64_t seed = 11) : strut(liveOptions(), seed) {
    strut.drive(2000, roadBetween(0.0, 1e9));
    strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
    damping_before = strut.la().damping_to_mass;
    strut.noise = 0.006;
    strut.b0 = kLeft * kB0;
    const double start = strut.time();
    held = strut.drive(
        kRows, [=](double t) { return amplitude * std::min(1.0, (t - start) / 30.0) * std::sin(0.6 * (t - start)); });
  }

  static constexpr int kRows = 15000;
  static constexpr double kLeft = 0.8;

  DrivenStrut strut;
  double damping_before;
  int held;
};

// The damping's excitation is 2.5. On 40 other seeds: held in 99.5 % of the rows (quartiles 99.1, 99.6, least 96.9);
// the damping moves by 0.1 % (quartiles 0.06, 0.2, most 3.8); the stiffness scatters by 4.4 %, of which the bound is
// three.
TEST(Excitation, OfSlowHeaveReachesTheStiffnessOnlyAndLeavesTheDampingWhatItWas) {
  const SlowHeave heave(0.9);
  EXPECT_GT(heave.held, SlowHeave::kRows * 0.96);
  EXPECT_NEAR(heave.strut.la().stiffness_to_mass / (SlowHeave::kLeft * kB0), 1.0, 0.13);
  EXPECT_NEAR(heave.strut.la().damping_to_mass / heave.damping_before, 1.0, 0.05);
}

// Of 1.3 m it is about the 4.5 from which on rows count, and noise pulls the damping down by a third in the tenth of
// the rows that do: its standard deviation says so. On 40 other seeds it is 0.9 of them too small, and scatters by 0.6.
TEST(Excitation, AtTheEdgeOfExcitationTheDampingKnowsHowUncertainItIs) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const StrutEstimate la = SlowHeave(1.3, seed).strut.la();
    const double error = la.damping_to_mass - kB1;
    EXPECT_LT(std::abs(error), 3.5 * la.damping_to_mass_stddev) << seed;  // 4 scatters from the mean
    EXPECT_LT(la.damping_to_mass_stddev, kB1) << seed;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
