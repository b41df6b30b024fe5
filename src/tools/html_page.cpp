#include "html_page.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "command.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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

json shortened(json value) {
  if (value.is_number_float()) return std::stod(formatted("%.5g", value.get<double>()));
  if (value.is_structured())
    for (json& each : value) each = shortened(std::move(each));
  return value;
}

json originOf(const boost::program_options::variables_map& values, const std::vector<std::string>& topics) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return {{"made", std::chrono::duration_cast<std::chrono::seconds>(now).count()},
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
  constexpr std::string_view placeholder = "@@findings@@";
  const std::size_t place = page.find(placeholder);
  put(page.substr(0, place), file_.stream());
  put(harmless(findings), file_.stream());
  put(page.substr(place + placeholder.size()), file_.stream());
  file_.commit();
}

}  // namespace suspension_health_monitor
