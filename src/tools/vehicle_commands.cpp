#include "vehicle_commands.h"

#include <cstdio>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "../ros/vehicle_file.h"
#include "../ros/whole_file.h"
#include "bag_options.h"
#include "bag_samples.h"
#include "command.h"
#include "errors.h"
#include "health_results.h"
#include "identify_tables.h"
#include "long_work.h"
#include "results.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"
#include "suspension_health_monitor/vehicle.h"
#include "vehicle_bags.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;
using nlohmann::json;

constexpr const char* kVehicle = "vehicle";
constexpr const char* kStrut = "strut";

/// What the bags of a vehicle hold, and which of its struts are asked for.
struct Recorded {
  std::vector<std::string> names;  ///< of the struts
  std::vector<std::size_t> asked;  ///< their places
  std::vector<VehicleDrive> drives;
  PipelineOptions options;  ///< with sample_period
};

/// Refuses options of one strut that have no meaning for a vehicle, whose file has the topics.
void refuseBeside(const po::variables_map& values, std::initializer_list<const char*> options) {
  for (const char* option : options)
    if (values.count(option) != 0 && !values[option].defaulted())
      throw std::invalid_argument("--" + std::string(option) + " beside --vehicle, must be left out");
}

Recorded readRecorded(const po::variables_map& values) {
  refuseBeside(values, {"sprung-topic", "unsprung-topic", "road-topic"});
  const VehicleLayout layout = readVehicleFile(values[kVehicle].as<std::string>());
  Recorded recorded;
  for (const VehicleLayout::Strut& strut : layout.struts) recorded.names.push_back(strut.name);
  for (std::size_t i = 0; i < recorded.names.size(); ++i)
    if (values.count(kStrut) == 0 || values[kStrut].as<std::string>() == recorded.names[i]) recorded.asked.push_back(i);
  if (recorded.asked.empty())
    throw std::invalid_argument("--strut " + values[kStrut].as<std::string>() + ", must be one of " +
                                join(recorded.names));
  recorded.options = PipelineOptions::fromValues(gatherOptions(values));
  ImuBags bags = readBags(values);
  if (!recorded.options.shell.target_frame.empty()) bags.transforms = readStaticTransforms(bags.paths);
  std::vector<VehicleBag> read = readVehicleDrives(bags, recorded.options, layout);
  std::printf("sample period %.6g s\n", *recorded.options.monitor.sample_period);
  for (VehicleBag& bag : read) {
    const StrutDrives& struts = bag.drive.struts;
    std::printf("%zu samples of %zu struts, readings %s\n", struts.front().samples.size(), struts.size(),
                bag.alignment.c_str());
    for (const VehicleBag::Sensor& sensor : bag.sensors)
      if (sensor.rejected.total() > 0)
        std::printf("%s%s\n", sensor.topic.c_str(), describeRejected(sensor.rejected).c_str());
    recorded.drives.push_back(std::move(bag.drive));
  }
  return recorded;
}

std::optional<TextFile> jsonFile(const po::variables_map& values) {
  if (values.count("json") == 0) return std::nullopt;
  return std::optional<TextFile>(std::in_place, values["json"].as<std::string>());
}

void requireCoupling(const VehicleCoupling& coupling) {
  if (!coupling) throw TooLittleError("the drives " + coupling.reason);
}

void printForces(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  for (const KnownForceCoefficients& force : coupling.forces) {
    std::printf("one unit of %s accelerates the tops by [m/s^2]:", force.name.c_str());
    for (std::size_t i = 0; i < names.size(); ++i)
      std::printf("%s %s %.4g +- %.2g", i > 0 ? "," : "", names[i].c_str(), force.values[i], force.stddevs[i]);
    std::printf("\n");
  }
}

void printCoupling(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  printForces(coupling, names);
  if (names.size() < 2) return;
  std::printf("how much of what a strut does to its own top reaches the others (condition %.2g):\n%16s",
              coupling.condition, "moved by");
  for (const std::string& name : names) std::printf("  %14s", name.c_str());
  std::printf("\n");
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::printf("%16s", names[i].c_str());
    for (std::size_t j = 0; j < names.size(); ++j)
      if (i == j)
        std::printf("  %14s", "1");
      else
        std::printf("  %6.3f +-%6.3f", coupling.ratios[i][j], coupling.stddevs[i][j]);
    std::printf("\n");
  }
  for (const AntiRollBarFound& bar : coupling.bars)
    std::printf("anti-roll bar between %s and %s: stiffness/mass %.4g and %.4g 1/s^2\n", names[bar.first].c_str(),
                names[bar.second].c_str(), bar.first_stiffness_to_mass, bar.second_stiffness_to_mass);
}

