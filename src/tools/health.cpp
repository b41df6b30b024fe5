#include <string>
#include <vector>

#include "bag_options.h"
#include "command.h"
#include "health_page.h"
#include "health_results.h"
#include "identify_tables.h"
#include "long_work.h"
#include "recorded_strut.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {
namespace po = boost::program_options;

void health(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  addVehicleOptions(description);
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
  if (isOfVehicle(*values)) {
    watchStruts(*values);
    return printWritten(*values, outputs);
  }
  const BagOptions options = readMonitorOptions(*values);

  const Interruption interruption;
  HealthFiles files(*values, {});
  RecordedMonitor recorded(options,
                           [&](const HealthMoment& moment, const Baseline& healthy) { files.add(0, moment, healthy); });
  TopicGaps gaps(options.pipeline.shell.input_timeout);
  const std::vector<HealthContent::Recording> recordings = recorded.read(gaps);
  gaps.explain([&] { recorded.requireEnough(); });

  const SuspensionMonitor& monitor = recorded.monitor();
  const std::string reference = describeReference(monitor.baseline(), recorded.baselineFile());
  nlohmann::json whole = toJson(recorded.log(), monitor);
  whole["silent"] = gaps.toJson();
  files.commit(whole, {{recorded.log(), files.course(0), monitor, recordings, reference, ""}},
               originOf(*values, options.bags.topics));
  gaps.print();
  printInput(monitor, recorded.grid(), options, recorded.rejected());
  printHealth(recorded.log(), monitor, reference);
  printWritten(*values, outputs);
}

}  // namespace suspension_health_monitor
