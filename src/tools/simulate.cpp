#include <array>

#include "../ros/simulated_drive.h"
#include "command.h"
#include "simulate_vehicle.h"
#include "suspension_health_monitor/internal/simulation/vehicle.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

/// Options that have a flag of their own, besides --set NAME=VALUE.
constexpr std::array kFlags{"scenario", "vehicle", "seed", "duration", "rate"};
constexpr std::array kFlagsOfOneStrut{"scenario", "vehicle"};

std::string describeRates(const SimulationOptions& drive) {
  const double sprung = drive.rate, unsprung = drive.unsprung_rate.value_or(drive.rate);
  return sprung == unsprung ? formatted("%g Hz", sprung)
                            : formatted("%g Hz (sprung) and %g Hz (unsprung)", sprung, unsprung);
}

/// Those of one strut and those of a whole vehicle do not mix.
void requireFlagsOfOneKind(const po::variables_map& values, const std::string& vehicle_model) {
  if (vehicle_model.empty() && values.count("vehicle-file") != 0)
    throw std::invalid_argument("--vehicle-file, must come with --vehicle-model");
  for (const char* flag : kFlagsOfOneStrut)
    if (!vehicle_model.empty() && values.count(flag) != 0)
      throw std::invalid_argument(
          "--" + std::string(flag) +
          " is of one strut, must not come with --vehicle-model: `options vehicle` has its own");
}

}  // namespace

void simulate(const Arguments& arguments) {
  po::options_description description("options");
  auto add = description.add_options();
  add("output,o", po::value<std::string>()->required(), "the bag to write");
  add("config", po::value<std::string>()->default_value(""), "YAML file like config/simulator.yaml");
  add("set", po::value<std::vector<std::string>>()->default_value({}, "")->composing(),
      "NAME=VALUE: any option of `suspension_bag options simulator`, or `options vehicle`");
  add("vehicle-model", po::value<std::string>(),
      ("a whole vehicle, at 100 Hz unless told: " + vehicleNames() + ", or a YAML file").c_str());
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
