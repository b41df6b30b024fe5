#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "../ros/simulated_drive.h"
#include "../ros/whole_bag.h"
#include "command.h"
#include "long_work.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {
namespace {

/// Options that have a flag of their own, besides --set NAME=VALUE.
constexpr std::array kFlags{"scenario", "vehicle", "seed", "duration", "rate"};

std::string describeRates(const SimulationOptions& drive) {
  const double sprung = drive.rate, unsprung = drive.unsprung_rate.value_or(drive.rate);
  return sprung == unsprung ? formatted("%g Hz", sprung)
                            : formatted("%g Hz (sprung) and %g Hz (unsprung)", sprung, unsprung);
}

/// Those of one strut and those of a whole vehicle do not mix.
void requireFlagsOfOneKind(const po::variables_map& values, const std::string& vehicle_model) {
  if (vehicle_model.empty() && values.count("vehicle-file") != 0)
    throw std::invalid_argument("--vehicle-file, must come with --vehicle-model");
  for (const char* flag : {"scenario", "vehicle"})
    if (!vehicle_model.empty() && values.count(flag) != 0)
      throw std::invalid_argument(
          "--" + std::string(flag) +
          " is of one strut, must not come with --vehicle-model: `options vehicle` has its own");
}

/// STRUT/NAME=COEFFICIENT[,SHAPE=VALUE]... as settings of that strut.
void hide(const std::string& effect, OptionMap& settings) {
  const std::size_t slash = effect.find('/');
  if (slash == std::string::npos || slash == 0 || slash > effect.find('='))
    throw std::invalid_argument("--effect " + shortened(effect) +
                                ", must be STRUT/NAME=COEFFICIENT[,SHAPE=VALUE]... in a vehicle");
  OptionMap one;
  setEffect(one, effect.substr(slash + 1), {});
  for (const auto& [name, value] : one) settings["struts/" + effect.substr(0, slash) + '/' + name] = value;
}

/// The file that the other commands take as --vehicle.
std::string vehicleFile(const VehicleSimulationOptions& options) {
  const Vehicle& vehicle = options.vehicle;
  const VehicleImu& imu = vehicle.body_imu;
  std::string text =
      formatted("# %s as suspension_bag simulate has driven it. Positions: in the body IMU's frame [m].\n",
                shortened(options.model).c_str());
  text += formatted("body_imu: /%s\nstruts:\n", kBodyImuTopic);
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
    const VehicleStrut& strut = vehicle.struts[i];
    const Eigen::Vector3d top =
        imu.orientation().transpose() * (Eigen::Vector3d(strut.x, strut.y, strut.z) - imu.position());
    text += "  " + strut.name + ": {";
    if (options.has_sprung_imu[i]) text += "sprung_imu: /" + sprungTopic(strut) + ", ";
    text += "unsprung_imu: /" + unsprungTopic(strut) +
            formatted(", position: [%.6g, %.6g, %.6g]}\n", top.x(), top.y(), top.z());
  }
  if (!vehicle.known_forces.empty()) text += "known_forces:\n";
  for (const KnownForce& force : vehicle.known_forces)
    text += "  " + force.name + ": {topic: /" + wrenchTopic(force) + ", field: force.z}\n";
  return text;
}

void printTruth(const Vehicle& vehicle) {
  std::size_t widest = 12;
  for (const VehicleStrut& strut : vehicle.struts) widest = std::max(widest, strut.name.size());
  const int width = static_cast<int>(widest);
  std::printf("%-*s  b1 [1/s]  b0 [1/s^2]  moved by force of", width, "strut");
  for (const VehicleStrut& of : vehicle.struts) std::printf("  %*s", width, of.name.c_str());
  std::printf("\n");
  for (const VehicleStrut& at : vehicle.struts) {
    const double own = vehicle.mobility(at, at);
    std::printf("%-*s  %8.4g  %10.4g  %17s", width, at.name.c_str(), own * at.damping, own * at.stiffness, "");
    for (const VehicleStrut& of : vehicle.struts)
      std::printf("  %*.3f", width, vehicle.mobility(at, of) / vehicle.mobility(of, of));
    std::printf("\n");
  }
}

/// A topic as a simulator named /simulator has it.
std::string inBag(const std::string& topic) {
  return topic.front() == '~' ? "/simulator/" + topic.substr(1) : '/' + topic;
}

