#pragma once

#include "model_evaluator.h"

namespace suspension_health_monitor {

/// Judges whether what a search added to its base is what was missing.
class Explanation {
 public:
  /// The arguments must outlive this object.
  Explanation(const Records& records, const ModelEvaluator& evaluator, const EvaluatedModel& base);

  /// @return the share of the structure that a model with more effects takes.
  double share(const EvaluatedModel& after, double floor) const;

  /// @return the noise floor of what a model leaves, see floorOfResidual().
  double floorOf(const EvaluatedModel& after, double floor) const;

  /// Names are given if the model with them leaves noise only, or next to nothing of what there was to explain; or if
  /// it takes most of that and no other law of travel and travel rate would take the rest: that comes from elsewhere,
  /// or was lost in sampling.
  bool isExplained(const EvaluatedModel& after) const;

  /// @return true if other struts of the same body may have done what is taken for something else: on a body that the
  /// strut itself turns, see body_turning.h, they imitate any fault of its IMU but an offset, and forces on the body.
  bool mayBeOtherStruts(const EvaluatedModel& after) const;

  /// @return shareOfTurning() of the base.
  double turningShare() const { return turning_share_; }

 private:
  const Records& records_;
  const ModelEvaluator& evaluator_;
  const EvaluatedModel& base_;
  double sampling_floor_;  // [m/s^2]
  double turning_share_;
};

}  // namespace suspension_health_monitor
