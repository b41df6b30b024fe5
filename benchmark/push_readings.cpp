// What StrutMonitor::push takes of a processor for a strut read at 1 kHz: the yardstick of benchmark/python_cost.py.
//   push_readings SAMPLES
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "../example/simulated_strut.h"
#include "suspension_health_monitor/strut_monitor.h"

int main(int argc, char** argv) {
  namespace shm = suspension_health_monitor;
  const long samples = argc > 1 ? std::atol(argv[1]) : 1000000;
  SimulatedStrut strut(0.22);
  const SimulatedStrut::Recording read = strut.record(12000);  // again and again, as if it were sampled faster
  shm::MonitorOptions options;
  options.sample_period = 0.001;
  shm::StrutMonitor monitor(options);
  const std::clock_t start = std::clock();
  for (long k = 0; k < samples; ++k) {
    const std::size_t at = static_cast<std::size_t>(k) % read.body.size();
    const shm::Stamp stamp = std::chrono::milliseconds(k + 1);
    monitor.push(shm::Side::kSprung, stamp, read.body[at]);
    monitor.push(shm::Side::kUnsprung, stamp, read.wheel[at]);
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%.9g %.9g %llu\n", static_cast<double>(samples) / seconds, monitor.report().estimate.stiffness_to_mass,
              static_cast<unsigned long long>(monitor.input().samples));
  return 0;
}
