#include "explanation.h"

#include <algorithm>
#include <cmath>

#include "rivals.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

/// The share of what a model leaves above the floor that another one takes.
double shareOf(const EvaluatedModel& before, const EvaluatedModel& after, double floor) {
  const double structure = square(before.ranked.held_out_rmse) - square(floor);
  return structure > 0.0 ? (square(before.ranked.held_out_rmse) - square(after.ranked.held_out_rmse)) / structure : 0.0;
}

/// A force that goes with the body's own motion, not with the strut's.
bool actsOnBody(const ActiveEffect& active) {
  const auto rate = [&](double acceleration) {
    return active.effect.memory_rate({1.0, 1.0, 1.0, 0.5, acceleration}, active.shapes.data());
  };
  return active.effect.memory_rate && (rate(0.0).s != rate(1.0).s || rate(0.0).second != rate(1.0).second);
}

}  // namespace

Explanation::Explanation(const Records& records, const ModelEvaluator& evaluator, const EvaluatedModel& base)
    : records_(records),
      base_(base),
      turning_share_(shareOfTurning(records, evaluator.heldOut(), evaluator.motionOf(base))) {}

double Explanation::share(const EvaluatedModel& after, double floor) const { return shareOf(base_, after, floor); }

double Explanation::floorOf(const EvaluatedModel& after, double floor) const {
  return floorOfResidual(after.ranked.held_out_rmse, floor, after.fit.residuals, records_.front()->period(),
                         after.ranked.model);
}

bool Explanation::isExplained(const EvaluatedModel& after, const EvaluatedModel& before, double floor) const {
  if (mayBeOtherStruts(after)) return false;
  const auto takesAll = [&](double lowest) {
    return std::min(shareOf(base_, after, lowest), shareOf(before, after, lowest)) > 1.0 - kStructured;
  };
  const double lowest = std::hypot(floor, lostInSampling(records_, after.fit));
  if (takesAll(lowest)) return true;
  // The rest may be noise that a sensor has filtered. Where only the reading is to be at fault, that has been there
  // before: no law hid it.
  const bool only_reading = after.ranked.model.effects.size() == base_.ranked.model.effects.size();
  return !only_reading && takesAll(floorOf(after, lowest));
}

bool Explanation::isSuspect(const EvaluatedModel& after) const {
  return !mayBeOtherStruts(after) && share(after, 0.0) > kMostOfIt;
}

bool Explanation::mayBeOtherStruts(const EvaluatedModel& after) const {
  if (turning_share_ <= kWorthHaving) return false;
  const StrutModel &given = base_.ranked.model, &model = after.ranked.model;
  return std::any_of(model.effects.begin() + static_cast<std::ptrdiff_t>(given.effects.size()), model.effects.end(),
                     actsOnBody) ||
         std::any_of(model.reading.begin() + static_cast<std::ptrdiff_t>(given.reading.size()), model.reading.end(),
                     [](const ActiveMeasurementEffect& fault) { return fault.effect.name != "accelerometer_bias"; });
}

}  // namespace suspension_health_monitor
