// How healthy is a strut, while it drives? Readings of two accelerometers go in one by one, as they come.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

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

  // Four minutes of rough ground, read at 100 Hz; half way the damper loses half of its oil.
  constexpr double kPeriod = 0.01, kStep = kPeriod / 20, kStiffness = 40.0;
  std::mt19937 engine(1);
  std::normal_distribution<double> noise(0.0, 0.03);
  std::uniform_real_distribution<double> phase(0.0, 6.28);
  std::vector<double> frequencies, phases;
  for (double f = 0.15; f < 10.0; f *= 1.07) {
    frequencies.push_back(6.2832 * f);
    phases.push_back(phase(engine));
  }
  double travel = 0.0, rate = 0.0;  // [m], [m/s], compression positive
  for (int i = 0; i < 480000; ++i) {
    double wheel = 0.0;  // w'' [m/s^2]
    for (std::size_t j = 0; j < phases.size(); ++j) wheel += 0.1 * std::sin(frequencies[j] * i * kStep + phases[j]);
    const double body = (i < 240000 ? 4.0 : 2.0) * rate + kStiffness * travel;
    if (i % 20 == 0) {
      const shm::Stamp stamp = shm::fromSeconds((i / 20 + 1) * kPeriod);
      monitor.push(shm::Side::kSprung, stamp, 9.81 + body + noise(engine));
      monitor.push(shm::Side::kUnsprung, stamp, 9.81 + wheel + noise(engine));
    }
    rate += kStep * (wheel - body);
    travel += kStep * rate;
  }
  const shm::StrutEstimate last = monitor.report().la;
  std::printf("at the end: damping/mass %.2f +- %.2f 1/s, stiffness/mass %.1f +- %.1f 1/s^2%s\n", last.damping_to_mass,
              1.96 * last.damping_to_mass_stddev, last.stiffness_to_mass, 1.96 * last.stiffness_to_mass_stddev,
              last.valid() ? "" : " (not valid)");
  return level == shm::HealthLevel::kError ? 0 : 1;
}
