// What are the damping and the stiffness of a strut, and how sure is that? From two arrays of accelerations.
#include <cstdio>
#include <utility>

#include "simulated_strut.h"
#include "suspension_health_monitor/identify.h"

int main() {
  SimulatedStrut strut(0.1);
  const SimulatedStrut::Recording read = strut.record(12000);  // two minutes

  namespace shm = suspension_health_monitor;
  const shm::IdentifyResult result = shm::identify({shm::makeDrive(SimulatedStrut::kPeriod, read.body, read.wheel)});
  for (const auto& [name, found] :
       {std::pair("estimate", result.estimate), std::pair("ls", result.ls), std::pair("la", result.la)})
    std::printf("%s: damping/mass %.3f +- %.3f 1/s, stiffness/mass %.2f +- %.2f 1/s^2%s\n", name, found.damping_to_mass,
                1.96 * found.damping_to_mass_stddev, found.stiffness_to_mass, 1.96 * found.stiffness_to_mass_stddev,
                found.valid() ? "" : (", not valid: " + shm::describe(found.doubt)).c_str());
  for (const std::string& warning : result.warnings) std::printf("warning: %s\n", warning.c_str());
  return result.estimate.valid() ? 0 : 1;
}
