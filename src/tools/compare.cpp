#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "command.h"
#include "long_work.h"
#include "recorded_drives.h"
#include "results.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

constexpr int kFewestInCell = 10;
constexpr double kSure = 3.0;  // standard errors, for a mark in the map

void printModel(const Comparison& comparison) {
  const StrutModel& model = comparison.model;
  std::printf("model (%s): damping/mass %.5g 1/s, stiffness/mass %.5g 1/s^2",
              !comparison.stddev.empty() ? "fitted" : "as given", model.damping_to_mass, model.stiffness_to_mass);
  for (const ModelNumber& number : numbersOf(model)) {
    if (number.kind == ModelNumber::Kind::kCoefficient)
      std::printf(", %s %.5g %s", number.name.c_str(), number.value, number.unit.c_str());
    if (number.kind == ModelNumber::Kind::kShape)
      std::printf(" (%s %.5g %s)", number.symbol.c_str(), number.value, number.unit.c_str());
  }
  std::printf("\n\n");
}

void printErrors(const Comparison& comparison) {
  std::printf("error                                      rmse [m/s^2]      fit\n");
  const auto row = [](const char* name, double rmse, const std::string& fit = "") {
    std::printf("%-42s %12.4g%s\n", name, rmse, fit.c_str());
  };
  const auto rowOf = [&](const char* name, const PredictionError& error) {
    row(name, error.rmse, formatted(" %6.1f %%", error.fit_percent));
  };
  rowOf("free run (from the wheel alone)", comparison.free_run);
  if (comparison.held_out_rmse) row("free run, on blocks held out", *comparison.held_out_rmse);
  if (comparison.one_step) rowOf("one step (rows of the regression)", *comparison.one_step);
  row("noise floor of the free run, about", comparison.noise_floor);
  std::printf("\nshare of the free run's error that is not noise: %.0f %%\n", 100.0 * comparison.structured_share);
}

void printTest(const char* name, const ResidualCorrelation& correlation) {
  std::printf("%-42s %s (%.0f %% of lags outside the 95 %% band)\n", name,
              correlation.within ? "as noise" : "more than noise", 100.0 * correlation.share_outside);
}

/// The missing force over travel (across) and travel rate (up): a sign where it is sure, twice where it is large.
void printMap(const ForceSurface& surface) {
  double largest = 0.0;
  const auto isSure = [&](Eigen::Index i, Eigen::Index j) {
    return surface.count(i, j) >= kFewestInCell && std::abs(surface.mean(i, j)) > kSure * surface.standard_error(i, j);
  };
  for (Eigen::Index i = 0; i < surface.mean.rows(); ++i)
    for (Eigen::Index j = 0; j < surface.mean.cols(); ++j)
      if (isSure(i, j)) largest = std::max(largest, std::abs(surface.mean(i, j)));
  if (largest == 0.0) return;
  const ReadableUnit travel(surface.travel_edges.back(), "m");
  const ReadableUnit rate = ReadableUnit::plain(surface.rate_edges.back(), "m/s");
  const ReadableUnit force = ReadableUnit::plain(largest, "m/s^2");
  std::printf(
      "\nmissing force: + the strut pushes up harder than the model, - less; ++ -- above %s; . none that is sure\n",
      force(0.5 * largest).c_str());
  for (Eigen::Index j = surface.mean.cols() - 1; j >= 0; --j) {
    const double middle = 0.5 * (surface.rate_edges[j] + surface.rate_edges[j + 1]);
    std::printf("%12s |", rate(middle).c_str());
    for (Eigen::Index i = 0; i < surface.mean.rows(); ++i) {
      const double mean = surface.mean(i, j);
      const char* mark = surface.count(i, j) < kFewestInCell ? "" : ".";
      if (isSure(i, j)) mark = std::abs(mean) > 0.5 * largest ? (mean > 0.0 ? "++" : "--") : (mean > 0.0 ? "+" : "-");
      std::printf(" %-2s", mark);
    }
    std::printf("\n");
  }
  const std::string left = travel(surface.travel_edges.front()), right = travel(surface.travel_edges.back());
  const int width = 3 * static_cast<int>(surface.mean.rows()) - static_cast<int>(left.size());
  std::printf("%12s  %s%*s travel\n", "rate", left.c_str(), std::max(1, width), right.c_str());
}

/// The errors by name, where the model fails in sentences, the force that it lacks as a map.
void printComparison(const Comparison& comparison) {
  printModel(comparison);
  printErrors(comparison);
  printTest("residual against itself (whiteness)", comparison.views.whiteness);
  printTest("residual against the wheel's motion", comparison.views.cross_correlation);
  std::printf("\nWhere it fails, worst first:\n");
  for (const FailureRegion& region : comparison.where) std::printf("- %s\n", region.sentence.c_str());
  printMap(comparison.views.surface);
}

void compareDrives(const po::variables_map& values) {
  std::optional<TextFile> file = outputFile(values, "json");
  AskedDrives asked(values);
  asked.read();
  const AskedVehicle& vehicle = asked.options.vehicle;
  Progress progress("comparing", 1.0);
  const RecordedComparison found = compareBags(asked, [&](double share) { progress.update(share); });
  progress.clear();
  printBags(asked.options, asked.recorded.bags, asked.gaps);
  printCoupling(found.coupling, vehicle.names);
  json whole = wholeJson(vehicle, found.coupling, asked.gaps);
  for (const std::size_t i : vehicle.asked) {
    std::printf("\n%s", vehicle.prefix(i, "\n").c_str());
    printComparison(found.struts[i]);
    vehicle.resultsOf(i, whole).update(toJson(found.struts[i]));
  }
  if (file) file->commit(whole.dump(2) + '\n');
  printWritten(values, {"json"});
}

}  // namespace

json toJson(const Comparison& comparison) {
  json model{{"fitted", !comparison.stddev.empty()}};
  addNumbers(comparison.model, model);
  json free_run = jsonOf(comparison.free_run), one_step;
  free_run["held_out_rmse"] = comparison.held_out_rmse ? json(*comparison.held_out_rmse) : json();
  if (comparison.one_step) {
    one_step = jsonOf(*comparison.one_step);
    one_step["horizon_samples"] = comparison.horizon_samples;
  }
  return {{"model", model},
          {"free_run", free_run},
          {"one_step", one_step},
          {"noise_floor", comparison.noise_floor},
          {"structured_share", comparison.structured_share},
          {"where", jsonOf(comparison.where)},
          {"views", jsonOf(comparison.views)}};
}

void compare(const Arguments& arguments) {
  po::options_description description = bagOptions();
  addModelOptions(description);
  runOnBags(arguments, "compare BAG... [--model MODEL.yaml] [OPTION]...", description, {"json"}, &compareDrives);
}

}  // namespace suspension_health_monitor
