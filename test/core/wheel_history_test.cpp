#include "suspension_health_monitor/internal/identification/wheel_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace suspension_health_monitor {
namespace {

constexpr double kReach = 0.015;
using Complex = std::complex<double>;

// w'' = exp(i omega t): I_r^2 w'' is w'' times (1 - exp(-i omega h))^2 / (i omega)^(2 - r), at any time.
TEST(WheelHistory, GivesTheRowsOfASineBetweenSamples) {
  for (const double period : {0.01, 0.005, 0.002})
    for (const double omega : {8.0, 70.0}) {
      const IntegralFilterOptions options{static_cast<int>(std::lround(0.6 / period)), period,
                                          IntegrationRule::kBandLimited};
      WheelHistory history(options, kReach);
      int last = 0;
      for (; last < 4 * options.horizon_samples || !history.full(); ++last)
        history.push(std::cos(omega * last * period));
      const Complex s(0.0, omega), ends = std::pow(1.0 - std::exp(-s * 0.6), 2);
      const double row = (last - 1 - 2 * HorizonIntegral::lateness(options.rule) - history.delay()) * period;
      for (const double shift : {-0.015, -0.0042, 0.0, 0.001, 0.0077, 0.015}) {
        SCOPED_TRACE(testing::Message() << period << " s, " << omega << " rad/s, " << shift << " s");
        const WheelRow found = history.at(history.place(shift));
        const Complex expected = ends * std::exp(s * (row + shift));
        const double most = 0.012 * std::abs(ends);
        EXPECT_NEAR(found.stiffness, std::real(expected / s / s), most / omega / omega);
        EXPECT_NEAR(found.damping, std::real(expected / s), most / omega);
        EXPECT_NEAR(found.output, std::real(expected), std::pow(omega * period, 2) / 8.0 * std::abs(ends) + 1e-12);
      }
    }
}

TEST(WheelHistory, IsFullWhenAllThatMayBeAskedForIsKnown) {
  constexpr IntegralFilterOptions kOptions{30, 0.01, IntegrationRule::kBandLimited};
  WheelHistory history(kOptions, kReach);
  EXPECT_GE(history.delay() * kOptions.period, kReach);
  for (const int round : {0, 1}) {
    SCOPED_TRACE(round);
    for (int k = 1; k < LinearIntegralFilter::window(2, kOptions) + 2 * history.delay(); ++k) {
      history.push(1.0);
      EXPECT_FALSE(history.full());
    }
    history.push(1.0);
    EXPECT_TRUE(history.full());
    history.reset();
  }
}

}  // namespace
}  // namespace suspension_health_monitor
