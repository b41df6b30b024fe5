#include <cstdio>

#include "bag_options.h"
#include "command.h"
#include "health_page.h"
#include "long_work.h"
#include "recorded_strut.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "watched_vehicle.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

void watchStrut(const po::variables_map& values) {
  const BagOptions options = readLiveOptions(values);
  const std::optional<HealthyStrut> healthy = healthyOf(values, options.pipeline);
  HealthFiles files(values, {});
  RecordedMonitor recorded(options, healthy, [&](const HealthMoment& moment, const Baseline& judged_by) {
    files.add(0, moment, judged_by);
  });
  const std::vector<HealthContent::Recording> recordings = recorded.read();
  const SuspensionMonitor& monitor = recorded.monitor();
  const std::string reference = describeReference(monitor.baseline(), recorded.baselineFile());
  nlohmann::json whole = toJson(recorded.log(), monitor);
  whole["silent"] = recorded.gaps().toJson();
  files.commit(whole, {{recorded.log(), files.course(0), monitor, recordings, reference, ""}},
               originOf(values, options.bags.topics));
  recorded.printInput();
  printHealth(recorded.log(), monitor, reference);
}

void watchStruts(const po::variables_map& values) {
  AskedVehicle vehicle = readVehicle(values);
  const VehicleOptions options = VehicleOptions::fromValues(vehicle.layout, gatherOptions(values));
  const std::vector<WatchedStrut> watched = readWatched(values, vehicle, options);
  HealthFiles files(values, vehicle.only ? std::vector<std::string>{} : vehicle.names);
  const auto placeInFiles = [&](std::size_t strut) { return vehicle.only ? 0 : strut; };
  WatchedVehicle recorded(values, vehicle, options, watched,
                          [&](std::size_t strut, const HealthMoment& moment, const Baseline& healthy) {
                            if (!vehicle.only || *vehicle.only == strut)
                              files.add(placeInFiles(strut), moment, healthy);
                          });
  const std::vector<HealthContent::Recording> recordings = recorded.read();
  recorded.printInput();
  recorded.requireCoupling();
  nlohmann::json whole = toJson(recorded.coupling(), vehicle.names);
  whole["silent"] = recorded.gaps().toJson();
  std::vector<HealthContent> contents;
  for (const std::size_t i : vehicle.asked) {
    const SuspensionMonitor& strut = *recorded.monitor().strut(i);
    const std::string reference = describeReference(strut.baseline(), recorded.baselineFile(i));
    whole["struts"][vehicle.names[i]] = toJson(recorded.log(i), strut);
    contents.push_back(
        {recorded.log(i), files.course(placeInFiles(i)), strut, recordings, reference, vehicle.names[i]});
    std::printf("\n%s, ", vehicle.names[i].c_str());
    printHealth(recorded.log(i), strut, reference);
  }
  files.commit(whole, contents, originOf(values, recorded.topics()));
}

}  // namespace

void health(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  auto add = description.add_options();
  add(kBaseline, po::value<std::string>(),
      "YAML file with the healthy strut, as the monitor writes it, or settings with nominal values; of a vehicle "
      "struts: "
      "{NAME: ...}");
  add("csv", po::value<std::string>(), "write a line per second and change of level, full precision");
  add(kReport, po::value<std::string>(), "write DIR/report.html: the levels over time as a page with figures");
  const auto values = parse(arguments, "health BAG... [OPTION]...", description, "bag");
  if (!values) return;
  const std::vector<std::string> outputs{"csv", "json", kReport};
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kBaseline}, outputs);
  const Interruption interruption;
  if (isOfVehicle(*values))
    watchStruts(*values);
  else
    watchStrut(*values);
  printWritten(*values, outputs);
}

}  // namespace suspension_health_monitor
