// Which effect does a strut have that a spring and a damper do not explain? From two arrays of accelerations.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"

int main() {
  // A strut with a bump stop, over two minutes of rough ground, read at 100 Hz by accelerometers with noise.
  constexpr double kPeriod = 0.01, kStep = kPeriod / 20, kDamping = 4.0, kStiffness = 40.0, kStop = 50.0, kGap = 0.013;
  std::mt19937 engine(1);
  std::normal_distribution<double> noise(0.0, 0.03);
  std::uniform_real_distribution<double> phase(0.0, 6.28);
  std::vector<double> frequencies, phases, sprung, unsprung;
  for (double f = 0.15; f < 12.0; f *= 1.07) {
    frequencies.push_back(6.2832 * f);
    phases.push_back(phase(engine));
  }
  double travel = 0.0, rate = 0.0;  // [m], [m/s], compression positive
  for (int i = 0; i < 240000; ++i) {
    double wheel = 0.0;  // w'' [m/s^2]
    for (std::size_t j = 0; j < phases.size(); ++j) wheel += 0.22 * std::sin(frequencies[j] * i * kStep + phases[j]);
    const double body = kDamping * rate + kStiffness * travel + kStop * std::max(0.0, travel - kGap);
    if (i % 20 == 0) {
      sprung.push_back(9.81 + body + noise(engine));
      unsprung.push_back(9.81 + wheel + noise(engine));
    }
    rate += kStep * (wheel - body);
    travel += kStep * rate;
  }

  namespace shm = suspension_health_monitor;
  const shm::Drive drive = shm::makeDrive(kPeriod, sprung, unsprung);
  const shm::Comparison linear = shm::compare({drive});
  if (linear) std::printf("a spring and a damper: %s\n", linear.where.front().sentence.c_str());
  const shm::Diagnosis found = shm::diagnose({drive});
  std::printf("%s\n", found ? found.summary.c_str() : ("the drive " + found.reason).c_str());
  for (const shm::ModelNumber& number : shm::numbersOf(found.model()))
    std::printf("  %s = %.4g %s\n", number.name.c_str(), number.value, number.unit.c_str());
  return found ? 0 : 1;
}
