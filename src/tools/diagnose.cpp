#include <cstdio>
#include <thread>

#include "../ros/whole_file.h"
#include "bag_options.h"
#include "command.h"
#include "drives.h"
#include "errors.h"
#include "interruption.h"
#include "progress.h"
#include "report_page.h"
#include "search_report.h"
#include "separate_files.h"
#include "suspension_health_monitor/discrepancy/body_motion.h"
#include "suspension_health_monitor/model/model_settings.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

std::string fileName(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

/// The page for people; what the search found is compared with the drives before and after.
void report(ReportPage& page, const SearchResult& search, const EffectLibrary& library,
            const std::vector<const DriveRecord*>& drives, const std::vector<std::string>& paths) {
  const std::optional<Comparison> before = compareModel(drives, search.base.model);
  if (!before) throw TooLittleError("the drives hold too little for a report");
  std::optional<Comparison> after;
  if (search.final_fit) {
    ComparisonOptions as_found;
    as_found.fit = false;
    after = compareModel(drives, search.final_fit->model, as_found);
  }
  std::vector<std::string> names;
  for (const std::string& path : paths) names.push_back(fileName(path));
  page.write({search, library, drives, names, *before, after ? &*after : nullptr});
}

}  // namespace

void diagnose(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  addModelOptions(description);
  auto add = description.add_options();
  add("output,o", po::value<std::string>(), "write the model that was found as YAML");
  add("report", po::value<std::string>(), "write DIR/report.html: the search as a page with figures");
  add("threads", po::value<int>()->default_value(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))),
      "processor cores to use");
  const auto values = parse(arguments, "diagnose BAG... [OPTION]...", description, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", "config", kEffectsFile, kModel}, {"json", "output"});
  const int threads = (*values)["threads"].as<int>();
  if (threads < 1 || threads > 1024)
    throw std::invalid_argument("--threads " + std::to_string(threads) + ", must be in [1, 1024]");
  ModelOptions models = readModelOptions(*values);
  const BagOptions options = readBagOptions(*values);
  const Interruption interruption;
  std::optional<TextFile> json, model;
  std::optional<ReportPage> page;
  if (values->count("json") != 0) json.emplace((*values)["json"].as<std::string>());
  if (values->count("output") != 0) model.emplace((*values)["output"].as<std::string>());
  if (values->count("report") != 0) page.emplace((*values)["report"].as<std::string>());

  const BagDrives drives = readDrives(options, models.model);
  const std::vector<const DriveRecord*> records = pointersTo(drives.records);
  const std::vector<UntestableEffect> untestable = takeUntestable(models.library, records);
  SearchOptions search;
  search.threads = threads;
  Progress progress("fitting", 1.0);
  const std::optional<SearchResult> result =
      EffectSearch(models.library, search).run(records, drives.start, [&](double share) {
        Interruption::check();
        progress.update(share);
      });
  if (!result)
    throw TooLittleError("the drives are too short to hold a part of them out, or no stable model fits them");

  printSearch(*result);
  for (const UntestableEffect& effect : untestable)
    std::printf("not tried: %s, %s\n", effect.name.c_str(), effect.reason.c_str());
  if (json) {
    nlohmann::json whole = toJson(*result);
    whole["not_tried"] = nlohmann::json::object();
    for (const UntestableEffect& effect : untestable) whole["not_tried"][effect.name] = effect.reason;
    std::fprintf(json->stream(), "%s\n", whole.dump(2).c_str());
    json->commit();
  }
  if (model) {
    std::fputs(toYaml(result->final_fit ? result->final_fit->model : result->base.model).c_str(), model->stream());
    model->commit();
  }
  if (page) report(*page, *result, models.library, records, options.bags.paths);
}

}  // namespace suspension_health_monitor
