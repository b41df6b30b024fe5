#include "suspension_health_monitor/internal/wording/words.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace suspension_health_monitor {

std::string join(const std::vector<std::string>& names, const std::string& separator) {
  std::string text;
  for (const std::string& name : names)
    if (!name.empty()) text += (text.empty() ? "" : separator) + name;
  return text;
}

std::string formatted(const char* format, ...) {
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  std::string text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, values)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(values);
  return text;
}

std::string sizeInPercent(double change) { return formatted("%ld %%", std::lround(100.0 * std::abs(change))); }

std::string percent(double share) { return formatted("%.*f %%", share < 0.01 ? 1 : 0, 100.0 * share); }

std::string describeEnough(double seconds) {
  return formatted(" (%.3g s in one piece are enough)", std::ceil(10.0 * seconds) / 10.0);
}

}  // namespace suspension_health_monitor
