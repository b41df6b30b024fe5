#include <algorithm>

#include "report_parts.h"

namespace suspension_health_monitor {

using nlohmann::json;

static void to_json(json& into, const PartialResidualBin& bin) {
  into = {{"at", bin.at}, {"mean", bin.mean}, {"deviation", bin.deviation}, {"law", bin.law}, {"count", bin.count}};
}

namespace {

constexpr int kLawPoints = 240;

json axisOf(ForceVariable variable) {
  switch (variable) {
    case ForceVariable::kTravel: return {{"title", "travel"}, {"unit", "m"}};
    case ForceVariable::kTravelRate: return {{"title", "travel rate"}, {"unit", "m/s"}};
    case ForceVariable::kTime: break;
  }
  return {{"title", "time"}, {"unit", "s"}};
}

/// The law over the range that was seen.  @pre force.lawAt() may be called.
json curveOf(const PartialResidual& force) {
  json at = json::array(), law = json::array();
  if (force.curve.size() > 1)
    for (int i = 0; i <= kLawPoints; ++i) {
      const double first = force.curve.front().at, last = force.curve.back().at;
      at.push_back(first + (last - first) * i / kLawPoints);
      law.push_back(force.lawAt(at.back()));
    }
  return {{"at", at}, {"law", law}};
}

json forceJson(const PartialResidual& force) {
  json result{{"effect", force.effect.effect.name}, {"law", force.effect.effect.law}, {"axes", json::array()}};
  for (const ForceVariable variable : force.variables) result["axes"].push_back(axisOf(variable));
  if (force.variables.size() == 2)
    result.update(
        {{"edges", json::array({force.grid.first_edges, force.grid.second_edges})}, {"cells", force.grid.cells}});
  else if (force.hasMemory())
    result["branches"] =
        json::array({{{"name", "compressing"}, {"bins", force.curve}}, {{"name", "extending"}, {"bins", force.back}}});
  else
    result.update({{"branches", json::array({{{"name", ""}, {"bins", force.curve}}})}, {"curve", curveOf(force)}});
  return result;
}

}  // namespace

json forcesJson(const ReportContent& content) {
  json forces = json::array();
  if (content.after == nullptr) return forces;
  const std::vector<std::string>& added = content.found.selected;
  for (const PartialResidual& force : content.after->forces)
    if (std::find(added.begin(), added.end(), force.effect.effect.name) != added.end())
      forces.push_back(forceJson(force));
  return forces;
}

}  // namespace suspension_health_monitor
