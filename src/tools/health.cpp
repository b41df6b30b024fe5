#include <cstdio>
#include <utility>

#include "command.h"
#include "health_page.h"
#include "long_work.h"
#include "recorded_monitor.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

void watchBags(const po::variables_map& values) {
  const BagOptions options = readLiveOptions(values);
  const AskedVehicle& vehicle = options.vehicle;
  HealthyStruts healthy = healthyOf(values, options);
  HealthFiles files(values, vehicle);
  RecordedMonitor recorded(options, std::move(healthy),
                           [&](std::size_t strut, const HealthMoment& moment, const Baseline& judged_by) {
                             files.add(strut, moment, judged_by);
                           });
  const std::vector<HealthContent::Recording> recordings = recorded.read();
  nlohmann::json whole = wholeJson(vehicle, recorded.coupling(), recorded.gaps());
  std::vector<HealthContent> contents;
  for (const std::size_t i : vehicle.asked) {
    const SuspensionMonitor& strut = recorded.strut(i);
    const std::string reference = describeReference(strut.baseline(), recorded.baselineFile(i));
    vehicle.resultsOf(i, whole).update(toJson(recorded.log(i), strut));
    contents.push_back({recorded.log(i), files.course(i), strut, recordings, reference, vehicle.names[i]});
  }
  files.commit(whole, contents, originOf(values, options.bags.allTopics()));
  recorded.printInput();
  for (std::size_t k = 0; k < contents.size(); ++k) {
    std::printf("\n%s", vehicle.prefix(vehicle.asked[k], ", ").c_str());
    printHealth(contents[k].log, contents[k].monitor, contents[k].reference);
  }
}

}  // namespace

void health(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  auto add = description.add_options();
  add(kBaseline, po::value<std::string>(),
      "YAML file with the healthy strut, as the monitor writes it, or settings with nominal values; of a vehicle "
      "struts: {NAME: ...}");
  add("csv", po::value<std::string>(), "write a line per second and change of level, full precision");
  add(kReport, po::value<std::string>(), "write DIR/report.html: the levels over time as a page with figures");
  const auto values = parse(arguments, "health BAG... [OPTION]...", description, "bag");
  if (!values) return;
  const std::vector<std::string> outputs{"csv", "json", kReport};
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kBaseline}, outputs);
  const Interruption interruption;
  watchBags(*values);
  printWritten(*values, outputs);
}

}  // namespace suspension_health_monitor
