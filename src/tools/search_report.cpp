#include <string>

#include "json_of.h"
#include "results.h"
#include "suspension_health_monitor/internal/text.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

constexpr std::size_t kShownCandidates = 8;

json standardDeviations(const FittedModel& fit) {
  json result = json::object();
  auto stddev = fit.stddev.begin();
  for (const ModelNumber& number : numbersOf(fit.model)) result[number.name] = *stddev++;
  return result;
}

void printFit(const FittedModel& fit) {
  auto stddev = fit.stddev.begin();
  for (const ModelNumber& number : numbersOf(fit.model)) {
    if (number.kind == ModelNumber::Kind::kStrut)
      std::printf("  %-15s", number.symbol == "b1" ? "damping/mass" : "stiffness/mass");
    else if (number.kind == ModelNumber::Kind::kShape)
      std::printf("    %s =", number.symbol.c_str());
    else
      std::printf("  %s  c =", number.name.c_str());
    std::printf(" %.5g +- %.2g %s\n", number.value, *stddev++, number.unit.c_str());
  }
  if (!fit.all_samples)
    std::printf("  The fit to all samples failed: these are the numbers of the fit to two thirds of them.\n");
}

}  // namespace

void printSearch(const Diagnosis& found) {
  std::printf("%s\n", found.summary.c_str());
  if (!found.remainder.empty()) std::printf("%s\n", found.remainder.c_str());
  for (const std::vector<std::string>& group : found.indistinguishable)
    std::printf("These drives cannot tell apart: %s.\n", join(group, ", ").c_str());
  if (!found.suggested_drive.empty()) std::printf("%s\n", found.suggested_drive.c_str());
  std::printf("\nmodel as it is: held-out rmse %.4g m/s^2, fit %.1f %%, noise floor about %.4g m/s^2\n",
              found.base.held_out_rmse, found.base_fit_percent, found.noise_floor);
  std::printf("\nadded alone                    held-out rmse   error removed   significant\n");
  bool all_fitted = true;
  for (std::size_t i = 0; i < std::min(kShownCandidates, found.ranking.size()); ++i) {
    const RankedModel& ranked = found.ranking[i];
    if (ranked.failure != FitFailure::kNone) {
      std::printf("%-30s             -                -   no: %s\n", join(ranked.effects, " + ").c_str(),
                  reasonOf(ranked.failure));
      continue;
    }
    all_fitted = all_fitted && ranked.fitted;
    std::printf("%-30s %c%12.4g %14.1f %%   %s\n", join(ranked.effects, " + ").c_str(), ranked.fitted ? ' ' : '~',
                ranked.held_out_rmse, ranked.error_removed_percent, ranked.significant ? "yes" : "no");
  }
  if (!all_fitted) std::printf("~ by the linear response only: far behind, not fitted\n");
  if (!found.extended) return;
  std::printf("\nwith %s: held-out rmse %.4g m/s^2, fit %.1f %%\n", join(found.selected, " and ").c_str(),
              found.extended->held_out_rmse, found.extended_fit_percent);
  printFit(*found.final_fit);
}

void addNumbers(const StrutModel& model, json& into) {
  into["coefficients"] = into["shapes"] = json::object();
  for (const ModelNumber& number : numbersOf(model)) {
    if (number.kind == ModelNumber::Kind::kCoefficient) into["coefficients"][number.name] = number.value;
    if (number.kind == ModelNumber::Kind::kShape) into["shapes"][number.name] = number.value;
  }
}

json toJson(const Diagnosis& found) {
  json ranking = json::array();
  for (const RankedModel& ranked : found.ranking) {
    json row{{"effects", ranked.effects},
             {"held_out_rmse", ranked.held_out_rmse},
             {"error_removed_percent", ranked.error_removed_percent},
             {"significant", ranked.significant},
             {"fitted", ranked.fitted},
             {"parameters", jsonOf(ranked.model)}};
    if (ranked.failure != FitFailure::kNone) row["failure"] = reasonOf(ranked.failure);
    addNumbers(ranked.model, row);
    ranking.push_back(row);
  }
  json whole{{"verdict", nameOf(found.verdict)},
             {"base",
              {{"held_out_rmse", found.base.held_out_rmse},
               {"fit_percent", found.base_fit_percent},
               {"parameters", jsonOf(found.base.model)}}},
             {"noise_floor", found.noise_floor},
             {"structured_share", found.structured_share},
             {"surface_share", found.surface_share},
             {"suggested_drive", found.suggested_drive},
             {"ranking", ranking},
             {"selected", found.selected},
             {"indistinguishable", found.indistinguishable}};
  if (!found.remainder.empty()) whole["remainder"] = found.remainder;
  if (found.extended) {
    whole["explained_share"] = found.explained_share;
    json extended{{"held_out_rmse", found.extended->held_out_rmse},
                  {"fit_percent", found.extended_fit_percent},
                  {"parameters", jsonOf(found.final_fit->model)},
                  {"fitted_to_all_samples", found.final_fit->all_samples},
                  {"stddevs", standardDeviations(*found.final_fit)}};
    addNumbers(found.final_fit->model, extended);
    whole["extended"] = extended;
  }
  return whole;
}

}  // namespace suspension_health_monitor
