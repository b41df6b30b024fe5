#include <algorithm>
#include <stdexcept>

#include "../ros/simulator_options.h"  // of its folder a file without ROS
#include "bindings.h"
#include "long_work.h"
#include "options.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

/// What one simulated sensor has read.
struct SimulatedReadings {
  std::vector<double> stamps, values;

  void add(double start, const std::optional<AccelerometerReading>& reading, double gravity) {
    if (!reading) return;
    stamps.push_back(start + toSeconds(reading->stamp));
    values.push_back(reading->acceleration + gravity);
  }
};

struct Simulation {
  SimulatedReadings body, wheel, road;
  std::vector<std::array<double, 4>> across;  ///< a_x, a_y, w_x, w_y, with body
  std::vector<double> time;
  std::vector<DriveTruth> truth;
};

void refusePlaying(const OptionMap& values) {
  for (const auto& field : kPlayingFields)
    if (field.name != "start_time" && values.count(std::string(field.name)) != 0)
      throw std::invalid_argument(std::string(field.name) + " is an option of the nodelet, must not come with arrays");
}

Simulation simulateArrays(const OptionMap& keywords, const EffectLibrary& library, LongWork& work) {
  refusePlaying(keywords);
  const SimulatorOptions options = SimulatorOptions::fromValues(keywords, library);
  DriveSimulator simulator(options.drive);
  Simulation made;
  const double start = options.playing.start_time, gravity = options.publishing.gravity;
  const double body_gravity = SimulatedFaults::from(options.drive.hidden_faults).readAtRest(gravity);
  while (const std::optional<DriveSample> sample = simulator.next()) {
    const double now = toSeconds(sample->stamp);
    made.body.add(start, sample->sprung, body_gravity);
    made.wheel.add(start, sample->unsprung, gravity);
    if (options.publishing.road_imu) made.road.add(start, sample->road, gravity);
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

void addSensor(ResultClass<Simulation>& simulation, const char* name, const char* stamps,
               SimulatedReadings Simulation::*sensor) {
  simulation
      .addArray(
          name, [sensor](const Simulation& self) -> const auto& { return (self.*sensor).values; })
      .addArray(
          stamps, [sensor](const Simulation& self) -> const auto& { return (self.*sensor).stamps; });
}

py::array_t<double> acrossOf(const Simulation& simulation) {
  const auto& across = simulation.across;
  return py::array_t<double>({static_cast<Py_ssize_t>(across.size()), Py_ssize_t{4}},
                             across.empty() ? nullptr : across.front().data());
}

}  // namespace

void bindSimulation(py::module& module) {
  ResultClass<Simulation> simulation(module, "Simulation",
                                     "A simulated drive: readings of the sensors, and the truth that none tells.");
  addSensor(simulation, "body", "stamps_body", &Simulation::body);
  addSensor(simulation, "wheel", "stamps_wheel", &Simulation::wheel);
  addSensor(simulation, "road", "stamps_road", &Simulation::road);
  simulation.add("across", &acrossOf)
      .addArray("time", &Simulation::time)
      .addColumn("damping_to_mass", &Simulation::truth, &DriveTruth::damping_to_mass)
      .addColumn("stiffness_to_mass", &Simulation::truth, &DriveTruth::stiffness_to_mass)
      .addColumn("travel", &Simulation::truth, &DriveTruth::travel)
      .addColumn("travel_rate", &Simulation::truth, &DriveTruth::travel_rate)
      .addColumn("road_height", &Simulation::truth, &DriveTruth::road_height);
  module.def(
      "simulator_keywords",
      [](const OptionMap& keywords, const std::vector<std::string>& arguments) {
        return takeKeywords(keywords, SimulatorOptions::describe(), arguments);
      },
      py::arg("keywords"), py::arg("arguments"));
  defWork<OptionMap, EffectLibrary>(module, "simulate", &simulateArrays, "keywords", "library");
}

}  // namespace suspension_health_monitor
