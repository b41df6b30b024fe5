#pragma once

#include <string_view>

namespace suspension_health_monitor {

/// The page with style and scripts in it and "@@findings@@" where its JSON goes.
/// Made from report_page/ when the package is built (cmake/embed_report_page.cmake).
std::string_view reportTemplate();

}  // namespace suspension_health_monitor