json couplingJson(const std::vector<std::vector<double>>& ratios, const std::vector<std::string>& names) {
  json result = json::object();
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = 0; j < names.size(); ++j)
      if (i != j) result[names[i]][names[j]] = ratios[i][j];
  return result;
}

json barsJson(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  json bars = json::array();
  for (const AntiRollBarFound& bar : coupling.bars)
    bars.push_back(
        {{"struts", {names[bar.first], names[bar.second]}},
         {"stiffness_to_mass",
          {{names[bar.first], bar.first_stiffness_to_mass}, {names[bar.second], bar.second_stiffness_to_mass}}}});
  return bars;
}

json forcesJson(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  json forces = json::object();
  for (const KnownForceCoefficients& force : coupling.forces)
    for (std::size_t i = 0; i < names.size(); ++i) {
      forces[force.name]["coefficients"][names[i]] = force.values[i];
      forces[force.name]["stddevs"][names[i]] = force.stddevs[i];
    }
  return forces;
}

json vehicleJson(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  return {{"struts", json::object()},
          {"coupling", couplingJson(coupling.ratios, names)},
          {"coupling_stddevs", couplingJson(coupling.stddevs, names)},
          {"anti_roll_bars", barsJson(coupling, names)},
          {"known_forces", forcesJson(coupling, names)},
          {"condition", coupling.condition}};
}

json toJson(const IdentifyResult& found) {
  return {{"samples", found.samples},
          {"rows", found.rows},
          {"gaps", found.gaps},
          {"clock_jumps", found.clock_jumps},
          {"sample_period", found.sample_period},
          {"horizon_samples", found.horizon_samples},
          {"warnings", found.warnings},
          {"ls", toJson(found.ls)},
          {"la", toJson(found.la)},
          {"iv", toJson(found.iv)}};
}

std::optional<int> givenHorizon(const PipelineOptions& options) {
  if (!options.monitor.integration_horizon) return std::nullopt;
  return MonitorSettings(options.monitor).horizonSamples(*options.monitor.sample_period);
}

}  // namespace

void addVehicleOptions(po::options_description& description) {
  auto add = description.add_options();
  add(kVehicle, po::value<std::string>(),
      "YAML file with the IMUs of a whole vehicle, instead of the topics of a strut");
  add(kStrut, po::value<std::string>(), "of the vehicle: results of this one only");
}

bool isOfVehicle(const po::variables_map& values) {
  if (values.count(kStrut) != 0 && values.count(kVehicle) == 0)
    throw std::invalid_argument("--strut " + values[kStrut].as<std::string>() + " without --vehicle, which it is of");
  return values.count(kVehicle) != 0;
}

void identifyStruts(const po::variables_map& values) {
  const Interruption interruption;
  std::optional<TextFile> file = jsonFile(values);
  const Recorded recorded = readRecorded(values);
  IdentifyOptions options;
  options.sample_period = recorded.options.monitor.sample_period;
  options.horizon_samples = givenHorizon(recorded.options);
  options.memory = recorded.options.monitor.memory;
  const VehicleIdentification found = identifyVehicle(recorded.drives, recorded.names, options);
  requireCoupling(found.coupling);
  printCoupling(found.coupling, recorded.names);
  json whole = vehicleJson(found.coupling, recorded.names);
  for (const std::size_t i : recorded.asked) {
    const IdentifyResult& strut = found.struts[i];
    std::printf("\n%s, at the end, over the last %.0f rows:\n", recorded.names[i].c_str(), strut.la.rows);
    printResult("LS", strut.ls, recorded.options.monitor.sprung_mass);
    printResult("LA", strut.la, recorded.options.monitor.sprung_mass);
    std::printf("over the whole drive, by instrumental variables:\n");
    printResult("IV", strut.iv, recorded.options.monitor.sprung_mass);
    for (const std::string& warning : strut.warnings) std::printf("warning: %s\n", warning.c_str());
    whole["struts"][recorded.names[i]] = toJson(strut);
  }
  if (file) file->commit(whole.dump(2) + '\n');
}

