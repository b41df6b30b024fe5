// How healthy is a strut, while it drives? Readings of two accelerometers go in one by one, as they come.
#include <cstdio>

#include "simulated_strut.h"
#include "suspension_health_monitor/strut_monitor.h"

int main() {
  namespace shm = suspension_health_monitor;
  shm::MonitorOptions options;
  options.nominal_damping_to_mass = 4.0;     // [1/s]
  options.nominal_stiffness_to_mass = 40.0;  // [1/s^2]
  auto level = shm::HealthLevel::kStale;
  shm::StrutMonitor monitor(options, [&level](const shm::MonitorReport& report) {
    if (report.health.level == level) return;
    level = report.health.level;
    std::printf("%6.1f s  level %d: %s\n", shm::toSeconds(report.stamp), static_cast<int>(level),
                describe(report.health).c_str());
  });

  SimulatedStrut strut(0.1);
  for (int i = 1; i <= 24000; ++i) {      // four minutes
    if (i == 12000) strut.damping = 2.0;  // half way the damper loses half of its oil
    const SimulatedStrut::Readings readings = strut.next();
    const shm::Stamp stamp = shm::fromSeconds(i * SimulatedStrut::kPeriod);
    monitor.push(shm::Side::kSprung, stamp, readings.body);
    monitor.push(shm::Side::kUnsprung, stamp, readings.wheel);
  }
  const shm::StrutEstimate last = monitor.report().estimate;
  std::printf("at the end: damping/mass %.2f +- %.2f 1/s, stiffness/mass %.1f +- %.1f 1/s^2%s\n", last.damping_to_mass,
              1.96 * last.damping_to_mass_stddev, last.stiffness_to_mass, 1.96 * last.stiffness_to_mass_stddev,
              last.valid() ? "" : " (not valid)");
  return level == shm::HealthLevel::kError ? 0 : 1;
}
