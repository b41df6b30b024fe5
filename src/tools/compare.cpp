#include <cstdio>

#include "bag_options.h"
#include "command.h"
#include "long_work.h"
#include "recorded_strut.h"
#include "recorded_vehicle.h"
#include "results.h"
#include "strut_files.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

nlohmann::json compareStrut(const po::variables_map& values) {
  const ModelOptions models = readModelOptions(values);
  const BagOptions options = readBagOptions(values, true);
  TopicGaps gaps(options.pipeline.shell.input_timeout);
  Comparison comparison;
  {
    Progress progress("comparing", 1.0);
    comparison = compareBags(options, models, gaps, [&](double share) { progress.update(share); });
  }
  gaps.print();
  printComparison(comparison);
  nlohmann::json whole = toJson(comparison);
  whole["silent"] = gaps.toJson();
  return whole;
}

nlohmann::json compareStruts(const po::variables_map& values) {
  AskedVehicle vehicle = readVehicle(values);
  const KnownModels models = readModels(values, vehicle, readEffects(values));
  VehicleOptions settings = VehicleOptions::fromValues(vehicle.layout, gatherOptions(values));
  TopicGaps gaps(settings.common.shell.input_timeout);
  const std::vector<VehicleDrive> drives = readDrives(values, vehicle, settings.common, gaps);
  const double period = *settings.common.monitor.sample_period;
  const SeparatedVehicle separated = separateVehicle(drives, vehicle.names, period, models);
  gaps.explain([&] { requireCoupling(separated.coupling); });
  printCoupling(separated.coupling, vehicle.names);
  nlohmann::json whole = toJson(separated.coupling, vehicle.names);
  whole["silent"] = gaps.toJson();
  Progress progress("comparing", static_cast<double>(vehicle.asked.size()));
  double done = 0.0;
  for (const std::size_t i : vehicle.asked) {
    CompareOptions options = compareOptionsOf(settings.struts[i], period, models[i]);
    options.progress = [&](double share) { progress.update(done + share); };
    const Comparison comparison = compare(separated.struts[i], options);
    requireEnough(comparison.shortcoming, comparison.reason);
    done += 1.0;
    progress.clear();
    std::printf("\n%s\n", vehicle.names[i].c_str());
    printComparison(comparison);
    whole["struts"][vehicle.names[i]] = toJson(comparison);
  }
  return whole;
}

}  // namespace

void compare(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  addModelOptions(description);
  const auto values = parse(arguments, "compare BAG... [--model MODEL.yaml] [OPTION]...", description, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kEffectsFile, kModel}, {"json"});
  const Interruption interruption;
  std::optional<TextFile> file = outputFile(*values, "json");
  const nlohmann::json whole = isOfVehicle(*values) ? compareStruts(*values) : compareStrut(*values);
  if (file) file->commit(whole.dump(2) + '\n');
  printWritten(*values, {"json"});
}

}  // namespace suspension_health_monitor
