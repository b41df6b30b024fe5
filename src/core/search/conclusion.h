#pragma once

#include <algorithm>
#include <cmath>

#include "separating_drive.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"

namespace suspension_health_monitor {

/// How much of the body's turning goes with the strut's motion: the share of the mean square of its angular
/// acceleration, about x or y, that travel, travel rate and z'' of a model's free run tell, fitted on the training
/// samples and judged by the rest. A strut that turns its body is not alone on it: something else holds the body, and
/// what that does to the strut's top has the gyro's shape, too, without being a fault of a sensor.
/// @return 0 if the strut's motion explains none of it, or if the body's IMU measures no turning.
inline double shareOfTurning(const Records& records, const HoldOut& held_out, const LinearResponse& motion) {
  const Eigen::Index count = motion.numSamples();
  Eigen::MatrixXd strut(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const StrutMotion& m = motion.motion().samples[k];
    strut.row(k) << m.travel / motion.scale().travel, m.travel_rate / motion.scale().travel_rate, m.body_acceleration;
  }
  const Eigen::VectorXd trained = joined(held_out.training);
  const Eigen::VectorXd judged = Eigen::VectorXd::Ones(count) - trained;
  const Eigen::MatrixXd weighted = trained.asDiagonal() * strut;
  double most = 0.0;
  for (const BodyChannel channel : {BodyChannel::kAngularAccelerationX, BodyChannel::kAngularAccelerationY}) {
    std::vector<std::vector<double>> measured;
    for (const DriveSegment* segment : segmentsOf(records))
      measured.push_back(segment->body[static_cast<std::size_t>(channel)]);
    const Eigen::VectorXd turning = joined(measured);
    if (turning.size() < count) continue;  // not measured in one of the drives
    const Eigen::Vector3d explained = solveSymmetric(strut.transpose() * weighted, weighted.transpose() * turning);
    const double whole = judged.dot(turning.cwiseAbs2());
    if (whole > 0.0) most = std::max(most, 1.0 - judged.dot((turning - strut * explained).cwiseAbs2()) / whole);
  }
  return most;
}

/// A force that goes with the body's own motion, not with the strut's.
inline bool actsOnBody(const ActiveEffect& active) {
  const auto rate = [&](double acceleration) { return active.memoryRate({1.0, 1.0, 1.0, 0.5, acceleration}); };
  return rate(0.0).s != rate(1.0).s || rate(0.0).second != rate(1.0).second;
}

/// The share of what a model leaves above the floor that another one takes.
inline double shareOf(const EvaluatedModel& before, const EvaluatedModel& after, double floor) {
  const double structure = square(before.ranked.held_out_rmse) - square(floor);
  return structure > 0.0 ? (square(before.ranked.held_out_rmse) - square(after.ranked.held_out_rmse)) / structure : 0.0;
}

/// What a search comes to.
class Conclusion {
 public:
  /// @param suspect  the best addition to the base, if any pays.  @param result  to be filled.
  /// The arguments must outlive this object.
  Conclusion(const Records& records, const HoldOut& held_out, const EvaluatedModel& base,
             const std::optional<Selection>& suspect, SearchResult& result)
      : records_(records),
        held_out_(held_out),
        base_(base),
        suspect_(suspect),
        turning_share_(shareOfTurning(records, held_out, LinearResponse(records, base.fit))),
        result_(result) {}

  void conclude(const EvaluatedModel& last) {
    if (!suspect_) result_.noise_floor = floorOf(base_, result_.noise_floor);  // else a law takes a part of it
    result_.structured_share = structuredShare(base_.ranked.held_out_rmse, result_.noise_floor);
    if (result_.structured_share > 0.0)
      result_.surface_share =
          std::min(1.0, Screening(records_, held_out_, base_.fit).surfaceGain() / result_.structured_share);
    const std::size_t names = namesBeyond(base_, last).size();
    const EvaluatedModel& before = names > 1 ? suspect_->chosen : base_;
    if (names > 0 && isExplained(last, before)) return name(Verdict::kEffectFound, last);
    result_.separating.clear();
    // A suspect makes the error smaller by more than half (kMajority of its mean square).
    if (suspect_ && !mayBeOtherStruts(suspect_->chosen) && shareOf(base_, suspect_->chosen, 0.0) > kMajority) {
      noteGroup(*suspect_, records_, result_.separating);
      result_.remainder_surface_share = Screening(records_, held_out_, suspect_->chosen.fit).surfaceGain();
      return name(Verdict::kSuspect, suspect_->chosen);
    }
    const bool structured = suspect_ || isStructured(base_.ranked.held_out_rmse, result_.noise_floor);
    result_.verdict = structured ? Verdict::kUnexplained : Verdict::kNothingMissing;
    result_.base.model.is_complete = !structured;
    if (result_.structured_share > 0.0)
      result_.folded_share = foldedMotion(records_, base_.ranked.model) /
                             (std::sqrt(result_.structured_share) * base_.ranked.held_out_rmse);
    result_.turns_body = turning_share_ > kWorthHaving;
  }

