#include <cstdio>

#include "../ros/whole_file.h"
#include "bag_options.h"
#include "command.h"
#include "comparison_report.h"
#include "drives.h"
#include "errors.h"
#include "interruption.h"
#include "progress.h"
#include "separate_files.h"

namespace suspension_health_monitor {

void compare(const Arguments& arguments) {
  boost::program_options::options_description description("options");
  addBagOptions(description);
  addModelOptions(description);
  const auto values = parse(arguments, "compare BAG... [--model MODEL.yaml] [OPTION]...", description, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", "config", kEffectsFile, kModel}, {"json"});
  const ModelOptions models = readModelOptions(*values);
  const BagOptions options = readBagOptions(*values);
  const Interruption interruption;
  std::optional<TextFile> json;
  if (values->count("json") != 0) json.emplace((*values)["json"].as<std::string>());

  const BagDrives drives = readDrives(options, models.model);
  const MonitorOptions& monitor = options.pipeline.monitor;
  ComparisonOptions comparing;
  comparing.fit = !models.model;
  comparing.horizon_samples = monitor.filter(*monitor.sample_period).horizon_samples;
  std::optional<Comparison> comparison;
  {
    Progress progress("comparing", 1.0);
    comparison = compareModel(pointersTo(drives.records), drives.start, comparing, [&](double share) {
      Interruption::check();
      progress.update(share);
    });
  }
  if (!comparison)
    throw TooLittleError(
        "the drives are too short or too calm to compare a model with, or the model is not stable on "
        "them");
  printComparison(*comparison);
  if (!json) return;
  std::fprintf(json->stream(), "%s\n", toJson(*comparison).dump(2).c_str());
  json->commit();
}

}  // namespace suspension_health_monitor
