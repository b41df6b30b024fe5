#include "suspension_health_monitor/internal/search/effect_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model_evaluator.h"
#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kStarted = 0.1, kForward = 0.85;  // of the progress

using Names = std::vector<std::string>;

constexpr const char* kTilt = "mount_tilt";

/// A sensor that is tilted by an angle reads its cosine of all that happens along the strut, gravity above all. What
/// leaks in from across need not show it: of the wheel's IMU nothing else is known.
/// @return true if a fault of the model's reading is an offset or a gain that a tilt of up to 30 degrees makes as well,
/// in drives whose sensors read gravity.
bool mayBeTilt(const StrutModel& model, const std::string& fault, const Records& records) {
  const bool is_read = std::all_of(records.begin(), records.end(), [](const DriveRecord* record) {
    return record->gravity() > 0.5 * kStandardGravity;
  });
  const double lost_by_30_degrees = 1.0 - std::cos(M_PI / 6.0);
  const double unit = fault == "accelerometer_bias" ? kStandardGravity : fault == "scale_error" ? 1.0 : 0.0;
  return is_read && std::any_of(model.reading.begin(), model.reading.end(), [&](const ActiveMeasurementEffect& active) {
           return active.effect.name == fault && std::abs(active.coefficients.front()) < lost_by_30_degrees * unit;
         });
}

/// How much of the body's turning goes with the strut's motion: the share of the mean square of its angular
/// acceleration, about x or y, that travel, travel rate and z'' of a model's free run tell, fitted on the training
/// samples and judged by the rest. A strut that turns its body is not alone on it: something else holds the body, and
/// what that does to the strut's top has the gyro's shape, too, without being a fault of a sensor.
/// @return 0 if the strut's motion explains none of it, or if the body's IMU measures no turning.
double shareOfTurning(const Records& records, const HoldOut& held_out, const LinearResponse& motion) {
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
bool actsOnBody(const ActiveEffect& active) {
  const auto rate = [&](double acceleration) { return active.memoryRate({1.0, 1.0, 1.0, 0.5, acceleration}); };
  return rate(0.0).s != rate(1.0).s || rate(0.0).second != rate(1.0).second;
}

constexpr double kStraight = 0.005;  // of a reading: the nonlinearity of accelerometers

/// How many times as large the motion of a kind of drive is as that of the present one.
constexpr std::pair<DriveKind, MotionScale> kDriveChanges[] = {
    {DriveKind::kMoreTravel, {2.0, 2.0, 1.0}},   {DriveKind::kLessTravel, {1.0 / 3.0, 1.0 / 3.0, 1.0}},
    {DriveKind::kSlower, {1.0, 1.0 / 3.0, 1.0}}, {DriveKind::kQuicker, {1.0, 3.0, 1.0}},
    {DriveKind::kLonger, {1.0, 1.0, 3.0}},
};

Eigen::VectorXd totalForce(const StrutModel& model, const SegmentedMotion& motion) {
  const Eigen::MatrixXd forces = forcesAlong(model, motion);
  Eigen::VectorXd total = model.damping_to_mass * forces.col(0) + model.stiffness_to_mass * forces.col(1);
  for (std::size_t j = 0; j < model.effects.size(); ++j) total += model.effects[j].coefficient * forces.col(2 + j);
  return total;
}

/// rms difference of the least different model from the first, as a share of the first one's force.
/// @param motion  of the present drives.  @param change  its factors.
double leastDifference(SegmentedMotion motion, const std::vector<StrutModel>& models, const MotionScale& change) {
  for (StrutMotion& m : motion.samples) {
    m.travel *= change.travel;
    m.travel_rate *= change.travel_rate;
    m.time *= change.time;
  }
  const Eigen::VectorXd first = totalForce(models.front(), motion);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < models.size(); ++i)
    least = std::min(least, (totalForce(models[i], motion) - first).norm() / first.norm());
  return least;
}

/// The best of a ranking, or the simplest that is as good, and all that cannot be told from the best.
struct Selection {
  EvaluatedModel chosen;
  std::vector<std::string> group;
  std::vector<StrutModel> models;  ///< of the group
};

