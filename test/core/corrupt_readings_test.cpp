// Readings that no vehicle makes: a bus that lost bits, a driver that hands on memory that nobody has written.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/strut_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kGravity = 9.81, kBegin = 40.0, kEnough = 30.0;  // [m/s^2], [s], [s]
constexpr double kOfMemory = 40.0;  // [s]: LS and LA forget by their memory, once the blocks tell something again

/// What is read instead, one after the other.
using Corrupt = std::function<double()>;

struct Fault {
  bool body, wheel;
  double seconds;  // 0: one reading
};

/// The estimate and health must be well from kEnough after the last corrupt reading on, LS and LA from kOfMemory on.
void expectRecovers(const Fault& fault, const Corrupt& corrupt) {
  MonitorOptions options = liveOptions();
  options.nominal_damping_to_mass = kPaperB1;
  options.nominal_stiffness_to_mass = kPaperB0;
  const double end = kBegin + fault.seconds + 0.01;
  double well_since = 0.0, recursive_since = 0.0;
  int reports = 0;
  StrutMonitor monitor(options, [&](const MonitorReport& report) {
    const auto is_right = [](const StrutEstimate& estimate) {
      return estimate.valid() && std::abs(estimate.damping_to_mass / kPaperB1 - 1.0) < 0.1 &&
             std::abs(estimate.stiffness_to_mass / kPaperB0 - 1.0) < 0.1;
    };
    const double time = toSeconds(report.stamp);
    if (!is_right(report.estimate) || report.health.level != HealthLevel::kOk) well_since = time;
    if (!is_right(report.la) || !report.ls.valid()) recursive_since = time;
    reports += time > end ? 1 : 0;
  });
  static const std::vector<CornerSample> drive = healthyPaperDrive(kBegin + 5.0 + 1.5 * kOfMemory, 0.024);
  for (const CornerSample& sample : drive) {
    const double time = toSeconds(sample.stamp);
    const bool now = time > kBegin - 0.01 && time < end;
    monitor.push(Side::kSprung, sample.stamp, now && fault.body ? corrupt() : kGravity + sample.sprung_acceleration);
    monitor.push(Side::kUnsprung, sample.stamp,
                 now && fault.wheel ? corrupt() : kGravity + sample.unsprung_acceleration);
  }
  EXPECT_LT(well_since, end + kEnough) << describe(monitor.report().estimate.doubt) << ", "
                                       << describe(monitor.report().la.doubt) << ", "
                                       << describe(monitor.report().health);
  EXPECT_LT(recursive_since, end + kOfMemory) << describe(monitor.report().la.doubt);
  EXPECT_GT(reports, static_cast<int>(kOfMemory / 0.02));
}

TEST(CorruptReadings, OfAnySizeAreForgottenWithinHalfAMinute) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  for (const double size : {1e3, 1e4, 1e9, 1e20, 1e40, 1e300})
    for (const Fault& fault : {Fault{true, false, 0.0}, Fault{false, true, 0.0}, Fault{true, false, 5.0},
                               Fault{false, true, 5.0}, Fault{true, true, 5.0}}) {
      SCOPED_TRACE(std::to_string(std::log10(size)) + (fault.body ? " body" : "") + (fault.wheel ? " wheel " : " ") +
                   std::to_string(fault.seconds));
      expectRecovers(fault, [&] { return size; });
      expectRecovers(fault, [&] { return size * normal(engine); });
    }
}

// No gate can tell bursts of these sizes from a strut that is hammered by its stops.
TEST(CorruptReadings, OfSizesThatPassAreForgottenAsSoon) {
  for (const int seed : {1, 2, 3}) {
    std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
    std::normal_distribution<double> normal;
    for (const double size : {50.0, 150.0, 300.0, 500.0, 900.0})
      for (const Fault& fault : {Fault{true, false, 2.0}, Fault{false, true, 5.0}, Fault{true, true, 2.0}}) {
        SCOPED_TRACE(std::to_string(seed) + ", " + std::to_string(size) + (fault.body ? " body" : "") +
                     (fault.wheel ? " wheel" : ""));
        expectRecovers(fault, [&] { return size * normal(engine); });
      }
  }
}

// It may be a bump into the stops: it is taken in, and has to be forgotten.
TEST(CorruptReadings, ThatMayBeABumpAreForgottenAsSoon) {
  for (const double size : {30.0, 300.0, 900.0, -900.0})
    for (const Fault& fault : {Fault{true, false, 0.0}, Fault{false, true, 0.0}, Fault{true, true, 0.0}}) {
      SCOPED_TRACE(std::to_string(size) + (fault.body ? " body" : "") + (fault.wheel ? " wheel" : ""));
      expectRecovers(fault, [&] { return size; });
    }
}

}  // namespace
}  // namespace suspension_health_monitor
