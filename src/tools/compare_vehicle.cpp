#include <cstdio>

#include "bag_options.h"
#include "command.h"
#include "long_work.h"
#include "recorded_vehicle.h"
#include "results.h"
#include "strut_files.h"
#include "vehicle_tables.h"

namespace suspension_health_monitor {

void compareStruts(const boost::program_options::variables_map& values) {
  const Interruption interruption;
  std::optional<TextFile> file = outputFile(values, "json");
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
  if (file) file->commit(whole.dump(2) + '\n');
}

}  // namespace suspension_health_monitor
