#include <cstdio>
#include <deque>
#include <thread>

#include "../ros/whole_file.h"
#include "bag_options.h"
#include "bag_samples.h"
#include "command.h"
#include "errors.h"
#include "progress.h"
#include "search_report.h"
#include "separate_files.h"
#include "suspension_health_monitor/discrepancy/search_drives.h"
#include "suspension_health_monitor/model/model_settings.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

/// All samples of each bag.
std::vector<DriveSamples> readDrives(const BagOptions& options) {
  std::vector<DriveSamples> drives;
  for (const std::string& path : options.bags.paths) {
    ImuBags bag = options.bags;
    bag.paths = {path};
    drives.emplace_back();
    readSamples(bag, options.pipeline, [&](const CornerSample& sample) {
      drives.back().push_back(sample);
      return true;
    });
  }
  return drives;
}

/// Where the search starts.
StrutModel roughStrut(const std::vector<DriveSamples>& drives, const MonitorOptions& options) {
  StrutModel rough = roughModel(drives, options);
  if (!isDampedSpring(rough))
    throw TooLittleError("the drives show no damped spring (least squares: damping/mass " +
                         std::to_string(rough.damping_to_mass) + ", stiffness/mass " +
                         std::to_string(rough.stiffness_to_mass) + ")");
  return rough;
}

}  // namespace

void diagnose(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  addModelOptions(description);
  auto add = description.add_options();
  add("output,o", po::value<std::string>(), "write the model that was found as YAML");
  add("threads", po::value<int>()->default_value(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))),
      "processor cores to use");
  const auto values = parse(arguments, "diagnose BAG... [OPTION]...", description, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", "config", kEffectsFile, kModel}, {"json", "output"});
  const int threads = (*values)["threads"].as<int>();
  if (threads < 1 || threads > 1024)
    throw std::invalid_argument("--threads " + std::to_string(threads) + ", must be in [1, 1024]");
  const ModelOptions models = readModelOptions(*values);
  const BagOptions options = readBagOptions(*values);
  std::optional<TextFile> json, model;
  if (values->count("json") != 0) json.emplace((*values)["json"].as<std::string>());
  if (values->count("output") != 0) model.emplace((*values)["output"].as<std::string>());

  const std::vector<DriveSamples> drives = readDrives(options);
  const StrutModel start = models.model ? *models.model : roughStrut(drives, options.pipeline.monitor);
  const std::deque<DriveRecord> records = makeRecords(drives, *options.pipeline.monitor.sample_period, start);
  SearchOptions search;
  search.threads = threads;
  Progress progress("fitting", 1.0);
  const std::optional<SearchResult> result =
      EffectSearch(models.library, search)
          .run(pointersTo(records), start, [&](double share) { progress.update(share); });
  if (!result)
    throw TooLittleError("the drives are too short to hold a part of them out, or no stable model fits them");

  printSearch(*result);
  if (json) {
    std::fprintf(json->stream(), "%s\n", toJson(*result).dump(2).c_str());
    json->commit();
  }
  if (model) {
    std::fputs(toYaml(result->final_fit ? result->final_fit->model : result->base.model).c_str(), model->stream());
    model->commit();
  }
}

}  // namespace suspension_health_monitor
