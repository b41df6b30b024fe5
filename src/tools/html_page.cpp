#include "html_page.h"

#include <boost/algorithm/string/replace.hpp>
#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

namespace fs = std::filesystem;
/// JSON that may stand inside a script element, whatever a file or an effect is called.
std::string harmless(const json& findings) {
  return boost::replace_all_copy(findings.dump(-1, ' ', true, json::error_handler_t::replace), "<", "\\u003c");
}

}  // namespace

json shortened(json value) {
  if (value.is_number_float()) return std::stod(formatted("%.5g", value.get<double>()));
  if (value.is_structured())
    for (json& each : value) each = shortened(std::move(each));
  return value;
}

std::string sourceOf(const std::vector<std::string>& names, double duration, double period) {
  return join(names) + formatted(": %.4g s at %.4g Hz", duration, 1.0 / period);
}

json originOf(const po::variables_map& values, const std::vector<std::string>& topics) {
  return {{"made", std::time(nullptr)},  // POSIX: [s] since 1970
          {"program", "suspension_bag " PACKAGE_VERSION},
          {"command", values[kCommandLine].as<std::string>()},
          {"topics", topics}};
}

HtmlPage::Folder::Folder(const std::string& path) : path_(path) {
  std::error_code error;
  made_ = fs::create_directory(path, error);
  if (!fs::is_directory(path)) throw std::runtime_error(path + ": cannot be made: " + error.message());
}

HtmlPage::Folder::~Folder() {
  std::error_code not_empty;
  if (made_) fs::remove(path_, not_empty);
}

HtmlPage::HtmlPage(const std::string& folder) : folder_(folder), file_((fs::path(folder) / kReportFile).string()) {}

void HtmlPage::write(std::string_view page, const json& findings) {
  file_.commit(boost::replace_first_copy(std::string(page), "@@findings@@", harmless(findings)));
}

std::optional<HtmlPage> reportPage(const po::variables_map& values) {
  if (values.count(kReport) == 0) return std::nullopt;
  return std::optional<HtmlPage>(std::in_place, values[kReport].as<std::string>());
}

}  // namespace suspension_health_monitor
