// What are the damping and the stiffness of a strut, and how sure is that? From two arrays of accelerations.
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "suspension_health_monitor/identify.h"

int main() {
  // Two minutes of rough ground, read at 100 Hz by accelerometers with noise; gravity may stay in the readings.
  constexpr double kPeriod = 0.01, kStep = kPeriod / 20, kDamping = 4.0, kStiffness = 40.0;
  std::mt19937 engine(1);
  std::normal_distribution<double> noise(0.0, 0.03);
  std::uniform_real_distribution<double> phase(0.0, 6.28);
  std::vector<double> frequencies, phases, sprung, unsprung;
  for (double f = 0.15; f < 10.0; f *= 1.07) {
    frequencies.push_back(6.2832 * f);
    phases.push_back(phase(engine));
  }
  double travel = 0.0, rate = 0.0;  // [m], [m/s], compression positive
  for (int i = 0; i < 240000; ++i) {
    double wheel = 0.0;  // w'' [m/s^2]
    for (std::size_t j = 0; j < phases.size(); ++j) wheel += 0.1 * std::sin(frequencies[j] * i * kStep + phases[j]);
    const double body = kDamping * rate + kStiffness * travel;
    if (i % 20 == 0) {
      sprung.push_back(9.81 + body + noise(engine));
      unsprung.push_back(9.81 + wheel + noise(engine));
    }
    rate += kStep * (wheel - body);
    travel += kStep * rate;
  }

  namespace shm = suspension_health_monitor;
  const shm::IdentifyResult result = shm::identify({shm::makeDrive(kPeriod, sprung, unsprung)});
  for (const auto& [name, strut] : {std::pair("ls", result.ls), std::pair("la", result.la), std::pair("iv", result.iv)})
    std::printf("%s: damping/mass %.3f +- %.3f 1/s, stiffness/mass %.2f +- %.2f 1/s^2%s\n", name, strut.damping_to_mass,
                1.96 * strut.damping_to_mass_stddev, strut.stiffness_to_mass, 1.96 * strut.stiffness_to_mass_stddev,
                strut.valid ? "" : (", not valid: " + strut.reason).c_str());
  for (const std::string& warning : result.warnings) std::printf("warning: %s\n", warning.c_str());
  return result.iv.valid ? 0 : 1;
}
