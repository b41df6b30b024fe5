#include "search_report.h"

#include <string>

#include "../ros/search_words.h"
#include "model_numbers.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

constexpr std::size_t kShownCandidates = 8;

json standardDeviations(const ModelFit& fit) {
  json result{{"damping_to_mass", fit.stddev[0]}, {"stiffness_to_mass", fit.stddev[1]}};
  Eigen::Index i = 2;
  visit(
      fit.model, [&](const std::string& name, double, const std::string&) { result[name] = fit.stddev[i++]; },
      [&](const std::string& name, const ShapeParameter& shape, double) {
        result[name + "/" + shape.name] = fit.stddev[i++];
      });
  return result;
}

}  // namespace

void printSearch(const SearchResult& result) {
  std::printf("%s\n", sentence(result).c_str());
  for (const std::vector<std::string>& group : result.indistinguishable)
    std::printf("These drives cannot tell apart: %s.\n", join(group, ", ").c_str());
  if (!result.suggested_drive.empty()) std::printf("%s\n", result.suggested_drive.c_str());
  std::printf("\nmodel as it is: held-out rmse %.4g m/s^2, fit %.1f %%, noise floor about %.4g m/s^2\n",
              result.base.held_out_rmse, result.base_fit_percent, result.noise_floor);
  std::printf("\nadded alone                    held-out rmse   error removed   significant\n");
  bool all_fitted = true;
  for (std::size_t i = 0; i < std::min(kShownCandidates, result.ranking.size()); ++i) {
    const RankedModel& ranked = result.ranking[i];
    all_fitted = all_fitted && ranked.fitted;
    std::printf("%-30s %c%12.4g %14.1f %%   %s\n", join(ranked.effects, " + ").c_str(), ranked.fitted ? ' ' : '~',
                ranked.held_out_rmse, ranked.error_removed_percent, ranked.significant ? "yes" : "no");
  }
  if (!all_fitted) std::printf("~ by the linear response only: far behind, not fitted\n");
  if (!result.extended || !result.final_fit) return;
  std::printf("\nwith %s: held-out rmse %.4g m/s^2, fit %.1f %%\n", join(result.selected, " and ").c_str(),
              result.extended->held_out_rmse, result.extended_fit_percent);
  const ModelFit& fit = *result.final_fit;
  std::printf("  damping/mass    %.5g +- %.2g 1/s\n  stiffness/mass  %.5g +- %.2g 1/s^2\n", fit.model.damping_to_mass,
              fit.stddev[0], fit.model.stiffness_to_mass, fit.stddev[1]);
  Eigen::Index i = 2;
  visit(
      fit.model,
      [&](const std::string& name, double value, const std::string& unit) {
        std::printf("  %s  c = %.5g +- %.2g %s\n", name.c_str(), value, fit.stddev[i++], unit.c_str());
      },
      [&](const std::string&, const ShapeParameter& shape, double value) {
        std::printf("    %s = %.5g +- %.2g %s\n", shape.name.c_str(), value, fit.stddev[i++], shape.unit.c_str());
      });
}

json toJson(const SearchResult& result) {
  json ranking = json::array();
  for (const RankedModel& ranked : result.ranking) {
    json row{{"effects", ranked.effects},
             {"held_out_rmse", ranked.held_out_rmse},
             {"error_removed_percent", ranked.error_removed_percent},
             {"significant", ranked.significant},
             {"fitted", ranked.fitted}};
    addNumbers(ranked.model, row);
    ranking.push_back(row);
  }
  json whole{{"verdict", nameOf(result.verdict)},
             {"base",
              {{"held_out_rmse", result.base.held_out_rmse},
               {"fit_percent", result.base_fit_percent},
               {"parameters", parametersOf(result.base.model)}}},
             {"noise_floor", result.noise_floor},
             {"structured_share", result.structured_share},
             {"surface_share", result.surface_share},
             {"suggested_drive", result.suggested_drive},
             {"ranking", ranking},
             {"selected", result.selected},
             {"indistinguishable", result.indistinguishable}};
  if (result.extended && result.final_fit) {
    json extended{{"held_out_rmse", result.extended->held_out_rmse},
                  {"fit_percent", result.extended_fit_percent},
                  {"parameters", parametersOf(result.final_fit->model)},
                  {"stddevs", standardDeviations(*result.final_fit)}};
    addNumbers(result.final_fit->model, extended);
    whole["extended"] = extended;
  }
  return whole;
}

}  // namespace suspension_health_monitor
