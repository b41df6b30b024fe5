#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/signal/filters.h"
#include "suspension_health_monitor/internal/signal/tuning.h"

namespace suspension_health_monitor {
namespace {

constexpr Stamp kPeriod = std::chrono::milliseconds(10);
constexpr double kT = 0.01;

int delay() {
  static const int delay = MotionFilter(kPeriod, 1, 1).delay();
  return delay;
}

struct Output {
  double value, rate;
};

/// @return the filtered signal and its filtered derivative, at delay .. signal.size() - 1 - delay.
std::vector<Output> filtered(const std::vector<double>& signal) {
  MotionFilter filter(kPeriod, 1, 1);
  std::vector<Output> outputs;
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const MotionFilter::Instant* instant = filter.push(static_cast<int>(k) * kPeriod, {signal[k], signal[k]});
    if (instant == nullptr) continue;
    EXPECT_EQ(instant->stamp, (static_cast<int>(k) - filter.delay()) * kPeriod);
    outputs.push_back({instant->values[0], instant->rates[0]});
  }
  return outputs;
}

/// Of the filters, from their answer to a pulse at kDelay.
struct Response {
  double low_pass, derivative;  // H, and what j 2 pi f H is to be divided by j [1/s]; of even and odd parts
  double low_pass_odd, derivative_even;
};
Response responseAt(double frequency) {
  static const std::vector<Output> answer = [] {
    const auto late_by = static_cast<std::size_t>(delay());
    std::vector<double> pulse(6 * late_by + 1, 0.0);
    pulse[3 * late_by] = 1.0;
    return filtered(pulse);
  }();
  Response response{};
  for (std::size_t k = 0; k < answer.size(); ++k) {
    const double late = static_cast<double>(k) - 2.0 * delay();  // by how much, in samples
    const double angle = 2.0 * M_PI * frequency * late;
    response.low_pass += answer[k].value * std::cos(angle);
    response.low_pass_odd += answer[k].value * std::sin(angle);
    response.derivative -= answer[k].rate * std::sin(angle);
    response.derivative_even += answer[k].rate * std::cos(angle);
  }
  return response;
}

TEST(MotionFilter, IsFlatThenStopsAndDelaysByWholeSamples) {
  const MotionFilter filter(kPeriod, 1, 1);
  for (int i = 0; i <= 500; ++i) {
    const double frequency = 0.001 * i;
    const Response response = responseAt(frequency);
    const bool passes = frequency <= filter.flat() * kT, stops = frequency >= filter.stop() * kT;
    if (passes || stops) {
      EXPECT_NEAR(response.low_pass, passes ? 1.0 : 0.0, 1e-3) << frequency;
    }
    EXPECT_NEAR(response.low_pass_odd, 0.0, 1e-14) << frequency;
    EXPECT_NEAR(response.derivative_even, 0.0, 1e-12) << frequency;
  }
}

TEST(MotionFilter, DifferentiatesWhatTheLowPassFilterLeavesAtAllFrequencies) {
  for (int i = 0; i <= 500; ++i) {
    const double frequency = 0.001 * i;
    const Response response = responseAt(frequency);
    EXPECT_NEAR(kT * response.derivative, 2.0 * M_PI * frequency * response.low_pass, 1e-4) << frequency;
  }
}

TEST(MotionFilter, PassesGravityAndTheRateOfARamp) {
  std::vector<double> signal;
  for (int k = 0; k < 60; ++k) signal.push_back(9.81 + 3.0 * kT * k);
  auto k = static_cast<std::size_t>(delay());
  for (const Output& output : filtered(signal)) {
    EXPECT_NEAR(output.value, signal[k], 1e-12);
    EXPECT_NEAR(output.rate, 3.0, 1e-11);
    ++k;
  }
}

// A motion and its derivative, both in closed form: the sign, the unit and the instant.
TEST(MotionFilter, GivesASineAndItsDerivativeAtTheInstantOfTheStamp) {
  const double frequency = 2.0 * M_PI * 12.0;
  MotionFilter filter(kPeriod, 1, 1);
  int instants = 0;
  for (int k = 0; k < 200; ++k) {
    const double sine = std::sin(frequency * kT * k);
    const MotionFilter::Instant* instant = filter.push(k * kPeriod, {sine, sine});
    if (instant == nullptr) continue;
    const double t = toSeconds(instant->stamp);
    EXPECT_NEAR(instant->values[0], std::sin(frequency * t), 1e-3);
    EXPECT_NEAR(instant->rates[0], frequency * std::cos(frequency * t), 1e-3 * frequency);
    ++instants;
  }
  EXPECT_EQ(instants, 200 - 2 * filter.delay());
}

// The same band in Hz, however fast the sampling: a gyro's noise does not grow with the rate. Slow sampling ends it.
TEST(MotionFilter, HasItsBandInHertz) {
  for (const int microseconds : {1000, 2500, 5000, 10000}) {
    const MotionFilter filter(std::chrono::microseconds(microseconds), 1, 1);
    EXPECT_EQ(filter.flat(), kSignalTuning.body_band);
    EXPECT_NEAR(filter.delay() * 1e-6 * microseconds, 0.19, 0.01) << microseconds;  // 12 * 0.24 / 15 Hz
  }
  const MotionFilter slow(std::chrono::milliseconds(20), 1, 1);
  EXPECT_NEAR(slow.flat(), 0.24 * 50.0, 1e-12);
  EXPECT_EQ(slow.delay(), 12);

  MotionFilter fast(std::chrono::milliseconds(1), 1, 1);
  const double within = 2.0 * M_PI * 12.0, beyond = 2.0 * M_PI * 40.0;
  for (int k = 0; k < 2000; ++k) {
    const double t = 1e-3 * k, sine = std::sin(within * t) + std::sin(beyond * t);
    const MotionFilter::Instant* instant = fast.push(k * std::chrono::milliseconds(1), {sine, sine});
    if (instant == nullptr) continue;
    const double at = toSeconds(instant->stamp);
    EXPECT_NEAR(instant->values[0], std::sin(within * at), 3e-3);
    EXPECT_NEAR(instant->rates[0], within * std::cos(within * at), 3e-3 * beyond);
  }
}

TEST(MotionFilter, FillsAnewAfterAGapAndLeavesOutWhatComesTooSoon) {
  MotionFilter filter(kPeriod, 1, 0);
  const auto push = [&](int milliseconds, double value) {
    const MotionFilter::Instant* instant = filter.push(std::chrono::milliseconds(milliseconds), {value});
    return instant == nullptr ? std::nullopt : std::optional<double>(instant->values[0]);
  };
  const int fill = 2 * filter.delay();
  for (int k = 0; k < fill; ++k) EXPECT_FALSE(push(10 * k, 1.0));
  EXPECT_TRUE(push(10 * fill, 1.0));
  EXPECT_FALSE(push(10 * fill + 4, 100.0));
  EXPECT_NEAR(push(10 * fill + 10, 1.0).value(), 1.0, 1e-12);
  const int later = 10 * fill + 30;
  for (int k = 0; k < fill; ++k) EXPECT_FALSE(push(later + 10 * k, 2.0));
  EXPECT_NEAR(push(later + 10 * fill, 2.0).value(), 2.0, 1e-12);
  EXPECT_FALSE(push(5, 3.0));  // the clock went back
}

}  // namespace
}  // namespace suspension_health_monitor