void compareStruts(const po::variables_map& values) {
  const Interruption interruption;
  std::optional<TextFile> file = jsonFile(values);
  const ModelOptions models = readModelOptions(values);
  const Recorded recorded = readRecorded(values);
  const SeparatedVehicle separated =
      separateVehicle(recorded.drives, recorded.names, recorded.options.monitor.sample_period);
  requireCoupling(separated.coupling);
  printCoupling(separated.coupling, recorded.names);
  json whole = vehicleJson(separated.coupling, recorded.names);
  Progress progress("comparing", static_cast<double>(recorded.asked.size()));
  double done = 0.0;
  for (const std::size_t i : recorded.asked) {
    CompareOptions options;
    options.sample_period = recorded.options.monitor.sample_period;
    options.horizon_samples = givenHorizon(recorded.options);
    options.model = models.model;
    options.fit = !models.model;
    options.progress = [&](double share) { progress.update(done + share); };
    const Comparison comparison = compare(separated.struts[i], options);
    requireEnough(comparison.shortcoming, comparison.reason);
    done += 1.0;
    std::printf("\n%s\n", recorded.names[i].c_str());
    printComparison(comparison);
    whole["struts"][recorded.names[i]] = toJson(comparison);
  }
  if (file) file->commit(whole.dump(2) + '\n');
}

void diagnoseStruts(const po::variables_map& values) {
  refuseBeside(values, {"output", "report", kModel});
  const Interruption interruption;
  std::optional<TextFile> file = jsonFile(values);
  const EffectLibrary library = readEffects(values);
  const Recorded recorded = readRecorded(values);
  DiagnoseOptions options;
  options.sample_period = recorded.options.monitor.sample_period;
  options.horizon_samples = givenHorizon(recorded.options);
  options.candidates = library;
  options.threads = values["threads"].as<int>();
  Progress progress("searching", 1.0);
  options.progress = [&](double share) { progress.update(share); };
  const VehicleDiagnosis found = diagnoseVehicle(recorded.drives, recorded.names, options);
  requireCoupling(found.coupling);
  std::printf("%s\n", found.summary.c_str());
  printCoupling(found.coupling, recorded.names);
  json whole = vehicleJson(found.coupling, recorded.names);
  whole["verdict"] = nameOf(found.verdict);
  whole["summary"] = found.summary;
  whole["selected"] = json::object();
  for (const std::size_t i : recorded.asked) {
    const Diagnosis& strut = found.struts[i];
    std::printf("\n%s: ", recorded.names[i].c_str());
    if (strut)
      printSearch(strut);
    else
      std::printf("the drives %s\n", strut.reason.c_str());
    json& its = whole["struts"][recorded.names[i]] = strut ? toJson(strut) : json{{"reason", strut.reason}};
    whole["selected"][recorded.names[i]] = its["selected"] = found.selected(i);
    if (strut) its["verdict"] = nameOf(found.verdictOn(i));
  }
  if (file) file->commit(whole.dump(2) + '\n');
}

void watchStruts(const po::variables_map& values) {
  refuseBeside(values, {"csv", "report", "baseline"});
  const Interruption interruption;
  std::optional<TextFile> file = jsonFile(values);
  const Recorded recorded = readRecorded(values);
  const MonitorSettings settings(recorded.options.monitor);
  std::vector<HealthLog> logs(recorded.names.size(), HealthLog(fromSeconds(recorded.options.shell.input_timeout)));
  const std::vector<std::string> forces = forceNames(recorded.drives.front());
  VehicleMonitor monitor(
      std::vector<MonitorSettings>(recorded.names.size(), settings),
      [&](std::size_t strut, const MonitorReport& report) { logs[strut].addReport(report); },
      static_cast<int>(forces.size()));
  for (const VehicleDrive& drive : recorded.drives) {
    for (std::size_t k = 0; k < drive.struts.front().samples.size(); ++k) {
      const VehicleSample sample = sampleOf(drive, k);
      for (HealthLog& log : logs) log.addReading(sample.stamp, sample.stamp);
      monitor.addSample(sample);
      Interruption::check();
    }
    for (HealthLog& log : logs) log.finishRecording();
  }
  if (!monitor.isCoupled()) throw TooLittleError("the drives " + reasonOf(monitor.estimate(), recorded.names));
  json whole = vehicleJson(describe(*monitor.coupling(), recorded.names, forces), recorded.names);
  for (const std::size_t i : recorded.asked) {
    const SuspensionMonitor& strut = *monitor.strut(i);
    std::printf("\n%s, ", recorded.names[i].c_str());
    printHealth(logs[i], strut, describeReference(strut.baseline(), ""));
    whole["struts"][recorded.names[i]] = toJson(logs[i], strut);
  }
  if (file) file->commit(whole.dump(2) + '\n');
}

}  // namespace suspension_health_monitor
