#include "report_page.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "bag_options.h"
#include "report_parts.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

std::string sourceOf(const ReportContent& content) {
  double duration = 0.0;
  for (const ComparedSegment& segment : content.before.segments)
    duration += static_cast<double>(segment.size()) * content.period;
  const std::string strut = content.vehicle ? content.vehicle->strut + " in " : "";
  return strut + join(content.source.drive_names) + formatted(": %.4g s at %.4g Hz", duration, 1.0 / content.period);
}

json findingsOf(const ReportContent& content) {
  json findings{{"search", toJson(content.found)},
                {"source", sourceOf(content)},
                {"change", content.source.change},
                {"effects", effectsJson(content.library)},
                {"parameters", parametersJson(content)},
                {"drives", drivesJson(content)},
                {"before", shortened(toJson(content.before))},
                {"forces", shortened(forcesJson(content))},
                {"adding", addingJson(content)},
                {"origin", content.source.origin}};
  findings["origin"]["from"] = toSeconds(content.found.from);
  findings["origin"]["to"] = toSeconds(content.found.to);
  if (content.after != nullptr) findings["after"] = shortened(toJson(*content.after));
  if (const InVehicle* vehicle = content.vehicle)
    findings["vehicle"] = {{"strut", vehicle->strut}, {"bars", vehicle->bars}, {"has_page", vehicle->has_page}};
  return findings;
}

}  // namespace

void ReportPage::write(const Diagnosis& found, const std::vector<Drive>& drives, const DiagnoseOptions& options,
                       const PageSource& source, const InVehicle* vehicle) {
  CompareOptions comparing;
  comparing.sample_period = options.sample_period;
  comparing.model = found.base.model;
  Comparison before = compare(drives, comparing);
  if (!before) {  // nothing fits without what was found: clocks that differ
    comparing.fit = false;
    before = compare(drives, comparing);
  }
  requireEnough(before.shortcoming, before.reason);
  std::optional<Comparison> after;
  if (found.final_fit) {
    comparing.model = found.final_fit->model;
    comparing.fit = false;
    after = compare(drives, comparing);
  }
  page_.write(searchTemplate(), findingsOf({found, options.candidates, *options.sample_period, source, before,
                                            after && *after ? &*after : nullptr, vehicle}));
}

std::vector<std::string> fileNames(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  for (const std::string& path : paths) names.push_back(std::filesystem::path(path).filename());
  return names;
}

}  // namespace suspension_health_monitor
