#include <cmath>
#include <cstdio>
#include <deque>
#include <thread>

#include "bag_options.h"
#include "bag_samples.h"
#include "command.h"
#include "errors.h"
#include "progress.h"
#include "search_report.h"
#include "suspension_health_monitor/identification/recursive_least_squares.h"
#include "suspension_health_monitor/identification/suspension_regression.h"
#include "suspension_health_monitor/model/model_settings.h"
#include "suspension_health_monitor/signal/continuity.h"
#include "whole_file.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

constexpr double kLongestStep = 0.35;  // of the strut's fastest time, for the free run's integration

/// What the body's IMU measures across the strut, by bag.
using BodyMotions = std::vector<std::vector<BodyMotion>>;

/// All samples of each bag.
std::vector<std::vector<CornerSample>> readDrives(const BagOptions& options, BodyMotions& bodies) {
  std::vector<std::vector<CornerSample>> drives;
  for (const std::string& path : options.bags.paths) {
    ImuBags bag = options.bags;
    bag.paths = {path};
    drives.emplace_back();
    bodies.emplace_back();
    const auto take = [&](const CornerSample& sample) {
      drives.back().push_back(sample);
      return true;
    };
    readSamples(bag, options.pipeline, take, [&](const BodyMotion& motion) { bodies.back().push_back(motion); });
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

void requireTestable(const StrutModel& model, const std::vector<UntestableEffect>& untestable) {
  for (const ActiveMeasurementEffect& reading : model.reading)
    for (const UntestableEffect& effect : untestable)
      if (effect.name == reading.effect.name)
        throw InputError("the model has " + effect.name + ", but " + effect.reason + " in these drives");
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
  ModelOptions models = readModelOptions(*values);
  const BagOptions options = readBagOptions(*values);
  std::optional<TextFile> json, model;
  if (values->count("json") != 0) json.emplace((*values)["json"].as<std::string>());
  if (values->count("output") != 0) model.emplace((*values)["output"].as<std::string>());

  BodyMotions bodies;
  const std::vector<std::vector<CornerSample>> drives = readDrives(options, bodies);
  const StrutModel start = models.model ? *models.model : roughModel(drives, options.pipeline.monitor);
  std::deque<DriveRecord> records = makeRecords(drives, *options.pipeline.monitor.sample_period, start);
  std::vector<const DriveRecord*> pointers;
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].addBodyMotion(bodies[i]);
    pointers.push_back(&records[i]);
  }
  const std::vector<UntestableEffect> untestable = takeUntestable(models.library, pointers);
  requireTestable(start, untestable);
  SearchOptions search;
  search.threads = threads;
  Progress progress("fitting", 1.0);
  const std::optional<SearchResult> result = EffectSearch(models.library, search)
                                                 .run(pointers, start, [&](double share) { progress.update(share); });
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
}

}  // namespace suspension_health_monitor