 private:
  void name(Verdict verdict, const EvaluatedModel& model) {
    result_.verdict = verdict;
    result_.selected = namesBeyond(base_, model);
    result_.explained_share = std::min(1.0, shareOf(base_, model, result_.noise_floor));
    result_.extended = model.ranked;
    result_.extended_fit_percent = held_out_.fitPercent(model.ranked.held_out_rmse);
    result_.final_fit = finalFit(model);
    if (result_.final_fit)
      result_.final_fit->model.is_complete = !isStructured(model.ranked.held_out_rmse, result_.noise_floor);
  }

  /// Names are given if the model with them takes all of the structure but what counts as noise (kStructured), and as
  /// much of what the best of them alone leaves, and a fifth of what a law leaves is noise at least. What sampling
  /// loses of the model's own forces, and what a sensor has filtered, is noise.
  /// @param before  the model with the best name alone; the base, if `after` has only one.
  bool isExplained(const EvaluatedModel& after, const EvaluatedModel& before) const {
    if (mayBeOtherStruts(after)) return false;
    const bool only_reading = after.ranked.model.effects.size() == base_.ranked.model.effects.size();
    const auto takesAll = [&](double lowest) {
      const double taken = std::min(shareOf(base_, after, lowest), shareOf(before, after, lowest));
      const double structured = structuredShare(after.ranked.held_out_rmse, lowest);
      return taken > 1.0 - kStructured && (only_reading || structured < 1.0 - kStructured);
    };
    const double lowest = std::hypot(result_.noise_floor, lostInSampling(records_, after.fit));
    if (takesAll(lowest)) return true;
    // The rest may be noise that a sensor has filtered. Where only the reading is to be at fault, that has been there
    // before: no law hid it.
    return !only_reading && takesAll(floorOf(after, lowest));
  }

  /// @return true if other struts of the same body may have done what is taken for something else: on a body that the
  /// strut itself turns, see shareOfTurning(), they imitate any fault of its IMU but an offset, and forces on the body.
  bool mayBeOtherStruts(const EvaluatedModel& after) const {
    if (turning_share_ <= kWorthHaving) return false;
    const StrutModel &given = base_.ranked.model, &model = after.ranked.model;
    return std::any_of(model.effects.begin() + given.effects.size(), model.effects.end(), actsOnBody) ||
           std::any_of(model.reading.begin() + given.reading.size(), model.reading.end(),
                       [](const ActiveMeasurementEffect& fault) { return fault.effect.name != "accelerometer_bias"; });
  }

  /// @return the noise floor of what a model leaves, see floorOfResidual().
  double floorOf(const EvaluatedModel& after, double floor) const {
    return floorOfResidual(after.ranked.held_out_rmse, floor, after.fit.residuals,
                           mapped(segmentsOf(records_), &DriveSegment::unsprung), records_.front()->period(),
                           after.ranked.model)
        .rms;
  }

  // To all samples; if the solver does not get there, the numbers of the fit that was judged are not worse than none.
  FittedModel finalFit(const EvaluatedModel& last) const {
    const FitOutcome fit = fitOutputError(records_, {}, last.ranked.model, last.fit.initial);
    return fit ? FittedModel{fit->model, fit->stddev, true} : FittedModel{last.fit.model, last.fit.stddev, false};
  }

  const Records& records_;
  const HoldOut& held_out_;
  const EvaluatedModel& base_;
  const std::optional<Selection>& suspect_;
  double turning_share_;
  SearchResult& result_;
};

}  // namespace suspension_health_monitor
