// What gravity makes of faults of a sensor, and of a body that leans.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "driven_mass.h"
#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {
namespace {

using Names = std::vector<std::string>;

constexpr double kGravity = 9.81, kRate = 100.0;

DrivenMass strut() {
  DrivenMass mass{kRate, BandNoise(3, 0.3, 12.0, 3.0),
                  [](const MassState& x, double) { return 4.0 * x.v + 40.0 * x.d; }};
  mass.noise = 0.03;
  return mass;
}

/// @param body, wheel  what the sensors make of an acceleration that has gravity in it.
Drive readBy(const std::function<double(double)>& body, const std::function<double(double)>& wheel,
             const DrivenMass& mass = strut()) {
  Drive drive = mass.drive(9000);
  for (CornerSample& sample : drive.samples) {
    sample.sprung_acceleration = body(sample.sprung_acceleration + kGravity);
    sample.unsprung_acceleration = wheel(sample.unsprung_acceleration + kGravity);
  }
  return drive;
}

double rightly(double reading) { return reading; }

Diagnosis diagnosed(const Drive& drive) {
  Diagnosis found = diagnose({drive});
  EXPECT_TRUE(found) << found.reason;
  return found;
}

TEST(GravityInReadings, TellsAGainFromAnOffset) {
  constexpr double kError = 0.06;
  const Diagnosis of_body = diagnosed(readBy([](double reading) { return (1.0 + kError) * reading; }, rightly));
  EXPECT_EQ(of_body.verdict, Verdict::kEffectFound);
  ASSERT_EQ(of_body.selected, Names{"scale_error"});
  EXPECT_NEAR(of_body.model().reading.at(0).coefficients.at(0), kError, 0.001);

  const Diagnosis of_wheel = diagnosed(readBy(rightly, [](double reading) { return (1.0 - kError) * reading; }));
  EXPECT_EQ(of_wheel.verdict, Verdict::kEffectFound);
  ASSERT_EQ(of_wheel.selected, Names{"scale_error"});
  ASSERT_EQ(of_wheel.indistinguishable.size(), 1U);  // a tilt reads its cosine of everything, as a gain does
  EXPECT_EQ(of_wheel.indistinguishable[0], (Names{"scale_error", "mount_tilt"}));
  EXPECT_NEAR(of_wheel.model().reading.at(0).coefficients.at(0), 1.0 / (1.0 - kError) - 1.0, 0.001);
}

TEST(GravityInReadings, AnOffsetMayBeATilt) {
  const Diagnosis found = diagnosed(readBy([](double reading) { return reading - 0.1; }, rightly));
  EXPECT_EQ(found.verdict, Verdict::kEffectFound);
  ASSERT_EQ(found.selected, Names{"accelerometer_bias"});
  EXPECT_NEAR(found.model().reading.at(0).coefficients.at(0), -0.1, 0.002);
  ASSERT_EQ(found.indistinguishable.size(), 1U);
  EXPECT_EQ(found.indistinguishable[0], (Names{"accelerometer_bias", "mount_tilt"}));
  EXPECT_NE(found.suggested_drive.find("level ground"), std::string::npos) << found.suggested_drive;
}

TEST(GravityInReadings, WithoutItAnOffsetIsNoTilt) {
  Drive drive = strut().drive(9000);
  for (CornerSample& sample : drive.samples) sample.sprung_acceleration -= 0.1;
  const Diagnosis found = diagnosed(drive);
  EXPECT_EQ(found.selected, Names{"accelerometer_bias"});
  EXPECT_TRUE(found.indistinguishable.empty());
}

FitFailure failureOfOffset(const Diagnosis& found) {
  for (const RankedModel& model : found.ranking)
    if (model.effects == Names{"accelerometer_bias"}) return model.failure;
  ADD_FAILURE() << "an offset was not tried";
  return FitFailure::kNone;
}

/// A body that rolls slowly, by 3.4 degrees rms, and an offset.
Drive leaning(double offset) {
  DrivenMass mass = strut();
  const BandNoise roll(9, 0.05, 0.5, 0.06);
  mass.sensed = [=](double t) { return offset - kGravity * (1.0 - std::cos(roll(t))); };
  return readBy(rightly, rightly, mass);
}

TEST(GravityInReadings, ABodyThatLeansIsNoOffset) {
  const Diagnosis found = diagnosed(leaning(0.0));
  EXPECT_EQ(found.verdict, Verdict::kUnexplained);
  EXPECT_TRUE(found.selected.empty());
  EXPECT_EQ(failureOfOffset(found), FitFailure::kWanders);
  EXPECT_NE(found.suggested_drive.find("leans"), std::string::npos) << found.suggested_drive;
}

TEST(GravityInReadings, AnOffsetOfABodyThatLeansIsOne) {
  for (const double offset : {-0.3, 0.3}) {
    const Diagnosis found = diagnosed(leaning(offset));
    EXPECT_EQ(found.selected, Names{"accelerometer_bias"});
    // 90 s of a band of 0.45 Hz tell the mean square of the roll to sqrt(2 / 81) of it: 0.0028 m/s^2 of what it leans.
    EXPECT_NEAR(found.model().reading.at(0).coefficients.at(0), offset - 0.5 * kGravity * 0.06 * 0.06, 4.0 * 0.0028);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
