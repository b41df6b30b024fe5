#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "driven_mass.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {
namespace {

constexpr double kRate = 100.0, kCutOff = 5.0;  // [Hz]
constexpr int kReach = 12;

/// A sinc under Hann's window, of gain 1 at 0 Hz.
std::vector<double> taps() {
  std::vector<double> h;
  double sum = 0.0;
  for (int k = -kReach; k <= kReach; ++k) {
    const double x = 2.0 * M_PI * kCutOff * k / kRate;
    h.push_back((k == 0 ? 1.0 : std::sin(x) / x) * (0.5 + 0.5 * std::cos(M_PI * k / (kReach + 1))));
    sum += h.back();
  }
  for (double& each : h) each /= sum;
  return h;
}

std::vector<double> column(const Drive& drive, double CornerSample::*value) {
  std::vector<double> values;
  for (const CornerSample& sample : drive.samples) values.push_back(sample.*value);
  return values;
}

/// Both signals filtered, and the wheel's kept as it was.
Drive behindFilter(Drive drive) {
  drive.low_pass = {taps(), column(drive, &CornerSample::unsprung_acceleration)};
  std::vector<double> sprung = column(drive, &CornerSample::sprung_acceleration), unsprung = drive.low_pass.unfiltered;
  passLow(drive.low_pass.taps, sprung);
  passLow(drive.low_pass.taps, unsprung);
  for (std::size_t k = 0; k < drive.samples.size(); ++k) {
    drive.samples[k].sprung_acceleration = sprung[k];
    drive.samples[k].unsprung_acceleration = unsprung[k];
  }
  return drive;
}

TEST(LowPassed, IsTheSumOverTheTapsAndItsEndsGoOn) {
  EXPECT_EQ(lowPassed({}, Eigen::Vector3d(1.0, 2.0, 4.0)), Eigen::Vector3d(1.0, 2.0, 4.0));
  const Eigen::VectorXd passed = lowPassed({0.25, 0.5, 0.25}, Eigen::Vector4d(1.0, 2.0, 4.0, 8.0));
  EXPECT_TRUE(passed.isApprox(Eigen::Vector4d(1.25, 2.25, 4.5, 7.0), 1e-15)) << passed.transpose();
}

// H(f) = h_0 + 2 sum_k h_k cos(2 pi f k T), and no delay.
TEST(LowPassed, HasTheGainOfItsTapsAndNoDelay) {
  const std::vector<double> h = taps();
  for (const double frequency : {1.0, 8.0, 13.0}) {
    const double w = 2.0 * M_PI * frequency / kRate;
    double gain = h[kReach];
    for (int k = 1; k <= kReach; ++k) gain += 2.0 * h[static_cast<std::size_t>(kReach + k)] * std::cos(w * k);
    std::vector<double> signal;
    for (int k = 0; k < 200; ++k) signal.push_back(std::sin(w * k + 0.3));
    const std::vector<double> before = signal;
    passLow(h, signal);
    for (std::size_t k = kReach; k < 200 - kReach; ++k) ASSERT_NEAR(signal[k], gain * before[k], 1e-12);
  }
}

TEST(DriveRecord, BehindAFilterIsDrivenByTheWheelBeforeItAndLosesWhatTheFilterReachesOver) {
  constexpr double kOmega = 2.0 * M_PI * 5.0;  // 20 samples a period
  Drive drive;
  for (int k = 0; k < 400; ++k) {
    drive.samples.push_back({fromSeconds(k / kRate), 3.0 + k, 9.81 + (k % 2 == 0 ? 0.1 : -0.1)});
    drive.low_pass.unfiltered.push_back(9.81 + std::sin(kOmega * k / kRate));
  }
  drive.low_pass.taps = taps();
  const DriveRecord record(drive, 1.0 / kRate, 1);
  constexpr int kFirst = kInterpolationReach + kReach;
  ASSERT_EQ(record.segments().size(), 1u);
  const DriveSegment& segment = record.segments().front();
  ASSERT_EQ(segment.size(), 400u - 2 * kFirst);
  EXPECT_EQ(segment.lead(), std::size_t{kReach});
  EXPECT_NEAR(segment.start, kFirst / kRate, 1e-9);
  EXPECT_EQ(segment.stamps.front(), fromSeconds(kFirst / kRate));
  EXPECT_NEAR(segment.sprung.front(), 3.0 + kFirst - 9.81, 1e-9);
  EXPECT_NEAR(segment.unsprung.front(), kFirst % 2 == 0 ? 0.1 : -0.1, 1e-9);
  EXPECT_NEAR(segment.driving.front(), std::sin(kOmega * kFirst / kRate), 1e-9);
  ASSERT_EQ(segment.wheel.size(), segment.size() + 2 * kReach - 1);
  for (std::size_t k = 0; k < segment.wheel.size(); ++k) {
    const double from = segment.start + (static_cast<double>(k) - kReach) / kRate, to = from + 1.0 / kRate;
    EXPECT_NEAR(segment.wheel[k].end_velocity, (std::cos(kOmega * from) - std::cos(kOmega * to)) / kOmega, 1e-6);
  }
}

// A wheel that hops beyond the filter decides what a kinked law does to the body: behind the filter it cannot be seen
// what the law saw. Where the wheel is known as it was before, law, coefficient and shape are the true ones.
TEST(Diagnosis, BehindAFilterFindsTheLawAsItIs) {
  constexpr double kB1 = 5.0, kB0 = 70.0, kFriction = 0.8, kSlip = 0.03;
  const BandNoise road(3, 0.5, 3.0, 0.7), hop(4, 10.0, 14.0, 10.0);
  const DrivenMass strut{
      kRate, [&](double t) { return road(t) + hop(t); },
      [](const MassState& x, double) { return kB1 * x.v + kB0 * x.d + kFriction * std::tanh(x.v / kSlip); },
      [](const MassState&) { return 0.0; }, 0.02};
  const Drive drive = behindFilter(strut.drive(6000));
  DiagnoseOptions options;
  options.sample_period = 1.0 / kRate;
  const Diagnosis found = diagnose({drive}, options);
  ASSERT_EQ(found.selected, std::vector<std::string>{"coulomb_friction"}) << found.summary << found.reason;
  ASSERT_TRUE(found.final_fit);
  const StrutModel& model = found.final_fit->model;
  const std::vector<double>& stddev = found.final_fit->stddev;
  EXPECT_NEAR(model.damping_to_mass, kB1, std::max(0.01 * kB1, 3.0 * stddev[0]));
  EXPECT_NEAR(model.stiffness_to_mass, kB0, std::max(0.01 * kB0, 3.0 * stddev[1]));
  EXPECT_NEAR(model.effects[0].coefficient, kFriction, std::max(0.03 * kFriction, 3.0 * stddev[2]));
  EXPECT_LT(stddev[2], 0.05 * kFriction);

  Drive forgotten = drive;
  forgotten.low_pass = {};
  const Diagnosis without = diagnose({forgotten}, options);
  ASSERT_TRUE(without);
  EXPECT_TRUE(without.selected != found.selected ||
              std::abs(without.final_fit->model.effects[0].coefficient - kFriction) > 0.1 * kFriction)
      << "the filter does nothing here: the test shows nothing";
}

}  // namespace
}  // namespace suspension_health_monitor
