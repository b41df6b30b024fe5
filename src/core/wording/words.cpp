#include "suspension_health_monitor/internal/wording/words.h"

#include <cstdio>

namespace suspension_health_monitor {

std::string join(const std::vector<std::string>& names, const std::string& separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f %%", share < 0.01 ? 1 : 0, 100.0 * share);
  return text;
}

}  // namespace suspension_health_monitor