void simulateVehicle(const po::variables_map& values, const std::string& model, OptionMap settings) {
  for (const std::string& effect : values["effect"].as<std::vector<std::string>>()) hide(effect, settings);
  const auto options = VehicleSimulationOptions::fromValues(model, std::move(settings));
  const auto path = values["output"].as<std::string>();
  writeBag(driveOf(options), path);
  std::string written = path;
  if (std::optional<TextFile> file = outputFile(values, "vehicle-file")) {
    file->commit(vehicleFile(options));
    written += " and " + values["vehicle-file"].as<std::string>();
  }
  std::printf("%s: %s, %g s at %g Hz, class %s at %g m/s, %s tracks, seed %d\n", written.c_str(),
              shortened(options.model).c_str(), options.drive.duration, options.drive.rate,
              options.vehicle.iso_class.c_str(), options.vehicle.speed, options.drive.tracks.c_str(),
              options.drive.seed);
  printTruth(options.vehicle);
}

}  // namespace

void writeBag(const SimulatedDrive& drive, const std::string& path) {
  const Interruption interruption;
  WholeBag bag(path);
  Progress progress("simulating", drive.duration);
  const double start = drive.playing.start_time;
  const DriveSource source = drive.begin(fromSeconds(start));
  while (const std::optional<SimulatedInstant> instant = source()) {
    for (const auto& [topic, any] : instant->messages)
      std::visit([&, &name = topic](const auto& message) { bag.write(inBag(name), instant->time, message); }, any);
    progress.update(instant->time.toSec() - start);
  }
  bag.commit();
}

void simulate(const Arguments& arguments) {
  po::options_description description("options");
  auto add = description.add_options();
  add("output,o", po::value<std::string>()->required(), "the bag to write");
  add("config", po::value<std::string>()->default_value(""), "YAML file like config/simulator.yaml");
  add("set", po::value<std::vector<std::string>>()->default_value({}, "")->composing(),
      "NAME=VALUE: any option of `suspension_bag options simulator`, or `options vehicle`");
  add("vehicle-model", po::value<std::string>(),
      ("a whole vehicle, at 100 Hz unless set: " + vehicleNames() + ", or a YAML file").c_str());
  add("vehicle-file", po::value<std::string>(), "write the vehicle's topics and positions as YAML");
  add("effect", po::value<std::vector<std::string>>()->default_value({}, "")->composing(),
      "NAME=COEFFICIENT[,SHAPE=VALUE]...: hide this effect in strut or sensor (`suspension_bag effects`); in a vehicle "
      "STRUT/NAME=...");
  add("effects-file", po::value<std::string>(), "YAML file with laws of your own, for --effect");
  for (const OptionDescription& option : SimulatorOptions::describe())
    if (std::find(kFlags.begin(), kFlags.end(), option.name) != kFlags.end())
      add(option.name.c_str(), po::value<std::string>(),
          (option.help + " (" + option.default_value + ") [" + option.unit + "]").c_str());
  const auto values =
      parse(arguments, "simulate [--scenario S | --vehicle-model M] [OPTION]... -o OUT.bag", description);
  if (!values) return;

  requireSeparateFiles(*values, {"config", "effects-file", "vehicle-model"}, {"output", "vehicle-file"});
  if ((*values)["output"].as<std::string>() == kStandardOutput)
    throw std::invalid_argument("--output -, must be a file, which a bag is written to; ./- is one that is called so");
  OptionMap settings = gatherOptions(*values);
  for (const char* flag : kFlags)
    if (values->count(flag) != 0) settings[flag] = (*values)[flag].as<std::string>();
  if (values->count("effects-file") != 0) settings["effects_file"] = (*values)["effects-file"].as<std::string>();
  if (values->count("vehicle-model") != 0) settings["vehicle_model"] = (*values)["vehicle-model"].as<std::string>();
  const std::string vehicle_model = takeVehicleModel(settings);
  requireFlagsOfOneKind(*values, vehicle_model);
  if (!vehicle_model.empty()) return simulateVehicle(*values, vehicle_model, std::move(settings));

  for (const std::string& effect : (*values)["effect"].as<std::vector<std::string>>())
    setEffect(settings, effect, measurementEffects());
  const SimulatorOptions options = SimulatorOptions::fromValues(settings);

  const auto path = (*values)["output"].as<std::string>();
  writeBag(driveOf(options), path);
  std::printf("%s: %s, %g s at %s, seed %d\n", path.c_str(), options.drive.scenario.c_str(), options.drive.duration,
              describeRates(options.drive).c_str(), options.drive.seed);
}

}  // namespace suspension_health_monitor
