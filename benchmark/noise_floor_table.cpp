// Prints how far the estimate of the noise floor is from what the true model leaves, in the drives of effect_battery.
//   noise_floor_table [SEED]
#include <cstdio>
#include <cstdlib>

#include "battery_drives.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

/// rms that a model leaves of a drive from rest, the start left out [m/s^2].
double leftBy(const StrutModel& model, const DriveRecord& record) {
  constexpr std::size_t kSettled = 300;
  double sum = 0.0, count = 0.0;
  std::vector<double> predicted;
  for (const DriveSegment& segment : record.segments()) {
    if (!runFree(model, segment, {}, predicted)) return std::nan("");
    for (std::size_t k = kSettled; k < segment.size(); ++k, ++count) sum += square(segment.sprung[k] - predicted[k]);
  }
  return std::sqrt(sum / count);
}

void print(const BatteryVehicle& vehicle, int seed, const std::vector<std::string>& hidden) {
  BatteryDriver driver(vehicle, seed);
  const BatteryDrive drive = driver.drive(hidden);
  const StrutModel start{drive.truth.damping_to_mass, drive.truth.stiffness_to_mass, {}, {}};
  const auto linear = fitOutputError({&drive.record}, {}, start);
  if (!linear) return;
  const double truth = leftBy(drive.truth, drive.record), floor = estimateNoiseFloor({&drive.record}, linear->model);
  std::printf("%-34s %-28s truth leaves %.4f, estimate %.4f: %.3f times\n", vehicle.label,
              hidden.empty() ? "nothing" : hidden.front().c_str(), truth, floor, floor / truth);
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  using namespace suspension_health_monitor;
  const int seed = argc > 1 ? std::atoi(argv[1]) : 11;
  for (const BatteryVehicle& vehicle : kBatteryVehicles) {
    print(vehicle, seed, {});
    for (const ForceEffect& effect : forceEffects()) print(vehicle, seed, {effect.name});
  }
  return 0;
}
