#include <cmath>
#include <cstdio>
#include <deque>
#include <thread>

#include "bag_options.h"
#include "bag_samples.h"
#include "command.h"
#include "errors.h"
#include "progress.h"
#include "report_page.h"
#include "search_report.h"
#include "suspension_health_monitor/identification/recursive_least_squares.h"
#include "suspension_health_monitor/identification/suspension_regression.h"
#include "suspension_health_monitor/model/effect_library.h"
#include "suspension_health_monitor/signal/continuity.h"
#include "whole_file.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

constexpr double kLongestStep = 0.35;  // of the strut's fastest time, for the free run's integration

/// All samples of each bag.
std::vector<std::vector<CornerSample>> readDrives(const BagOptions& options) {
  std::vector<std::vector<CornerSample>> drives;
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

/// Rough parameters by least squares over all drives, where the search starts.
StrutModel roughModel(const std::vector<std::vector<CornerSample>>& drives, const MonitorOptions& options) {
  const double period = *options.sample_period;
  RecursiveOptions recursive;
  recursive.forgetting_factor = 1.0;
  RecursiveLeastSquares least_squares(kNumStrutParameters, recursive);
  for (const std::vector<CornerSample>& drive : drives) {
    SuspensionRegression regression(options.filter(period));
    const CornerSample* last = nullptr;
    for (const CornerSample& sample : drive) {
      if (last != nullptr &&
          continuity(sample.stamp - last->stamp, fromSeconds(period)) != Continuity::kContinues)
        regression.reset();
      if (const RegressionRow* row = regression.push(sample)) least_squares.update(*row);
      last = &sample;
    }
  }
  const Eigen::VectorXd& theta = least_squares.parameters();
  if (!(theta[kDampingToMass] > 0.0 && theta[kStiffnessToMass] > 0.0))
    throw TooLittleError("the drives show no damped spring (least squares: damping/mass " +
                         std::to_string(theta[kDampingToMass]) + ", stiffness/mass " +
                         std::to_string(theta[kStiffnessToMass]) + ")");
  return {theta[kDampingToMass], theta[kStiffnessToMass], {}, {}};
}

std::deque<DriveRecord> makeRecords(const std::vector<std::vector<CornerSample>>& drives, double period,
                                    const StrutModel& rough) {
  const double fastest = std::max(rough.damping_to_mass, std::sqrt(rough.stiffness_to_mass));
  const int steps = std::max(1, static_cast<int>(std::ceil(period * fastest / kLongestStep)));
  std::deque<DriveRecord> records;
  for (const std::vector<CornerSample>& drive : drives) {
    DriveRecord& record = records.emplace_back(period, steps);
    for (const CornerSample& sample : drive) record.push(sample);
    record.finish();
  }
  return records;
}

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
  auto add = description.add_options();
  add("output,o", po::value<std::string>(), "write the model that was found as YAML");
  add("report", po::value<std::string>(), "write DIR/report.html: the search as a page with figures");
  add("threads", po::value<int>()->default_value(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))),
      "processor cores to use");
  const auto values = parse(arguments, "diagnose BAG... [OPTION]...", description, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", "config"}, {"json", "output"});
  const int threads = (*values)["threads"].as<int>();
  if (threads < 1 || threads > 1024)
    throw std::invalid_argument("--threads " + std::to_string(threads) + ", must be in [1, 1024]");
  const BagOptions options = readBagOptions(*values);
  std::optional<TextFile> json, model;
  std::optional<ReportPage> page;
  if (values->count("json") != 0) json.emplace((*values)["json"].as<std::string>());
  if (values->count("output") != 0) model.emplace((*values)["output"].as<std::string>());
  if (values->count("report") != 0) page.emplace((*values)["report"].as<std::string>());

  const std::vector<std::vector<CornerSample>> drives = readDrives(options);
  const StrutModel rough = roughModel(drives, options.pipeline.monitor);
  const std::deque<DriveRecord> records = makeRecords(drives, *options.pipeline.monitor.sample_period, rough);
  std::vector<const DriveRecord*> pointers;
  for (const DriveRecord& record : records) pointers.push_back(&record);
  const EffectLibrary library = builtInEffects();
  SearchOptions search;
  search.threads = threads;
  Progress progress("fitting", 1.0);
  const std::optional<SearchResult> result = EffectSearch(library, search)
                                                 .run(pointers, rough, [&](double share) { progress.update(share); });
  if (!result)
    throw TooLittleError("the drives are too short to hold a part of them out, or no stable model fits them");

  printSearch(*result);
  if (json) {
    std::fprintf(json->stream(), "%s\n", toJson(*result).dump(2).c_str());
    json->commit();
  }
  if (model) {
    writeModel(*result, model->stream());
    model->commit();
  }
  if (page) report(*page, *result, library, pointers, options.bags.paths);
}

}  // namespace suspension_health_monitor