/// A number more must pay as surely as another effect: a simpler rival is as good until it is clear that it is not.
/// A rival whose z'' is hardly another one cannot be told from the best, however sure a long drive would be: no sensor
/// is as straight, and what a filter before the sampling makes of a law may be what another law says (dry friction
/// turns round as a digressive damper does).
/// @pre the first of the ranking is fitted.
Selection select(const std::vector<EvaluatedModel>& ranking, const HoldOut& held_out) {
  const EvaluatedModel& best = ranking.front();
  Selection selection{best, {}, {}};
  for (const EvaluatedModel& rival : ranking) {
    if (!rival.ranked.fitted) continue;
    const bool simpler = complexity(rival.ranked.model) < complexity(best.ranked.model);
    const double chance = simpler ? kFalseAlarm / static_cast<double>(ranking.size()) : kSure;
    const PairedTest gain = rival.gainOf(best);
    const bool is_resolved = rival.loss - best.loss > square(kStraight) * held_out.measuredSquares();
    const bool is_worse = gain.removed_share > kWorthHaving || isSignificant(gain, chance);
    if (is_worse && is_resolved) continue;
    selection.group.push_back(rival.added);
    selection.models.push_back(rival.ranked.model);
    if (!is_worse && complexity(rival.ranked.model) < complexity(selection.chosen.ranked.model))
      selection.chosen = rival;
  }
  return selection;
}

/// The kind of drive on which models differ that the present drives cannot tell apart: of several kinds (rougher,
/// smoother, slower, quicker, longer) the one in which the least different of them differs most from the first, their
/// forces taken along the present motion scaled to that kind. kNoneHelps if none makes it at least twice as much.
SeparatingDrive separatingDrive(const SegmentedMotion& present, const Selection& selection) {
  const double here = leastDifference(present, selection.models, {1.0, 1.0, 1.0});
  SeparatingDrive best{selection.group, DriveKind::kNoneHelps, kClearlyMore * here, here};
  for (const auto& [kind, change] : kDriveChanges) {
    const double there = leastDifference(present, selection.models, change);
    if (!(there > best.difference_there)) continue;
    best.kind = kind;
    best.difference_there = there;
  }
  return best;
}

/// What is in a model and was not in the one that the search started with.
Names namesBeyond(const EvaluatedModel& base, const EvaluatedModel& model) {
  Names added;
  for (const std::string& name : model.ranked.effects)
    if (!contains(base.ranked.effects, name)) added.push_back(name);
  return added;
}

/// The residual from which on a fit counts outliers.
double outlierOf(const ModelFit& fit) {
  const Eigen::VectorXd all = joined(fit.residuals);
  const double size = robustDeviation({all.data(), all.data() + all.size()});
  return size > 0.0 ? kOutlierScale * size : 1.0;
}

std::vector<RankedModel> asReported(const std::vector<EvaluatedModel>& ranking) {
  std::vector<RankedModel> models = mapped(ranking, &EvaluatedModel::ranked);
  std::stable_sort(models.begin(), models.end(),
                   [](const RankedModel& a, const RankedModel& b) { return a.held_out_rmse < b.held_out_rmse; });
  return models;
}

/// The share of what a model leaves above the floor that another one takes.
double shareOf(const EvaluatedModel& before, const EvaluatedModel& after, double floor) {
  const double structure = square(before.ranked.held_out_rmse) - square(floor);
  return structure > 0.0 ? (square(before.ranked.held_out_rmse) - square(after.ranked.held_out_rmse)) / structure : 0.0;
}

class Search {
 public:
  Search(const Records& records, const HoldOut& held_out, const DiagnoseOptions& options,
         const ModelEvaluator& evaluator)
      : records_(records), held_out_(held_out), options_(options), evaluator_(evaluator) {}

