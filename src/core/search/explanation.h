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

  /// Names are given if the model with them takes all of the structure but what counts as noise (kStructured), and as
  /// much of what the best of them alone leaves. What sampling loses of the model's own forces, and what a sensor has
  /// filtered, is noise.
  /// @param before  the model with the best name alone; the base, if `after` has only one.
  bool isExplained(const EvaluatedModel& after, const EvaluatedModel& before, double floor) const;

  /// A suspect makes the error smaller by more than half (kMostOfIt of its mean square).
  bool isSuspect(const EvaluatedModel& after) const;

  /// @return true if other struts of the same body may have done what is taken for something else: on a body that the
  /// strut itself turns, see shareOfTurning(), they imitate any fault of its IMU but an offset, and forces on the body.
  bool mayBeOtherStruts(const EvaluatedModel& after) const;

  /// @return shareOfTurning() of the base.
  double turningShare() const { return turning_share_; }

 private:
  const Records& records_;
  const EvaluatedModel& base_;
  double turning_share_;
};

}  // namespace suspension_health_monitor
