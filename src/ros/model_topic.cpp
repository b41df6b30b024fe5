#include <cmath>

#include "conversions.h"
#include "report_topics.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {

void ModelTopic::change(const std::vector<ActiveEffect>& effects, const SuspensionMonitor* monitor,
                        const std::string& frame) {
  has_estimate_ = monitor != nullptr && monitor->modelEstimate().valid();
  auto message = boost::make_shared<ModelInUse>();
  message->header.frame_id = frame;
  if (monitor != nullptr) message->header.stamp = toRosTime(monitor->report().stamp);
  message->damping_to_mass = message->stiffness_to_mass = std::nan("");
  for (const ActiveEffect& active : effects) {
    message->effect_names.push_back(active.effect.name);
    message->effect_coefficients.push_back(active.coefficient);
    for (std::size_t i = 0; i < active.shapes.size(); ++i) {
      message->shape_names.push_back(active.effect.name + '/' + active.effect.shapes[i].name);
      message->shapes.push_back(active.shapes[i]);
    }
  }
  if (has_estimate_) {
    const StrutEstimate& estimate = monitor->modelEstimate();
    message->damping_to_mass = estimate.damping_to_mass;
    message->stiffness_to_mass = estimate.stiffness_to_mass;
    message->yaml = toYaml({estimate.damping_to_mass, estimate.stiffness_to_mass, effects, {}});
  }
  publisher_.publish(message);
}

}  // namespace suspension_health_monitor
