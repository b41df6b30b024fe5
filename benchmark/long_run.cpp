// Memory and estimates after a day: four corners at 1 kHz, in one process, as fast as it goes.
//   tables long_run [HOURS]     default 24; ends with 1 if resident memory grows after the first 24th by more than 1 %,
//                               or if an estimate is wrong at the end
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "../test/core/uniform_grid.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 1e-3;  // [s]
constexpr std::size_t kCorners = 4;
constexpr double kNoise = 0.01;  // [m/s^2] half-width

/// A strut on a road of white acceleration, noise on both sensors; b1 and b0 differ by corner.
class Corner {
 public:
  explicit Corner(std::size_t number)
      : damping_(3.0 + static_cast<double>(number)),
        stiffness_(60.0 + 20.0 * static_cast<double>(number)),
        random_(number + 1),
        grid_(kPeriod),
        monitor_(options()) {}

  void step(Stamp stamp) {
    const double wheel = 5.0 * chance();
    const double body = damping_ * rate_ + stiffness_ * travel_;
    rate_ += kPeriod * (wheel - body);
    travel_ += kPeriod * rate_;
    grid_.push(Side::kSprung, stamp, body + 9.81 + kNoise * chance());
    if (const auto sample = grid_.push(Side::kUnsprung, stamp, wheel + 9.81 + kNoise * chance()))
      monitor_.addSample(*sample);
  }

  bool isRight() const {
    const StrutEstimate& estimate = monitor_.report().estimate;
    std::printf("  b1 %.4f of %.1f 1/s, b0 %.3f of %.0f 1/s^2, %llu samples\n", estimate.damping_to_mass, damping_,
                estimate.stiffness_to_mass, stiffness_, static_cast<unsigned long long>(monitor_.input().samples));
    return estimate.valid() && std::abs(estimate.damping_to_mass / damping_ - 1.0) < 0.1 &&
           std::abs(estimate.stiffness_to_mass / stiffness_ - 1.0) < 0.1;
  }

 private:
  static MonitorSettings options() {
    MonitorSettings options;
    options.sample_period = kPeriod;
    return options;
  }

  double chance() {
    random_ = random_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(static_cast<std::int64_t>(random_) >> 32) * 0x1p-31;
  }

  double damping_, stiffness_;
  std::uint64_t random_;
  double travel_ = 0.0, rate_ = 0.0;
  UniformGrid grid_;
  SuspensionMonitor monitor_;
};

/// Resident memory now [kB].
long residentKilobytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.compare(0, 6, "VmRSS:") == 0) return std::strtol(line.c_str() + 6, nullptr, 10);
  return 0;
}

int run(double hours) {
  std::vector<std::unique_ptr<Corner>> corners;
  for (std::size_t i = 0; i < kCorners; ++i) corners.push_back(std::make_unique<Corner>(i));
  const auto begin = std::chrono::steady_clock::now();
  const auto steps = static_cast<long>(hours * 3600.0 / kPeriod);
  long early = 0;
  for (long k = 0; k < steps; ++k) {
    for (const auto& corner : corners) corner->step(std::chrono::seconds(1) + k * fromSeconds(kPeriod));
    if (k == steps / 24) early = residentKilobytes();
  }
  const long late = residentKilobytes();
  std::printf("%zu corners, %.3g h at 1 kHz in %.0f s; resident memory %ld kB after %.3g h, %ld kB at the end\n",
              kCorners, hours, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), early,
              hours / 24.0, late);
  bool right = static_cast<double>(late) <= 1.01 * static_cast<double>(early);
  for (const auto& corner : corners) right = corner->isRight() && right;
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}

int command(const Arguments& arguments) { return run(arguments.number(0, 24.0)); }

const AddTable kAdded("long_run", {"[HOURS]", command});

}  // namespace
}  // namespace suspension_health_monitor
