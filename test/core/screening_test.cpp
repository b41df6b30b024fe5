#include "suspension_health_monitor/internal/search/screening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "hidden_effect.h"
#include "recorded_drive.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"
#include "suspension_health_monitor/internal/record/motion.h"

namespace suspension_health_monitor {
namespace {

constexpr double kB1 = 6.0, kB0 = 63.3;                // of the reference car
constexpr double kTravel = 0.008, kTravelRate = 0.19;  // its rms on the road of these tests

std::vector<double> middleShapes(const ForceEffect& effect) {
  const MotionScale scale{kTravel, kTravelRate, 1.0 / std::sqrt(kB0)};
  std::vector<double> shapes;
  for (const ShapeParameter& shape : effect.shapes)
    shapes.push_back(scale.unit(shape.scale) * std::sqrt(shape.min * shape.max));
  return shapes;
}

double rms(const std::vector<double>& values) {
  double square = 0.0;
  for (const double value : values) square += value * value;
  return std::sqrt(square / static_cast<double>(values.size()));
}

ModelFit fitOf(const DriveRecord& record, const std::vector<SampleMask>& masks = {}) {
  const auto fit = fitOutputError({&record}, masks, {kB1, kB0, {}, {}});
  EXPECT_TRUE(fit);
  return fit.value_or(ModelFit{});
}

class EveryForceEffect : public testing::TestWithParam<std::string> {};

// The response is the derivative of the free run with respect to the coefficient: here against a difference quotient of
// two nonlinear runs, which follow the wheel between the samples more closely.
TEST_P(EveryForceEffect, RespondsAsTheFreeRunDoesToASmallCoefficient) {
  const DriveRecord record = recorded(carDrive(20.0, 0.0));
  const DriveSegment& segment = record.segments().front();
  const ModelFit fit = fitOf(record);
  const LinearResponse response({&record}, fit);
  const ForceEffect& effect = findEffect(forceEffects(), GetParam());
  const Eigen::VectorXd force = forceAlong(effect, middleShapes(effect), response.motion());
  const Eigen::VectorXd expected = response.respond(force);
  StrutModel model = fit.model;
  const double small = 1e-4 * rms(segment.sprung) / std::sqrt(force.squaredNorm() / static_cast<double>(force.size()));
  model.effects = {{effect, small, middleShapes(effect)}};
  std::vector<double> with, against;  // the same steps in both: a memory may ask for more of them than the plain strut
  ASSERT_TRUE(runFree(model, segment, fit.initial[0], with));
  model.effects[0].coefficient = -small;
  ASSERT_TRUE(runFree(model, segment, fit.initial[0], against));
  double error = 0.0, size = 0.0;
  for (std::size_t k = 0; k < with.size(); ++k) {
    const double slope = (with[k] - against[k]) / (2.0 * small);
    error += std::pow(slope - expected[static_cast<Eigen::Index>(k)], 2);
    size += slope * slope;
  }
  EXPECT_LT(std::sqrt(error / size), 0.1);  // friction turns within a sample; the others stay below 0.05
}

std::vector<std::string> forceNames() {
  std::vector<std::string> names;
  for (const ForceEffect& effect : forceEffects()) names.push_back(effect.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryForceEffect, testing::ValuesIn(forceNames()),
                         [](const auto& test) { return test.param; });

class ScreenedDrive {
 public:
  explicit ScreenedDrive(const SimulationOptions& options)
      : record_(recorded(options)),
        records_{&record_},
        held_out_(*splitHoldOut(records_, kB0)),
        fit_(fitOf(record_, held_out_.training)) {}

  Screening screening() const { return {records_, held_out_, fit_}; }
  double error() const { return held_out_.rmse(fit_.residuals); }
  double error(const ScreenedModel& screened) const { return held_out_.rmse(screened.residuals); }

 private:
  DriveRecord record_;
  std::vector<const DriveRecord*> records_;
  HoldOut held_out_;
  ModelFit fit_;
};

TEST(Screening, GuessesCoefficientAndShapeOfAHiddenStop) {
  SimulationOptions options = carDrive(60.0, 0.02);
  options.hidden = {hiddenEffect(options, "bump_stop", {0.01}, 0.1)};
  const ScreenedDrive drive(options);
  const auto stop = drive.screening().screen(findEffect(forceEffects(), "bump_stop"));
  const auto drift = drive.screening().screen(findEffect(forceEffects(), "damping_drift"));
  ASSERT_TRUE(stop && drift);
  const ActiveEffect& guess = stop->model.effects.at(0);
  EXPECT_NEAR(guess.coefficient, options.hidden[0].coefficient, 0.4 * options.hidden[0].coefficient);
  EXPECT_NEAR(guess.shapes.at(0), 0.01, 0.004);
  EXPECT_GT(stop->training_gain, 10.0 * drift->training_gain);
  EXPECT_LT(drive.error(*stop), 0.6 * drive.error());
  EXPECT_GT(drive.error(*drift), 0.9 * drive.error());
}

TEST(Screening, AnEffectThatNeverActsIsNoCandidate) {
  const ScreenedDrive drive(carDrive(30.0, 0.02));
  const ForceEffect silent{"silent", "c 0", "-", "", "", [](const StrutMotion&, const double*) { return 0.0; }};
  const ForceEffect linear{"linear", "c d", "1/s^2",
                           "",       "",    [](const StrutMotion& m, const double*) { return m.travel; }};
  EXPECT_FALSE(drive.screening().screen(silent));
  EXPECT_FALSE(drive.screening().screen(linear));  // the model's spring does that already
}

TEST(Screening, AFreeFormSurfaceTakesWhatIsALawOfTravelAndRateAndNothingElse) {
  SimulationOptions options = carDrive(120.0, 0.02);
  ForceEffect law{"product", "c d v", "1/(m s)",
                  "",        "",      [](const StrutMotion& m, const double*) { return m.travel * m.travel_rate; }};
  options.hidden = {{law, 0.15 * 0.9 / (kTravel * kTravelRate), {}}};
  EXPECT_GT(ScreenedDrive(options).screening().surfaceGain(), 0.7);
  law.force = [](const StrutMotion& m, const double*) { return std::sin(7.0 * m.time); };
  options.hidden = {{law, 0.2, {}}};
  EXPECT_LT(ScreenedDrive(options).screening().surfaceGain(), 0.1);
}

}  // namespace
}  // namespace suspension_health_monitor