  /// @param keeps  whether a search goes on with the rough model as it is where no fit comes of it.
  SearchResult run(const ModelFit& rough, bool keeps) {
    base_ = evaluator_.evaluate(rough.model, rough.initial, nullptr);
    if (!base_.ranked.fitted && keeps) base_ = evaluator_.asItIs(rough);
    if (!base_.ranked.fitted) {
      result_.shortcoming = Shortcoming::kNoStableFit;
      return result_;
    }
    report(kStarted);
    result_.base = base_.ranked;
    result_.base_fit_percent = held_out_.fitPercent(base_.ranked.held_out_rmse);
    result_.noise_floor = estimateNoiseFloor(records_, base_.ranked.model);
    turning_share_ = shareOfTurning(records_, held_out_, LinearResponse(records_, base_.fit));
    EvaluatedModel last = extend(base_, 0);
    if (namesBeyond(base_, last).size() > 1) last = extendRivals(last);
    last = refine(last);
    // Several names that explain no more than the first one alone give way to it.
    if (namesBeyond(base_, last).size() > 1 && !evaluator_.isWorthHaving(suspect_->chosen, last)) {
      result_.separating.clear();
      last = suspect_->chosen;
      noteGroup(*suspect_);
    }
    result_.noise_floor = std::min(result_.noise_floor, last.ranked.held_out_rmse);
    conclude(last);
    result_.indistinguishable = mapped(result_.separating, &SeparatingDrive::group);
    report(1.0);
    return result_;
  }

 private:
  void report(double share) const {
    if (options_.progress) options_.progress(share);
  }

  void noteGroup(const Selection& selection) {
    if (mayBeTilt(selection.chosen.ranked.model, selection.chosen.added, records_)) {
      Names group = selection.group;
      if (!contains(group, kTilt)) group.emplace_back(kTilt);
      result_.separating.push_back({group, DriveKind::kAtRest, 0.0, 0.0});
      return;
    }
    if (selection.group.size() > 1)
      result_.separating.push_back(separatingDrive(LinearResponse(records_, selection.chosen.fit).motion(), selection));
  }

  // Forward selection: the best addition as long as it pays.
  // @param round  how many the model has already.
  EvaluatedModel extend(EvaluatedModel current, int round) {
    for (; round < options_.most_effects; ++round) {
      const double done = kStarted + kForward * round / options_.most_effects;
      const auto tick = [&](double share) { report(done + kForward * share / options_.most_effects); };
      std::vector<EvaluatedModel> ranking = evaluator_.rankAdditions(current, tick);
      if (round > 0)
        ranking.erase(std::remove_if(ranking.begin(), ranking.end(),
                                     [this](const EvaluatedModel& each) { return !standsAlone(each); }),
                      ranking.end());
      if (round == 0) result_.ranking = asReported(ranking);
      if (ranking.empty() || !ranking.front().ranked.fitted) break;
      if (current.ranked.held_out_rmse < accuracyOfFreeRuns(records_)) break;
      // Whatever a free run leaves of data that it was not fitted to is above the floor.
      result_.noise_floor = std::min(result_.noise_floor, ranking.front().ranked.held_out_rmse);
      if (!ranking.front().ranked.significant) break;
      const Selection selection = select(ranking, held_out_);
      if (round == 0) {
        suspect_ = selection;
        rivals_ = std::move(ranking);
      }
      current = withoutSuperfluous(selection.chosen);
    }
    return current;
  }

  // If several effects are missing, the one that explains most alone need not be among them: a law with more numbers
  // takes a part of each. So every other one that was fitted is tried as the first.
  EvaluatedModel extendRivals(EvaluatedModel best) {
    for (const EvaluatedModel& rival : rivals_) {
      if (!rival.ranked.significant || contains(namesBeyond(base_, best), rival.added)) continue;
      const EvaluatedModel other = extend(rival, 1);
      if (other.loss < best.loss && complexity(other.ranked.model) <= complexity(best.ranked.model)) best = other;
    }
    return best;
  }

  // Chooses each of several effects again, beside the others. That may make one superfluous, which changes what the
  // others are confused with.
  EvaluatedModel refine(EvaluatedModel current) {
    const Names found = namesBeyond(base_, current);
    const bool only_suspect = found.size() == 1 && found.front() == suspect_->chosen.added;
    if (only_suspect) noteGroup(*suspect_);
    for (bool changed = !found.empty() && !only_suspect; changed;) {
      result_.separating.clear();
      const auto tick = [this](double) { report(kStarted + kForward); };
      current = reconsidered(current, namesBeyond(base_, current), tick);
      const std::size_t before = current.ranked.effects.size();
      current.added.clear();  // none is too new to go
      current = withoutSuperfluous(current);
      changed = current.ranked.effects.size() < before;
    }
    return current;
  }

