#include "report_views.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

constexpr std::size_t kLawPoints = 240;

/// To five digits: a figure shows no more, and the page stays small.
double shortened(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return std::strtod(text, nullptr);
}

json shortened(const std::vector<double>& values) {
  json result = json::array();
  for (const double value : values) result.push_back(shortened(value));
  return result;
}

json axisOf(ForceVariable variable) {
  switch (variable) {
    case ForceVariable::kTravel: return {{"title", "travel"}, {"unit", "m"}};
    case ForceVariable::kTravelRate: return {{"title", "travel rate"}, {"unit", "m/s"}};
    case ForceVariable::kTime: break;
  }
  return {{"title", "time"}, {"unit", "s"}};
}

/// A map for the page: rows upwards along y.
json emptyMap(ForceVariable x, ForceVariable y, const std::vector<double>& x_edges,
              const std::vector<double>& y_edges) {
  return {{"x", axisOf(x)}, {"y", axisOf(y)}, {"x_edges", shortened(x_edges)}, {"y_edges", shortened(y_edges)}};
}

json mapOf(const ForceSurface& surface) {
  json map = emptyMap(ForceVariable::kTravel, ForceVariable::kTravelRate, surface.travel_edges, surface.rate_edges);
  json means = json::array(), errors = json::array(), counts = json::array();
  for (Eigen::Index j = 0; j < surface.mean.cols(); ++j) {
    json mean = json::array(), error = json::array(), count = json::array();
    for (Eigen::Index i = 0; i < surface.mean.rows(); ++i) {
      const bool seen = surface.count(i, j) > 0;
      mean.push_back(seen ? json(shortened(surface.mean(i, j))) : json());
      error.push_back(seen ? json(shortened(surface.standard_error(i, j))) : json());
      count.push_back(surface.count(i, j));
    }
    means.push_back(mean);
    errors.push_back(error);
    counts.push_back(count);
  }
  map.update({{"mean", means}, {"standard_error", errors}, {"count", counts}});
  return map;
}

json spectrumOf(const ResidualSpectrum& spectrum) {
  const auto amplitudes = [](const std::vector<double>& densities) {
    json result = json::array();
    for (const double density : densities) result.push_back(shortened(std::sqrt(density)));
    return result;
  };
  return {{"frequency", shortened(spectrum.frequency)},
          {"residual", amplitudes(spectrum.residual)},
          {"noise", amplitudes(spectrum.noise)},
          {"coherence", shortened(spectrum.coherence)},
          {"coherence_threshold", spectrum.coherence_threshold}};
}

json correlationOf(const ResidualCorrelation& correlation) {
  return {{"lag", shortened(correlation.lag)},     {"value", shortened(correlation.value)},
          {"lower", shortened(correlation.lower)}, {"upper", shortened(correlation.upper)},
          {"within", correlation.within},          {"share_outside", correlation.share_outside}};
}

json branchOf(const PartialResidual& force, const std::vector<PartialResidualBin>& bins, const char* name) {
  json points = json::array(), law_x = json::array(), law = json::array();
  for (const PartialResidualBin& bin : bins) {
    points.push_back({{"x", shortened(bin.at)},
                      {"y", shortened(bin.mean)},
                      {"low", shortened(bin.mean - bin.deviation)},
                      {"high", shortened(bin.mean + bin.deviation)},
                      {"law", shortened(bin.law)},
                      {"count", bin.count}});
    if (!force.hasMemory()) continue;
    law_x.push_back(shortened(bin.at));
    law.push_back(shortened(bin.law));
  }
  if (!force.hasMemory() && bins.size() > 1)
    for (std::size_t i = 0; i <= kLawPoints; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(kLawPoints);
      const double at = bins.front().at + share * (bins.back().at - bins.front().at);
      law_x.push_back(shortened(at));
      law.push_back(shortened(force.lawAt(at)));
    }
  return {{"name", name}, {"points", points}, {"law_x", law_x}, {"law", law}};
}

/// @param value  of a bin: what was seen, or the law.
json gridMap(const PartialResidual& force, double PartialResidualBin::*value) {
  const PartialResidualGrid& grid = force.grid;
  json map = emptyMap(force.variables[0], force.variables[1], grid.first_edges, grid.second_edges);
  json means = json::array(), counts = json::array();
  for (std::size_t j = 0; j + 1 < grid.second_edges.size(); ++j) {
    json mean = json::array(), count = json::array();
    for (const std::vector<PartialResidualBin>& column : grid.cells) {
      mean.push_back(column[j].count > 0 ? json(shortened(column[j].*value)) : json());
      count.push_back(column[j].count);
    }
    means.push_back(mean);
    counts.push_back(count);
  }
  map.update({{"mean", means}, {"count", counts}});
  return map;
}

json forceJson(const PartialResidual& force) {
  json result{{"effect", force.effect.effect.name}, {"law", force.effect.effect.law}};
  if (force.variables.size() == 2) {
    result["seen"] = gridMap(force, &PartialResidualBin::mean);
    result["by_law"] = gridMap(force, &PartialResidualBin::law);
    return result;
  }
  result["x"] = axisOf(force.variables.front());
  result["branches"] = json::array({branchOf(force, force.curve, force.hasMemory() ? "compressing" : "")});
  if (force.hasMemory()) result["branches"].push_back(branchOf(force, force.back, "extending"));
  return result;
}

}  // namespace

json viewsJson(const Comparison& comparison) {
  const ResidualViews& views = comparison.views;
  json where = json::array();
  for (const FailureRegion& region : comparison.where) where.push_back({{"sentence", region.sentence}});
  json result{{"where", where},
              {"map", mapOf(views.surface)},
              {"whiteness", correlationOf(views.whiteness)},
              {"cross_correlation", correlationOf(views.cross_correlation)}};
  if (views.spectrum) result["spectrum"] = spectrumOf(*views.spectrum);
  return result;
}

json forcesJson(const ReportContent& content) {
  json forces = json::array();
  if (content.after == nullptr) return forces;
  for (const PartialResidual& force : content.after->forces) {
    const std::vector<std::string>& added = content.found.selected;
    if (std::find(added.begin(), added.end(), force.effect.effect.name) != added.end())
      forces.push_back(forceJson(force));
  }
  return forces;
}

}  // namespace suspension_health_monitor
