// Forgetting only where there is information: parked for a day, driven on; slow heave that excites the stiffness only.
#include "suspension_health_monitor/identification/excitation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/pi.h"
#include "suspension_health_monitor/simulation/road.h"
#include "suspension_health_monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.02;  // [s]
constexpr double kB1 = 3.0, kB0 = 13.8;
constexpr int kDay = 24 * 3600;  // rows, at one a second instead of 50: the law counts rows

// A strut over a wheel whose height is given, and sensors with noise.
class Strut {
 public:
  explicit Strut(const MonitorOptions& options) : monitor_(options) {}

  double b1 = kB1, b0 = kB0, noise = 0.024;

  /// @param height  w(t) [m].
  /// @return rows at which LA was held, wholly or in part.
  int drive(int samples, const std::function<double(double)>& height) {
    constexpr int kSteps = 10;
    constexpr double h = kPeriod / kSteps;
    int held = 0;
    for (int k = 0; k < samples; ++k) {
      double wheel = 0.0, body = 0.0;
      for (int step = 0; step < kSteps; ++step) {
        const double before = height(t_ - h), now = height(t_), after = height(t_ + h);
        wheel = (after - 2.0 * now + before) / (h * h);
        body = b1 * ((after - before) / (2.0 * h) - v_) + b0 * (now - z_);
        if (step + 1 == kSteps) break;
        advance(body, h);
      }
      held += add(body, wheel) ? 1 : 0;
      advance(body, h);
    }
    return held;
  }

  /// At rest: nothing but noise.
  int park(int samples) {
    int held = 0;
    for (int k = 0; k < samples; ++k) held += add(0.0, 0.0) ? 1 : 0;
    return held;
  }

  /// At rest, but for a reading.
  void read(double body, double wheel) { add(body, wheel); }

  /// At rest, with a body that the engine shakes.
  int idle(int samples, double amplitude, double frequency) {
    int held = 0;
    for (int k = 0; k < samples; ++k)
      held += add(amplitude * std::sin(2.0 * kPi * frequency * kPeriod * k), 0.0) ? 1 : 0;
    return held;
  }

  const StrutEstimate& la() const { return monitor_.report().la; }
  const StrutEstimate& ls() const { return monitor_.report().ls; }
  double time() const { return t_; }

 private:
  void advance(double body, double h) {
    v_ += h * body;
    z_ += h * v_;
    t_ += h;
  }

  bool add(double body, double wheel) {
    stamp_ += std::chrono::milliseconds(20);
    monitor_.addSample({stamp_, 9.81 + body + noise * normal_(engine_), 9.81 + wheel + noise * normal_(engine_)});
    const EstimateDoubt doubt = monitor_.report().la.doubt;
    return doubt == EstimateDoubt::kNotExcited || doubt == EstimateDoubt::kDampingNotExcited ||
           doubt == EstimateDoubt::kStiffnessNotExcited;
  }

  SuspensionMonitor monitor_;
  double z_ = 0.0, v_ = 0.0, t_ = 0.0;
  Stamp stamp_{};
  std::mt19937_64 engine_{11};
  std::normal_distribution<double> normal_;
};

// A rough road that begins and ends gently.
std::function<double(double)> roadBetween(double begin, double end) {
  return [=](double t) {
    if (t <= begin || t >= end) return 0.0;
    const double gentle = std::pow(std::sin(0.5 * kPi * std::min({1.0, (t - begin) / 3.0, (end - t) / 3.0})), 2);
    return gentle * (0.02 * std::sin(2.0 * kPi * 0.55 * t) + 0.01 * std::sin(2.0 * kPi * 1.3 * t + 1.0) +
                     0.006 * std::sin(2.0 * kPi * 2.7 * t + 2.0));
  };
}

void expectTrue(const StrutEstimate& estimate) {
  EXPECT_NEAR(estimate.damping_to_mass, kB1, 0.2);
  EXPECT_NEAR(estimate.stiffness_to_mass, kB0, 0.6);
}

