// Prints a table of doc/alignment.md: what is said of healthy struts whose IMUs read regularly, but whose messages get
// lost or are stamped when they happen to arrive. Drives of benchmark/field_drive.h, default settings with nominal
// values.
//   tables delivery [SECONDS]      of each drive, default 600
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "field_drive.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/strut_monitor.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSettled = 30.0, kEvery = 2.0, kGravity = 9.81;  // [s], [s], [m/s^2]

/// Chance of a stamp (standard deviation, in periods) and of a message; the share of messages that wait for 5 to 10
/// periods, and those behind with them.
struct Delivery {
  const char* name;
  double stamped, lost, waits = 0.0;
};

/// Stamps of one sensor's messages.
class Driver {
 public:
  Driver(const Delivery& delivery, double period, std::mt19937_64& random)
      : delivery_(delivery), period_(period), random_(random) {}

  /// @return none: the message got lost.
  std::optional<Stamp> stamp(Stamp taken) {
    constexpr double kApart = 1e-5;  // [s], of messages that have waited
    const double late = delivery_.stamped * normal_(random_);
    wait_ = uniform_(random_) < delivery_.waits ? 5.0 + 5.0 * uniform_(random_) : std::max(0.0, wait_ - 1.0);
    const Stamp stamped = taken + fromSeconds(period_ * (late + wait_));
    last_ = last_ && wait_ > 0.0 ? std::max(stamped, *last_ + fromSeconds(kApart)) : stamped;
    return uniform_(random_) < delivery_.lost ? std::nullopt : last_;
  }

 private:
  const Delivery& delivery_;
  double period_, wait_ = 0.0;
  std::optional<Stamp> last_;
  std::mt19937_64& random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

/// Of all vehicles.
struct Found {
  std::vector<double> off;  // of b0
  double inside = 0.0, valid = 0.0, ok = 0.0, reports = 0.0;
  int warn = 0, error = 0;
};

void drive(const FieldDrive& road, const Delivery& delivery, double seconds, Found& found) {
  MonitorOptions options;
  options.nominal_damping_to_mass = road.vehicle.b1;
  options.nominal_stiffness_to_mass = road.vehicle.b0;
  HealthLevel before = HealthLevel::kStale;
  double next = kSettled;
  StrutMonitor monitor(options, [&](const MonitorReport& report) {
    const HealthLevel level = report.health.level;
    found.warn += int{level == HealthLevel::kWarn && before != level};
    found.error += int{level == HealthLevel::kError && before != level};
    before = level;
    if (toSeconds(report.stamp) < next) return;
    next += kEvery;
    found.reports += 1.0;
    found.ok += level == HealthLevel::kOk ? 1.0 : 0.0;
    if (!report.estimate.valid()) return;
    found.valid += 1.0;
    found.off.push_back(report.estimate.stiffness_to_mass / road.vehicle.b0 - 1.0);
    found.inside +=
        std::abs(report.estimate.stiffness_to_mass - road.vehicle.b0) < 1.96 * report.estimate.stiffness_to_mass_stddev;
  });
  FieldSimulator simulator(road);
  std::mt19937_64 random(road.seed);
  Driver body(delivery, 1.0 / road.rate, random), wheel(delivery, 1.0 / road.rate, random);
  while (simulator.time() < seconds) {
    const CornerSample sample = simulator.next();
    if (const auto stamp = body.stamp(sample.stamp))
      monitor.push(Side::kSprung, *stamp, kGravity + sample.sprung_acceleration);
    if (const auto stamp = wheel.stamp(sample.stamp))
      monitor.push(Side::kUnsprung, *stamp, kGravity + sample.unsprung_acceleration);
  }
}

void printTable(double seconds) {
  std::printf(
      "| road, rate | messages | b0: median error | inside 95 %% | valid | OK | WARN | ERROR |\n"
      "|---|---|---|---|---|---|---|---|\n");
  unsigned seed = 1;
  for (const FieldWay& way :
       {FieldWay{"A, 30 m/s, 100 Hz", 16e-6, 30.0, 100}, FieldWay{"C, 15 m/s, 200 Hz", 256e-6, 15.0, 200},
        FieldWay{"A, 10 m/s, 500 Hz", 16e-6, 10.0, 500}})
    for (const Delivery& delivery :
         {Delivery{"as they should", 0.0, 0.0}, Delivery{"stamps off by 0.05 T", 0.05, 0.0},
          Delivery{"stamps off by 0.1 T", 0.1, 0.0}, Delivery{"stamps off by 0.2 T", 0.2, 0.0},
          Delivery{"stamps off by 0.3 T", 0.3, 0.0}, Delivery{"0.2 % lost", 0.0, 0.002},
          Delivery{"1 % lost", 0.0, 0.01}, Delivery{"1 % lost, stamps off by 0.1 T", 0.1, 0.01},
          Delivery{"1 % lost, stamps off by 0.3 T", 0.3, 0.01}, Delivery{"0.5 % wait for 5 to 10 T", 0.01, 0.0, 0.005},
          Delivery{"1 % lost, 1 % wait", 0.01, 0.01, 0.01}}) {
      Found found;
      for (const FieldVehicle& vehicle : kFieldVehicles) {
        FieldDrive road;
        road.vehicle = vehicle;
        road.road = way.road;
        road.speed = way.speed;
        road.rate = way.rate;
        road.seed = seed++;
        drive(road, delivery, seconds, found);
      }
      char of_valid[40] = "- | -";
      if (!found.off.empty())
        std::snprintf(of_valid, sizeof of_valid, "%+.1f %% | %.0f %%", 100.0 * median(found.off),
                      100.0 * found.inside / found.valid);
      std::printf("| %s | %s | %s | %.0f %% | %.0f %% | %d | %d |\n", way.name, delivery.name, of_valid,
                  100.0 * found.valid / found.reports, 100.0 * found.ok / found.reports, found.warn, found.error);
      std::fflush(stdout);
    }
}

int command(const Arguments& arguments) { return printTable(arguments.number(0, 600.0)), 0; }

const AddTable kAdded("delivery", {"[SECONDS]", command});

}  // namespace
}  // namespace suspension_health_monitor
