#include "suspension_health_monitor/internal/signal/alignment.h"

#include <stdexcept>
#include <string>

namespace suspension_health_monitor {

Alignment alignment(std::string_view name) {
  if (name == "auto") return Alignment::kAuto;
  if (name == "paired") return Alignment::kPaired;
  if (name == "resampled") return Alignment::kResampled;
  throw std::invalid_argument("alignment = " + std::string(name) + ", must be one of " + std::string(kAlignmentNames));
}

}  // namespace suspension_health_monitor