TEST(Excitation, OfAParkedVehicleIsNoneSoThatADayChangesNothingAndTheNextDriveIsRightAtOnce) {
  Strut strut(liveOptions());
  strut.drive(2000, roadBetween(0.0, 1e9));
  ASSERT_TRUE(strut.la().valid);
  strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));  // it stops within 3 s and rests
  const StrutEstimate ls = strut.ls(), la = strut.la();
  EXPECT_EQ(la.doubt, EstimateDoubt::kNotExcited);
  EXPECT_LT(la.damping_excitation, 4.5);
  expectTrue(ls);
  expectTrue(la);
  EXPECT_GE(strut.park(kDay), kDay * 0.999);
  EXPECT_NEAR(strut.la().damping_to_mass, la.damping_to_mass, la.damping_to_mass_stddev);
  EXPECT_NEAR(strut.la().stiffness_to_mass, la.stiffness_to_mass, la.stiffness_to_mass_stddev);
  EXPECT_NEAR(strut.ls().damping_to_mass, ls.damping_to_mass, ls.damping_to_mass_stddev);
  EXPECT_NEAR(strut.ls().stiffness_to_mass, ls.stiffness_to_mass, ls.stiffness_to_mass_stddev);
  EXPECT_LT(strut.la().damping_to_mass_stddev, 2.0 * la.damping_to_mass_stddev);
  EXPECT_FALSE(strut.la().valid);
  const auto road = roadBetween(strut.time(), 1e9);
  for (int k = 0; k < 40; ++k) {  // 20 s
    strut.drive(25, road);
    expectTrue(strut.la());
  }
  EXPECT_TRUE(strut.la().valid);
  EXPECT_EQ(strut.la().doubt, EstimateDoubt::kNone);
}

// The paper's road, braked on from `stop` for `brake` seconds: the speed falls like a half cosine.
std::function<double(double)> paperRoadUntil(double stop, double brake) {
  return [=](double t) {
    const double x = std::clamp(t - stop, 0.0, brake);
    const double braking = 0.5 * x + 0.5 * brake / kPi * std::sin(kPi * x / brake);
    return paperRoad(std::min(t, stop) + braking).height;
  };
}

// In 5.5 hours at rest there are 15 000 blocks in which noise may look like a road by chance.
TEST(Excitation, HoursAfterAStopOnThePapersRoadTheEstimatesAreWhatTheyWere) {
  for (const double brake : {0.3, 3.0}) {
    Strut strut(liveOptions());
    const auto road = paperRoadUntil(57.0, brake);
    strut.drive(static_cast<int>((57.0 + brake) / kPeriod), road);
    const StrutEstimate stop = strut.la();
    ASSERT_TRUE(stop.valid) << brake;
    strut.drive(500, road);
    EXPECT_EQ(strut.la().doubt, EstimateDoubt::kNotExcited) << brake;
    constexpr int kHours = 1000000;
    EXPECT_EQ(strut.park(kHours), kHours) << brake;
    EXPECT_NEAR(strut.la().damping_to_mass, stop.damping_to_mass, 0.02 * stop.damping_to_mass) << brake;
    EXPECT_NEAR(strut.la().stiffness_to_mass, stop.stiffness_to_mass, 0.02 * stop.stiffness_to_mass) << brake;
    EXPECT_LT(strut.la().stiffness_to_mass_stddev, 0.1 * kB0) << brake;
  }
}

// One of a hundred times the noise every 20 s, on either side.
TEST(Excitation, WrongReadingsAtRestChangeNothing) {
  for (const bool of_body : {true, false}) {
    Strut strut(liveOptions());
    strut.drive(2000, roadBetween(0.0, 1e9));
    strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
    const StrutEstimate la = strut.la();
    ASSERT_EQ(la.doubt, EstimateDoubt::kNotExcited);
    for (int k = 0; k < 20; ++k) {
      strut.read(of_body ? 10.0 : 0.0, of_body ? 0.0 : 10.0);
      EXPECT_EQ(strut.park(1000), 1000);
    }
    EXPECT_EQ(strut.la().damping_to_mass, la.damping_to_mass);
    EXPECT_EQ(strut.la().stiffness_to_mass, la.stiffness_to_mass);
  }
}

TEST(Excitation, OfAnEngineThatIdlesIsNone) {
  Strut strut(liveOptions());
  strut.drive(2000, roadBetween(0.0, 1e9));
  strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
  const StrutEstimate la = strut.la();
  // That it starts to shake may be a road for two blocks.
  for (const double frequency : {3.0, 12.0, 22.0})
    EXPECT_GE(strut.idle(5000, 0.5, frequency), 5000 - 2 * 64) << frequency;
  EXPECT_NEAR(strut.la().damping_to_mass, la.damping_to_mass, 0.02 * kB1);
  EXPECT_NEAR(strut.la().stiffness_to_mass, la.stiffness_to_mass, 0.02 * kB0);
}

