// What sampling loses of a model's own forces: nothing of linear ones; of dry friction where between two samples it
// turned.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "driven_mass.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01, kB1 = 6.0, kB0 = 63.0;

DriveRecord drivenBy(double friction) {
  const DrivenMass strut{1.0 / kPeriod, BandNoise(1, 0.3, 8.0, 3.0), [=](const MassState& x, double) {
                           return kB1 * x.v + kB0 * x.d + friction * std::tanh(x.v / 1e-3);
                         }};
  return {strut.drive(6000), kPeriod, 4};
}

double lost(const DriveRecord& record, const StrutModel& model) {
  const FitOutcome run = withoutFit({&record}, model);
  EXPECT_TRUE(run);
  return run ? lostInSampling({&record}, *run) : std::nan("");
}

StrutModel withFriction(double coefficient) {
  return {kB1, kB0, {{findEffect(forceEffects(), "coulomb_friction"), coefficient, {1e-3}}}, {}};
}

TEST(LostInSampling, IsNothingOfALinearStrut) {
  const DriveRecord record = drivenBy(0.0);
  EXPECT_LT(lost(record, {kB1, kB0, {}, {}}), 1e-4);  // of 3 m/s^2: the interpolation ends at 16 samples
}

// A reading just before or just after a turn lies between one of -c and one of +c: whether the turn came before it or
// after it, nobody can tell, so that an error of c is left in two readings a turn.
TEST(LostInSampling, IsTheTurnsOfDryFriction) {
  constexpr double c = 0.5;
  const DriveRecord record = drivenBy(c);
  std::vector<double> predicted;
  std::vector<StrutState> motion;
  ASSERT_TRUE(runFree(withFriction(c), record.segments().front(), {}, predicted, &motion));
  double turns = 0.0;
  for (std::size_t k = 1; k < motion.size(); ++k)
    turns += motion[k].travel_rate * motion[k - 1].travel_rate < 0.0 ? 1.0 : 0.0;
  const double of_body = c * std::sqrt(2.0 * turns / static_cast<double>(motion.size()));
  const double of_both = of_body * std::sqrt(1.0 + kPeriod * (kB1 * kB1 + kB0) / (2.0 * kB1));
  EXPECT_NEAR(lost(record, withFriction(c)) / of_both, 1.0, 0.25);
  EXPECT_NEAR(lost(drivenBy(2.0 * c), withFriction(2.0 * c)) / lost(record, withFriction(c)), 2.0, 0.5);
}

}  // namespace
}  // namespace suspension_health_monitor
