// Counts every allocation of the test program, to show that the sample path makes none. Needs the GNU C library, and a
// malloc that no sanitizer has taken.
#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "block_drive.h"
#include "paper_drive.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"
#include "suspension_health_monitor/internal/identification/regression.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/model/strut_integrator.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"
#include "suspension_health_monitor/internal/monitor/vehicle_monitor.h"
#include "suspension_health_monitor/internal/vehicle/strut_tops.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"
#include "uniform_grid.h"
#include "vehicle_drive.h"

namespace {
std::atomic<long> num_allocations{0};
}  // namespace

extern "C" void* __libc_malloc(std::size_t size);  // NOLINT: the C library's own, below the one replaced here

// Eigen and operator new both end up in malloc.
extern "C" void* malloc(std::size_t size) {
  ++num_allocations;
  return __libc_malloc(size);
}

namespace suspension_health_monitor {
namespace {

template <class Step>
long allocationsPerDrive(const Step& step) {
  const std::vector<CornerSample> drive = healthyPaperDrive(10.0, 0.024);
  for (int i = 0; i < 2; ++i)  // the blocks' length has followed the bounce then
    for (const CornerSample& sample : drive) step(sample);
  const long before = num_allocations;
  for (const CornerSample& sample : drive) step(sample);
  return num_allocations - before;
}

TEST(SamplePath, IsWatchedForAllocationsOfEigenAndOfTheStandardLibrary) {
  Eigen::VectorXd eigen;
  EXPECT_GE(allocationsPerDrive([&](const CornerSample&) { eigen = Eigen::VectorXd::Zero(eigen.size() + 1); }), 501);
  std::vector<std::vector<double>> standard;
  EXPECT_GE(allocationsPerDrive([&](const CornerSample&) { standard.emplace_back(1); }), 501);
}

TEST(SamplePath, AllocatesNothingInTheStrutRegressionWithBothEstimators) {
  SuspensionRegression regression({});
  RecursiveLeastSquares ls(2, {});
  RecursiveLeastAbsolute la(2, {});
  EXPECT_EQ(allocationsPerDrive([&](const CornerSample& sample) {
              if (const RegressionRow* row = regression.push(sample)) {
                ls.update(*row);
                la.update(*row);
              }
            }),
            0);
  EXPECT_GT(ls.effectiveRows(), 40.0);
}

TEST(SamplePath, AllocatesNothingInTheBlocksOfAStrutOnceTheyKnowIt) {
  NoisyDrive drive;
  drive.seconds = 128.0;
  drive.body_noise = drive.wheel_noise = 0.5;
  const SampledStrut sampled = drive.sample();
  VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
  // The first estimate is followed by what all blocks tell, from the eighth on.
  long before = 0;
  int estimates = 0;
  for (std::size_t i = 0; i < sampled.body.size(); ++i) {
    const double t = static_cast<double>(i) / drive.rate;
    if (t < 16.0) before = num_allocations;
    if (t > 60.3 && t < 61.7) continue;  // a gap
    for (const Side side : {Side::kSprung, Side::kUnsprung}) {
      const double reading = (side == Side::kSprung ? sampled.body : sampled.wheel)[i];
      if (blocks.push(readingOf(side, fromSeconds(t), reading)) != nullptr && t > 16.0) ++estimates;
    }
  }
  EXPECT_EQ(num_allocations, before);
  EXPECT_GT(estimates, 100);
}

TEST(SamplePath, AllocatesNothingWhereReadingsAreLost) {
  UniformGrid grid(0.01, {Alignment::kResampled});
  long before = 0;
  int samples = 0;
  for (int k = 1; k < 3000; ++k) {
    if (k == 1000) before = num_allocations;
    const Stamp stamp = k * std::chrono::milliseconds(10);
    const double reading = 9.81 + std::sin(0.8 * k) + std::sin(0.1 * k * k);
    if (grid.push(Side::kUnsprung, stamp, 3.0 * reading)) ++samples;
    if ((k < 1000 || k % 40 > 1) && grid.push(Side::kSprung, stamp, reading)) ++samples;
    while (grid.next()) ++samples;
  }
  EXPECT_EQ(num_allocations, before);
  EXPECT_EQ(grid.streams().bridged(), 100u);
  EXPECT_GT(samples, 2900);
}

TEST(SamplePath, AllocatesNothingInGridAndMonitorWhateverTheInput) {
  MonitorSettings options;
  options.sample_period = 0.02;
  options.nominal_damping_to_mass = kPaperB1;
  options.nominal_stiffness_to_mass = kPaperB0;
  UniformGrid grid(0.02);
  SuspensionMonitor monitor(options);
  Stamp stamp{};
  // The drive goes on and on, with gaps (every 200 samples), lost partners and, at times, a clock that goes back.
  EXPECT_EQ(allocationsPerDrive([&](const CornerSample& sample) {
              const std::uint64_t count = monitor.input().samples;
              stamp += std::chrono::milliseconds(count % 200 == 199 ? 100 : 20);
              if (count == 450) stamp = {};
              if (count % 97 != 96) grid.push(Side::kUnsprung, stamp, sample.unsprung_acceleration);
              if (const auto pair = grid.push(Side::kSprung, stamp, sample.sprung_acceleration))
                monitor.addSample(*pair);
              else
                monitor.addSample({stamp, sample.sprung_acceleration, sample.unsprung_acceleration});
            }),
            0);
  EXPECT_GT(monitor.input().gaps, 2u);
  EXPECT_EQ(monitor.input().restarts, 1u);
  EXPECT_GT(grid.streams().rejected().count(RejectReason::kMissingPartner), 2u);
}

TEST(SamplePath, AllocatesNothingInTheTyreTrackerWhateverTheInput) {
  MonitorSettings options;
  options.sample_period = 0.02;
  TyreTracker tracker(options);
  Stamp stamp{};
  int samples = 0;
  EXPECT_EQ(allocationsPerDrive([&](const CornerSample& sample) {
              stamp += std::chrono::milliseconds(++samples % 200 == 199 ? 100 : 20);
              if (samples == 450) stamp = {};
              const bool silent = samples % 150 == 140;
              const double road = sample.unsprung_acceleration + 0.1 * sample.sprung_acceleration;
              tracker.add({stamp, sample.sprung_acceleration, sample.unsprung_acceleration},
                          silent ? std::nullopt : std::optional<double>(road));
            }),
            0);
  EXPECT_GT(tracker.report().la.effective_rows, 40.0);
}

TEST(SamplePath, AllocatesNothingInAGridThatTurnsToResampling) {
  UniformGrid grid(0.02, {Alignment::kAuto, 60}, true);
  Stamp stamp{};
  int samples = 0, readings = 0;
  EXPECT_EQ(allocationsPerDrive([&](const CornerSample& sample) {
              stamp += std::chrono::milliseconds(++readings % 400 == 0 ? 1000 : 20);
              const auto push = [&](Side side, int late) {
                const Stamp at = stamp + std::chrono::milliseconds(late);
                for (auto next = grid.push(side, at, sample.sprung_acceleration); next; next = grid.next()) ++samples;
              };
              push(Side::kSprung, 0);
              if (readings % 97 != 0) push(Side::kUnsprung, 7);
              push(Side::kUnsprung, 19);
              push(Side::kRoad, 19);
            }),
            0);
  EXPECT_TRUE(grid.streams().resamples());
  EXPECT_GT(samples, 900);
}

TEST(SamplePath, AllocatesNothingInAGridOfManyStreamsThatTurnsToResampling) {
  std::vector<StreamOptions> streams;
  for (std::size_t i = 0; i < 8; ++i) streams.push_back({i < 6 ? 0 : i, i != 7});
  StreamGrid grid(0.02, streams, Alignment::kAuto, 60);
  Stamp stamp{};
  int instants = 0, readings = 0;
  EXPECT_EQ(allocationsPerDrive([&](const CornerSample& sample) {
              stamp += std::chrono::milliseconds(++readings % 400 == 0 ? 1000 : 20);
              for (std::size_t i = 0; i < streams.size(); ++i) {
                if (i == 6 && readings % 97 == 0) continue;
                const Stamp at = stamp + std::chrono::milliseconds(i < 6 ? 0 : 7);
                for (auto next = grid.push(i, at, sample.sprung_acceleration); next != nullptr; next = grid.next())
                  ++instants;
              }
            }),
            0);
  EXPECT_TRUE(grid.resamples());
  EXPECT_GT(instants, 900);
}

TEST(SamplePath, AllocatesNothingInTheStrutTopsOfABodyImu) {
  VehicleChannels channels;
  channels.body_imu = 0;
  channels.struts = {{6, {}, Eigen::Vector3d(1.0, 0.5, 0.0)}, {7, 8, {}}};
  StrutTops tops(std::chrono::milliseconds(20), channels);
  GridInstant instant{{}, std::vector<double>(9, 1.0), std::vector<bool>(9, true)};
  int instants = 0, samples = 0;
  EXPECT_EQ(allocationsPerDrive([&](const CornerSample&) {
              instant.stamp += std::chrono::milliseconds(++samples % 400 == 0 ? 1000 : 20);
              if (tops.push(instant) != nullptr) ++instants;
            }),
            0);
  EXPECT_GT(instants, 900);
}

TEST(SamplePath, AllocatesNothingInAVehicleMonitorThatKnowsItsStruts) {
  const StrutDrives drive = strutDrives(namedVehicle("sedan"), vehicleDrive(120.0));
  MonitorSettings settings;
  settings.sample_period = 0.01;
  VehicleMonitor monitor(std::vector<MonitorSettings>(4, settings), {});
  const VehicleDrive of_vehicle(drive);
  constexpr std::size_t kKnown = 6000;
  for (std::size_t k = 0; k < kKnown; ++k) monitor.addSample(sampleOf(of_vehicle, k));
  ASSERT_TRUE(monitor.isCoupled());
  monitor.fitBody();
  const long before = num_allocations;
  for (std::size_t k = kKnown; k < drive.front().samples.size(); ++k) monitor.addSample(sampleOf(of_vehicle, k));
  EXPECT_EQ(num_allocations, before);
  EXPECT_TRUE(monitor.strut(0)->report().estimate.valid());
}

TEST(SamplePath, AllocatesNothingInLawsOfTheUser) {
  OptionMap settings{{"effects/own/force", std::string("max(0, d - x)^2 + (v > 0 ? tanh(v / x) : s)")},
                     {"effects/own/memory_rate", std::string("(v - abs(v) * s) / x")},
                     {"effects/own/unit", std::string("m/s^2")},
                     {"effects/own/shapes/x/min", 0.1},
                     {"effects/own/shapes/x/max", 1.0}};
  const StrutModel model{3.0, 13.8, {{takeUserEffects(settings).at(0), 2.0, {0.5}}}, {}};
  StrutState state;
  const StrutModel copy = model;  // which has not been evaluated yet
  const long before = num_allocations;
  integrateStrut(copy, 0.0, 0.02, {1e-3, 0.1, 4e-3, 0.2}, state);
  EXPECT_EQ(num_allocations, before);
  EXPECT_EQ(
      allocationsPerDrive([&](const CornerSample& sample) {
        const double wheel = 0.02 * sample.unsprung_acceleration;
        integrateStrut(model, toSeconds(sample.stamp), 0.02, {0.0025 * wheel, wheel / 2, 0.01 * wheel, wheel}, state);
      }),
      0);
  EXPECT_NE(state.memory[0], 0.0);
}

TEST(SamplePath, AllocatesNothingInAMonitorWithEffectsOverGapsAndRunaways) {
  MonitorSettings options;
  options.sample_period = 0.02;
  SuspensionMonitor monitor(options);
  std::vector<ActiveEffect> effects;
  for (const char* name : {"quadratic_damping", "hysteresis", "load_on_spring", "warming"}) {
    const ForceEffect& effect = findEffect(forceEffects(), name);
    effects.push_back({effect, 0.0, std::vector<double>(effect.shapes.size(), 0.1)});
  }
  effects.front().coefficient = -500.0;
  monitor.setEffects(effects);
  Stamp stamp{};
  EXPECT_EQ(allocationsPerDrive([&](const CornerSample& sample) {
              stamp += std::chrono::milliseconds(monitor.input().samples % 400 == 399 ? 100 : 20);
              monitor.addSample({stamp, sample.sprung_acceleration, sample.unsprung_acceleration});
            }),
            0);
  EXPECT_GE(monitor.input().gaps, 2u);
  EXPECT_GT(monitor.report().la.effective_rows, 40.0);
}

}  // namespace
}  // namespace suspension_health_monitor

#endif