// Ten times: is right in the second half of every drive.
TEST(Excitation, StopAndGoEveryTenSeconds) {
  Strut strut(liveOptions());
  strut.drive(2000, roadBetween(0.0, 1e9));
  for (int k = 0; k < 10; ++k) {
    strut.park(500);
    EXPECT_EQ(strut.la().doubt, EstimateDoubt::kNotExcited) << k;
    const double start = strut.time();
    const auto road = roadBetween(start, start + 10.0);
    strut.drive(250, road);
    strut.drive(150, road);
    EXPECT_TRUE(strut.la().valid) << k;
    expectTrue(strut.la());
    strut.drive(100, road);
  }
}

// A drive of the strut b1, b0 on the paper's road, `smoother` times as smooth.
void follow(SuspensionMonitor& monitor, Stamp& stamp, double b1, double b0, double smoother, int& held) {
  SimulationOptions options;
  options.damping_ramp = false;
  options.damping_to_mass = b1;
  options.stiffness_to_mass = b0;
  options.duration = 60.0;
  options.noise = 0.0;
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0.0, 0.024);
  for (const CornerSample& sample : simulate(options)) {
    stamp += std::chrono::milliseconds(20);
    monitor.addSample({stamp, sample.sprung_acceleration / smoother + noise(engine),
                       sample.unsprung_acceleration / smoother + noise(engine)});
    const EstimateDoubt doubt = monitor.report().la.doubt;
    held += doubt == EstimateDoubt::kNotExcited || doubt == EstimateDoubt::kDampingNotExcited ||
                    doubt == EstimateDoubt::kStiffnessNotExcited
                ? 1
                : 0;
  }
}

TEST(Excitation, OfAStrutThatBreaksAsTheRoadGetsSmootherGoesOn) {
  struct Broken {
    double b1, b0;
  };
  for (const Broken broken : {Broken{0.3, kB0}, {kB1, 0.5 * kB0}, {0.3, 0.5 * kB0}}) {
    SuspensionMonitor monitor(liveOptions());
    Stamp stamp{};
    int held = 0;
    follow(monitor, stamp, kB1, kB0, 1.0, held);
    follow(monitor, stamp, broken.b1, broken.b0, 5.0, held);
    EXPECT_LT(held, 300) << broken.b1 << ", " << broken.b0;
    EXPECT_NEAR(monitor.report().la.damping_to_mass, broken.b1, 0.25);
    EXPECT_NEAR(monitor.report().la.stiffness_to_mass, broken.b0, 0.8);
  }
}

// What b1 makes of phi_1 is a sixth of the residual there.
TEST(Excitation, OfALightlyDampedStrutOnASmootherRoadGoesOn) {
  const double b1 = 2.0 * 0.02 * std::sqrt(kB0);
  SuspensionMonitor monitor(liveOptions());
  Stamp stamp{};
  int held = 0;
  follow(monitor, stamp, b1, kB0, 1.0, held);
  follow(monitor, stamp, b1, kB0, 10.0, held);
  EXPECT_EQ(held, 0);
}

TEST(Excitation, ExponentialForgettingLosesTheParkedStrut) {
  MonitorOptions options = liveOptions();
  options.forgetting_rule = "exponential";
  Strut strut(options);
  strut.drive(2000, roadBetween(0.0, 1e9));
  strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
  strut.park(10000);
  EXPECT_GT(std::abs(strut.la().stiffness_to_mass - kB0), 3.0);
}

// At 0.6 rad/s the stiffness' regressor stands 2.9 / 0.6 = 5 times further out of the noise than the damping's.
TEST(Excitation, OfSlowHeaveReachesTheStiffnessOnlyAndLeavesTheDampingWhatItWas) {
  Strut strut(liveOptions());
  strut.drive(2000, roadBetween(0.0, 1e9));
  strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
  const double damping = strut.la().damping_to_mass;
  strut.noise = 0.006;
  const double start = strut.time();
  strut.b0 = 0.8 * kB0;
  const int rows = 15000;
  const int held = strut.drive(
      rows, [=](double t) { return 1.3 * std::min(1.0, (t - start) / 30.0) * std::sin(0.6 * (t - start)); });
  EXPECT_GT(held, rows * 0.8);
  EXPECT_NEAR(strut.la().stiffness_to_mass, 0.8 * kB0, 0.1 * kB0);
  EXPECT_NEAR(strut.la().damping_to_mass, damping, 0.1 * damping);
}

}  // namespace
}  // namespace suspension_health_monitor
