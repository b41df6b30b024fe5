#include "suspension_health_monitor/internal/simulation/integration_guard.h"

#include <sstream>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

std::string describe(const std::vector<ActiveEffect>& effects) {
  std::ostringstream text;
  for (const ActiveEffect& active : effects) {
    text << (text.tellp() > 0 ? "; " : " with ") << active.effect.name << " = " << active.coefficient;
    for (std::size_t i = 0; i < active.shapes.size(); ++i)
      text << ", " << active.effect.shapes[i].name << " = " << active.shapes[i];
  }
  return text.str();
}

std::string at(double t) {
  std::ostringstream text;
  text << " (" << t << " s after the start of the drive)";
  return text.str();
}

}  // namespace

IntegrationGuard::IntegrationGuard(const std::vector<ActiveEffect>& hidden, double step)
    : hidden_(describe(hidden)), step_(step) {}

void IntegrationGuard::refuseStiffness(double t) const {
  throw std::invalid_argument("the strut" + hidden_ + " is too stiff to be simulated: its force changes so abruptly " +
                              "that the integration would hardly get on" + at(t));
}

void IntegrationGuard::refuseMotion(double t) const {
  throw std::invalid_argument("the strut" + hidden_ + " is unstable: it runs away" + at(t));
}

}  // namespace suspension_health_monitor
