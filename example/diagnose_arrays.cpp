// Which effect does a strut have that a spring and a damper do not explain? From two arrays of accelerations.
#include <cstdio>
#include <string>

#include "simulated_strut.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"

int main() {
  SimulatedStrut strut(0.22);
  strut.stop_stiffness = 50.0;
  const SimulatedStrut::Recording read = strut.record(12000);  // two minutes

  namespace shm = suspension_health_monitor;
  const shm::Drive drive = shm::makeDrive(SimulatedStrut::kPeriod, read.body, read.wheel);
  const shm::Comparison linear = shm::compare({drive});
  if (linear) std::printf("a spring and a damper: %s\n", linear.where.front().sentence.c_str());
  const shm::Diagnosis found = shm::diagnose({drive});
  std::printf("%s\n", found ? found.summary.c_str() : ("the drive " + found.reason).c_str());
  for (const shm::ModelNumber& number : shm::numbersOf(found.model()))
    std::printf("  %s = %.4g %s\n", number.name.c_str(), number.value, number.unit.c_str());
  return found ? 0 : 1;
}
