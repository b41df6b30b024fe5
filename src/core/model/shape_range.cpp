#include <sstream>
#include <stdexcept>

#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLeast = 1e-9, kMost = 1e9;

}  // namespace

void requireAllowed(const std::string& name, const ShapeParameter& shape, double value) {
  const bool is_plain = shape.scale == ShapeScale::kNone;
  const double least = is_plain ? shape.min : kLeast, most = is_plain ? shape.max : kMost;
  if (value >= least && value <= most) return;
  std::ostringstream message;
  message << name << " = " << value << " [" << shape.unit << "], must be in [" << least << ", " << most << ']';
  throw std::invalid_argument(message.str());
}

}  // namespace suspension_health_monitor
