#include "report_page.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "report_parts.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string sourceOf(const ReportContent& content) {
  double duration = 0.0;
  for (const ComparedSegment& segment : content.before.segments)
    duration += static_cast<double>(segment.size()) * content.period;
  return join(content.drive_names) + formatted(": %.4g s at %.4g Hz", duration, 1.0 / content.period);
}

/// Numbers to five digits: a figure shows no more, and the page stays small.
json shortened(json value) {
  if (value.is_number_float()) return std::stod(formatted("%.5g", value.get<double>()));
  if (value.is_structured())
    for (json& each : value) each = shortened(std::move(each));
  return value;
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

/// JSON that may stand inside a script element, whatever a file or an effect is called.
std::string harmless(const json& findings) {
  const std::string text = findings.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (const char character : text)
    if (character == '<')
      result += "\\u003c";
    else
      result += character;
  return result;
}

void put(std::string_view text, std::FILE* out) { std::fwrite(text.data(), 1, text.size(), out); }

}  // namespace

ReportPage::Folder::Folder(const std::string& path) : path_(path) {
  std::error_code error;
  made_ = fs::create_directory(path, error);
  if (!fs::is_directory(path)) throw std::runtime_error(path + ": cannot be made: " + error.message());
}

ReportPage::Folder::~Folder() {
  std::error_code not_empty;
  if (made_) fs::remove(path_, not_empty);
}

ReportPage::ReportPage(const std::string& folder)
    : folder_(folder), file_((fs::path(folder) / "report.html").string()) {}

void ReportPage::write(const ReportContent& content) {
  constexpr std::string_view placeholder = "@@findings@@";
  const std::string_view page = reportTemplate();
  const std::size_t place = page.find(placeholder);
  put(page.substr(0, place), file_.stream());
  put(harmless(findingsOf(content)), file_.stream());
  put(page.substr(place + placeholder.size()), file_.stream());
  file_.commit();
}

}  // namespace suspension_health_monitor
