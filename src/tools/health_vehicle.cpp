#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bag_options.h"
#include "command.h"
#include "health_page.h"
#include "health_results.h"
#include "long_work.h"
#include "recorded_vehicle.h"
#include "report_page.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_identification.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "vehicle_bags.h"
#include "vehicle_tables.h"
#include "watched_vehicle.h"

namespace suspension_health_monitor {
namespace po = boost::program_options;

void watchStruts(const po::variables_map& values) {
  const Interruption interruption;
  AskedVehicle vehicle = readVehicle(values);
  VehicleOptions options = VehicleOptions::fromValues(vehicle.layout, gatherOptions(values));
  const std::vector<WatchedStrut> watched = readWatched(values, vehicle, options);
  HealthFiles files(values, vehicle.only ? std::vector<std::string>{} : vehicle.names);
  TopicGaps gaps(options.common.shell.input_timeout);
  ImuBags bags = readBags(values, options.common.shell);
  const VehicleStreams streams = streamsOf(bags, options.common, vehicle.layout);
  bags.gaps = &gaps;
  const auto placeInFiles = [&](std::size_t strut) { return vehicle.only ? 0 : strut; };
  WatchedVehicle recorded(options, streams, watched, bags.transforms.get(),
                          [&](std::size_t strut, const HealthMoment& moment, const Baseline& healthy) {
                            if (!vehicle.only || *vehicle.only == strut)
                              files.add(placeInFiles(strut), moment, healthy);
                          });
  const std::vector<Stamp> begins = recorded.read(bags);
  recorded.printInput();
  gaps.print();
  gaps.explain([&] { recorded.requireCoupling(vehicle.names); });

  std::vector<HealthContent::Recording> recordings;
  for (const std::string& name : fileNames(bags.paths)) recordings.push_back({name, begins[recordings.size()]});
  nlohmann::json whole = toJson(couplingOf(recorded.monitor(), vehicle.names, options.forceNames()), vehicle.names);
  whole["silent"] = gaps.toJson();
  std::vector<HealthContent> contents;
  for (const std::size_t i : vehicle.asked) {
    const SuspensionMonitor& strut = *recorded.monitor().strut(i);
    const std::string reference =
        describeReference(strut.baseline(), watched[i].healthy ? watched[i].healthy->file : "");
    whole["struts"][vehicle.names[i]] = toJson(recorded.log(i), strut);
    contents.push_back(
        {recorded.log(i), files.course(placeInFiles(i)), strut, recordings, reference, vehicle.names[i]});
    std::printf("\n%s, ", vehicle.names[i].c_str());
    printHealth(recorded.log(i), strut, reference);
  }
  files.commit(whole, contents, originOf(values, topicsOf(streams)));
}

}  // namespace suspension_health_monitor
