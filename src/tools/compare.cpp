
#include "../ros/whole_file.h"
#include "bag_options.h"
#include "command.h"
#include "long_work.h"
#include "recorded_strut.h"
#include "results.h"

namespace suspension_health_monitor {

void compare(const Arguments& arguments) {
  boost::program_options::options_description description("options");
  addBagOptions(description);
  addVehicleOptions(description);
  addModelOptions(description);
  const auto values = parse(arguments, "compare BAG... [--model MODEL.yaml] [OPTION]...", description, "bag");
  if (!values) return;
  const std::vector<std::string> outputs{"json"};
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kEffectsFile, kModel}, outputs);
  if (isOfVehicle(*values)) {
    compareStruts(*values);
    return printWritten(*values, outputs);
  }
  const ModelOptions models = readModelOptions(*values);
  const BagOptions options = readBagOptions(*values, true);
  const Interruption interruption;
  std::optional<TextFile> json_file = outputFile(*values, "json");

  TopicGaps gaps(options.pipeline.shell.input_timeout);
  Comparison comparison;
  {
    Progress progress("comparing", 1.0);
    comparison = compareBags(options, models, gaps, [&](double share) { progress.update(share); });
  }
  gaps.print();
  printComparison(comparison);
  if (!json_file) return;
  nlohmann::json whole = toJson(comparison);
  whole["silent"] = gaps.toJson();
  json_file->commit(whole.dump(2) + '\n');
  printWritten(*values, outputs);
}

}  // namespace suspension_health_monitor
