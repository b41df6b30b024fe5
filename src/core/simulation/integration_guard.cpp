#include "suspension_health_monitor/internal/simulation/integration_guard.h"

#include <stdexcept>

#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

std::string describe(const std::vector<ActiveEffect>& effects) {
  std::string text;
  for (const ActiveEffect& active : effects) {
    text += (text.empty() ? " with " : "; ") + active.effect.name + formatted(" = %g", active.coefficient);
    for (std::size_t i = 0; i < active.shapes.size(); ++i)
      text += ", " + active.effect.shapes[i].name + formatted(" = %g", active.shapes[i]);
  }
  return text;
}

std::string at(double t) { return formatted(" (%g s after the start of the drive)", t); }

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
