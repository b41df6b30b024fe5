#include <algorithm>
#include <stdexcept>

#include "../ros/simulator_options.h"  // of its folder a file without ROS
#include "bindings.h"
#include "options.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {
namespace {

struct Simulation {
  std::vector<double> body, stamps_body, wheel, stamps_wheel, road, stamps_road;  ///< readings, and when they were
  std::vector<std::array<double, 4>> across;                                      ///< a_x, a_y, w_x, w_y, with body
  std::vector<double> time;
  std::vector<DriveTruth> truth;
};

Simulation simulateArrays(const OptionMap& keywords, const EffectLibrary& library, LongWork& work) {
  for (const auto& field : kPlayingFields)
    if (field.name != "start_time" && keywords.count(std::string(field.name)) != 0)
      throw std::invalid_argument(std::string(field.name) + " is an option of the nodelet, must not come with arrays");
  const SimulatorOptions options = SimulatorOptions::fromValues(keywords, library);
  DriveSimulator simulator(options.drive);
  Simulation made;
  const double start = options.playing.start_time, gravity = options.publishing.gravity;
  const double body_gravity = SimulatedFaults::from(options.drive.hidden_faults).readAtRest(gravity);
  const auto add = [&](const std::optional<AccelerometerReading>& reading, double at_rest, std::vector<double>& values,
                       std::vector<double>& stamps) {
    if (!reading) return;
    values.push_back(reading->acceleration + at_rest);
    stamps.push_back(start + toSeconds(reading->stamp));
  };
  while (const std::optional<DriveSample> sample = simulator.next()) {
    const double now = toSeconds(sample->stamp);
    add(sample->sprung, body_gravity, made.body, made.stamps_body);
    add(sample->unsprung, gravity, made.wheel, made.stamps_wheel);
    if (options.publishing.road_imu) add(sample->road, gravity, made.road, made.stamps_road);
    const Sway& sway = sample->body;
    const bool has_gyro = options.drive.body_rate > 0.0;
    const auto rate = [&](std::size_t axis) { return has_gyro ? sway.angular_rate[axis] : std::nan(""); };
    if (sample->sprung) made.across.push_back({sway.acceleration[0], sway.acceleration[1], rate(0), rate(1)});
    made.time.push_back(start + now);
    made.truth.push_back(sample->truth);
    work.step(now / std::max(options.drive.duration, 1e-9));
  }
  return made;
}

py::array_t<double> acrossOf(const Simulation& simulation) {
  const auto& across = simulation.across;
  return py::array_t<double>({static_cast<Py_ssize_t>(across.size()), Py_ssize_t{4}},
                             across.empty() ? nullptr : across.front().data());
}

}  // namespace

SHM_FIELDS(DriveTruth, damping_to_mass, stiffness_to_mass, travel, travel_rate, road_height)
SHM_FIELDS(Simulation, body, stamps_body, wheel, stamps_wheel, road, stamps_road, time)

void bindSimulation(py::module& module) {
  ResultClass<Simulation> simulation(module, "Simulation",
                                     "A simulated drive: readings of the sensors, and the truth that none tells.");
  simulation.add("across", &acrossOf);
  Fields<DriveTruth>::forEach(
      [&](const char* name, auto member) { simulation.addColumn(name, &Simulation::truth, member); });
  module.def("simulator_keywords", &keywordsOf<SimulatorOptions>, py::arg("keywords"), py::arg("arguments"));
  defWork<OptionMap, EffectLibrary>(module, "simulate", &simulateArrays, "keywords", "library");
}

}  // namespace suspension_health_monitor
