#include "report_page.h"

#include <nlohmann/json.hpp>

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
  return join(content.drive_names) + formatted(": %.4g s at %.4g Hz", duration, 1.0 / content.period);
}

json findingsOf(const ReportContent& content) {
  json findings{{"search", toJson(content.found)},
                {"source", sourceOf(content)},
                {"effects", effectsJson(content.library)},
                {"parameters", parametersJson(content)},
                {"drives", drivesJson(content)},
                {"before", shortened(toJson(content.before))},
                {"forces", shortened(forcesJson(content))},
                {"adding", addingJson(content)}};
  if (content.after != nullptr) findings["after"] = shortened(toJson(*content.after));
  return findings;
}

}  // namespace

void ReportPage::write(const ReportContent& content) { page_.write(searchTemplate(), findingsOf(content)); }

}  // namespace suspension_health_monitor