  // What the first effect explained, the later ones may explain better together.
  EvaluatedModel withoutSuperfluous(EvaluatedModel current) const {
    const std::string newest = current.added;
    for (const std::string& name : namesBeyond(base_, current)) {
      if (name == newest) continue;
      const EvaluatedModel without = evaluator_.without(current, name);
      if (without.ranked.fitted && !evaluator_.isWorthHaving(without, current)) current = without;
    }
    return current;
  }

  // Each effect was chosen before the later ones were known: is it still the one, and with which others is it confused?
  EvaluatedModel reconsidered(EvaluatedModel current, const Names& added, const ModelEvaluator::Tick& tick) {
    for (const std::string& name : added) {
      const EvaluatedModel without = evaluator_.without(current, name);
      if (!without.ranked.fitted) continue;
      const std::vector<EvaluatedModel> ranking = evaluator_.rankAdditions(without, tick);
      if (ranking.empty() || !ranking.front().ranked.fitted) continue;
      const Selection selection = select(ranking, held_out_);
      noteGroup(selection);
      if (!contains(selection.group, name) ||
          complexity(selection.chosen.ranked.model) < complexity(current.ranked.model))
        current = selection.chosen;
    }
    return current;
  }

  // A sensor's fault is one on any drive: what helps only beside other effects imitates a part of theirs.
  bool standsAlone(const EvaluatedModel& candidate) const {
    const std::vector<ActiveMeasurementEffect>& readings = candidate.ranked.model.reading;
    if (!candidate.ranked.significant || readings.empty() || readings.back().effect.name != candidate.added)
      return true;
    StrutModel alone = base_.ranked.model;
    alone.reading.push_back(readings.back());
    const EvaluatedModel evaluated = evaluator_.evaluate(alone, base_.fit.initial, &base_);
    return evaluated.ranked.significant;
  }

  /// @return the noise floor of what a model leaves, see floorOfResidual().
  double floorOf(const EvaluatedModel& after, double floor) const {
    return floorOfResidual(after.ranked.held_out_rmse, floor, after.fit.residuals,
                           seriesOf(segmentsOf(records_), &DriveSegment::unsprung), records_.front()->period(),
                           after.ranked.model)
        .rms;
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
      noteGroup(*suspect_);
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

  // To all samples; if the solver does not get there, the numbers of the fit that was judged are not worse than none.
  FittedModel finalFit(const EvaluatedModel& last) const {
    const FitOutcome fit = fitOutputError(records_, {}, last.ranked.model, last.fit.initial);
    return fit ? FittedModel{fit->model, fit->stddev, true} : FittedModel{last.fit.model, last.fit.stddev, false};
  }

  const Records& records_;
  const HoldOut& held_out_;
  const DiagnoseOptions& options_;
  const ModelEvaluator& evaluator_;
  EvaluatedModel base_;
  std::optional<Selection> suspect_;    // the best addition to the base
  std::vector<EvaluatedModel> rivals_;  // all that were tried for it
  double turning_share_ = 0.0;          // shareOfTurning() of the base
  SearchResult result_;
};

SearchResult without(Shortcoming shortcoming) {
  SearchResult nothing;
  nothing.shortcoming = shortcoming;
  return nothing;
}

}  // namespace

SearchResult searchEffects(const Records& records, const StrutModel& start, const DiagnoseOptions& options,
                           const std::optional<StrutModel>& lagged) {
  if (segmentsOf(records).empty()) return without(Shortcoming::kTooShort);
  FitOutcome rough = fitOutputError(records, {}, start);
  if (!rough && lagged)
    rough = withoutFit(records, {lagged->damping_to_mass, lagged->stiffness_to_mass, start.effects, start.reading});
  if (!rough) return without(Shortcoming::kNoStableFit);
  const std::optional<HoldOut> held_out = splitHoldOut(records, rough->model.stiffness_to_mass);
  if (!held_out) return without(Shortcoming::kTooShort);
  const ModelEvaluator evaluator(records, *held_out, outlierOf(*rough), start.effects.size() + options.most_forces,
                                 options, lagged);
  return Search(records, *held_out, options, evaluator).run(*rough, lagged.has_value());
}

}  // namespace suspension_health_monitor
