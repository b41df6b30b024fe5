#include <cstdio>

#include "../ros/whole_file.h"
#include "bag_options.h"
#include "command.h"
#include "identify_tables.h"
#include "long_work.h"
#include "recorded_strut.h"
#include "report_page.h"
#include "results.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {
namespace po = boost::program_options;

void diagnose(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  addVehicleOptions(description);
  addModelOptions(description);
  auto add = description.add_options();
  add("output,o", po::value<std::string>(), "write the model that was found as YAML; of a vehicle those of its struts");
  add(kReport, po::value<std::string>(),
      "write DIR/report.html: the search as a page with figures; of a vehicle also DIR/NAME/report.html of every "
      "strut");
  const auto values = parse(arguments, "diagnose BAG... [OPTION]...", description, "bag");
  if (!values) return;
  const std::vector<std::string> outputs{"json", "output", kReport};
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kEffectsFile, kModel}, outputs);
  const int threads = threadsOf(*values);
  if (isOfVehicle(*values)) {
    diagnoseStruts(*values);
    return printWritten(*values, outputs);
  }
  const ModelOptions models = readModelOptions(*values);
  const BagOptions options = readBagOptions(*values, true);
  const Interruption interruption;
  std::optional<TextFile> json_file = outputFile(*values, "json"), model = outputFile(*values, "output");
  std::optional<ReportPage> page;
  if (values->count(kReport) != 0) page.emplace((*values)[kReport].as<std::string>());

  TopicGaps gaps(options.pipeline.shell.input_timeout);
  Progress progress("fitting", 1.0);
  const RecordedDiagnosis recorded =
      diagnoseBags(options, models, threads, gaps, [&](double share) { progress.update(share); });
  const Diagnosis& found = recorded.found;

  const std::string& change = recorded.change;

  progress.clear();
  gaps.print();
  printSearch(found);
  printChange(change);
  for (const auto& [name, reason] : found.not_tried) std::printf("not tried: %s, %s\n", name.c_str(), reason.c_str());
  if (json_file) {
    nlohmann::json whole = toJson(found);
    whole["silent"] = gaps.toJson();
    if (!change.empty()) whole["change"] = change;
    whole["not_tried"] = nlohmann::json::object();
    for (const auto& [name, reason] : found.not_tried) whole["not_tried"][name] = reason;
    json_file->commit(whole.dump(2) + '\n');
  }
  if (model) model->commit(toYaml(found.model()));
  if (page)
    page->write(found, recorded.drives, recorded.options,
                {fileNames(options.bags.paths), originOf(*values, options.bags.topics), change});
  printWritten(*values, outputs);
}

}  // namespace suspension_health_monitor
