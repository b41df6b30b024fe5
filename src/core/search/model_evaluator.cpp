#include "model_evaluator.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <future>
#include <numeric>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/fit/free_form.h"
#include "suspension_health_monitor/internal/fit/rough_strut.h"
#include "suspension_health_monitor/internal/signal/filters.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kFitted = 4;       // best candidates that are fitted in any case
constexpr double kPromising = 0.8;       // share of the best candidate's gain that is worth a fit, too
constexpr double kScreeningError = 1.2;  // by how much screening may overestimate a loss
constexpr double kScreeningTime = 0.4;   // of a round

std::vector<std::string> namesOf(const StrutModel& model) {
  std::vector<std::string> names;
  for (const ActiveEffect& active : model.effects) names.push_back(active.effect.name);
  for (const ActiveMeasurementEffect& reading : model.reading) names.push_back(reading.effect.name);
  return names;
}

// It may do so in the stretches that are held out alone.
FitFailure runningAway(const EvaluatedModel& evaluated) {
  return std::isfinite(evaluated.ranked.held_out_rmse) ? FitFailure::kNone : FitFailure::kRunsAway;
}

/// Calls work(i) for i = 0 .. count - 1 on several threads, the calling one among them, and tick() on the calling
/// thread after each of its own items. What tick() throws ends the work early and passes on. work must not throw.
template <class Work, class Tick>
void forEachInParallel(std::size_t count, int threads, const Work& work, const Tick& tick) {
  std::atomic<std::size_t> next{0};
  const auto takeItems = [&](const auto& after) {
    for (std::size_t i = next++; i < count; i = next++) {
      work(i);
      after();
    }
  };
  std::vector<std::future<void>> helpers;  // their end waits for the threads
  for (int i = 1; i < threads && static_cast<std::size_t>(i) < count; ++i)
    helpers.push_back(std::async(std::launch::async, [&] { takeItems([] {}); }));
  try {
    takeItems(tick);
  } catch (...) {
    next = count;
    throw;
  }
}

constexpr std::size_t kMostRows = 4000;   // a start need not be better than the noise in them allows
constexpr double kStretchPeriods = 32.0;  // natural periods: long against the memory of any law

/// The parts of a segment that are looked at: all of it, or stretches that are spread evenly over it.
/// @param share  of the samples, 0 .. 1.
std::vector<std::pair<std::size_t, std::size_t>> stretchesOf(std::size_t size, std::size_t length, double share) {
  if (share >= 1.0) return {{0, size}};
  std::vector<std::pair<std::size_t, std::size_t>> stretches;
  const auto step = static_cast<std::size_t>(static_cast<double>(length) / share);
  for (std::size_t first = 0; first < size; first += step)
    stretches.emplace_back(first, std::min(size, first + length));
  return stretches;
}

/// Where a fit of a law may begin that the linear response cannot tell: one with a kink or a memory that carries so
/// much of the strut's force that b1 and b0 without it are far from those beside it.
///
/// The travel is told by the measurements themselves, d'' = w'' - z'', integrated twice and once by an integral that
/// forgets what is slower than a third of the natural frequency (motionError()). Along it the law is one more column of
///   z'' = b1 v + b0 d + sum_j c_j f_j + c f,
/// each behind the filter of the drive if it has one, by least squares over the training samples, shape by shape of the
/// scan. Of long drives stretches are looked at, evenly spread. Too coarse for an estimate: the noise of the sensors is
/// in d and v; it does for a start.
class RowStart {
 public:
  /// @param fit  the present model: its effects stay, with their shapes.
  RowStart(const Records& records, const HoldOut& held_out, const ModelFit& fit) : fit_(fit) {
    const double b0 = fit.model.stiffness_to_mass;
    const std::vector<const DriveSegment*> segments = segmentsOf(records);
    double samples = 0.0;
    for (const DriveSegment* segment : segments) samples += static_cast<double>(segment->size());
    std::vector<double> measured, weight;
    double travel = 0.0, rate = 0.0;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const DriveSegment& segment = *segments[s];
      std::vector<double> relative = segment.driving;
      for (std::size_t k = 0; k < relative.size(); ++k) relative[k] -= segment.sprung[k];
      const MotionError motion = motionError(relative, meanOf({relative}), segment.period, b0);
      const auto length =
          static_cast<std::size_t>(std::ceil(kStretchPeriods * 2.0 * M_PI / (std::sqrt(b0) * segment.period)));
      for (const auto& [first, end] : stretchesOf(segment.size(), length, kMostRows / samples)) {
        for (std::size_t k = first; k < end; ++k) {
          motion_.push_back({motion.travel[k], motion.travel_rate[k], segment.timeDriven(k), 0.0, segment.sprung[k]});
          measured.push_back(segment.sprung[k]);
          const bool is_whole = k >= first + segment.lead() && k + segment.lead() < end;  // what the filter reaches
          weight.push_back(is_whole ? held_out.training[s][k] : 0.0);
          travel += square(motion.travel[k]);
          rate += square(motion.travel_rate[k]);
        }
        ends_.push_back(motion_.size());
        taps_.push_back(segment.taps);
      }
    }
    const auto count = static_cast<Eigen::Index>(motion_.size());
    scale_ = {std::sqrt(travel / static_cast<double>(count)), std::sqrt(rate / static_cast<double>(count)),
              1.0 / std::sqrt(b0)};
    Eigen::MatrixXd common = forcesAlong(fit.model, motion_, ends_);
    for (Eigen::Index j = 0; j < common.cols(); ++j) passLow(common.col(j));
    rows_ = WeightedProjection(common, Eigen::Map<const Eigen::VectorXd>(weight.data(), count),
                               Eigen::Map<const Eigen::VectorXd>(measured.data(), count));
  }

  struct Start {
    StrutModel model;    ///< the present one with the effect added
    double share = 0.0;  ///< of what the rows without the effect leave that it takes
  };

  /// @return nothing if no shape leaves a damped spring and a coefficient of the right sign.
  std::optional<Start> with(const ForceEffect& effect) const {
    std::optional<Start> best;
    if (effect.lasts) return best;  // stretches know no heat
    const double left = rows_.left();
    for (const std::vector<double>& shapes : scanShapes(effect, scale_)) {
      Eigen::VectorXd column = forceAlong(effect, shapes, motion_, ends_);
      passLow(column);
      const auto part = rows_.project(column);
      if (!part) continue;
      const double coefficient = part->coefficients[0], share = part->gain / left;
      if (!(share > (best ? best->share : 0.0)) || (effect.positive && !(coefficient > 0.0))) continue;
      StrutModel model = fit_.model;
      model.damping_to_mass = part->common[0];
      model.stiffness_to_mass = part->common[1];
      if (!isDampedSpring(model)) continue;
      for (std::size_t j = 0; j < model.effects.size(); ++j)
        model.effects[j].coefficient = part->common[2 + static_cast<Eigen::Index>(j)];
      model.effects.push_back({effect, coefficient, shapes});
      best = Start{model, share};
    }
    return best;
  }

 private:
  void passLow(Eigen::Ref<Eigen::VectorXd> column) const {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      auto stretch = column.segment(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(ends_[i] - begin));
      stretch = lowPassed(taps_[i], stretch);
      begin = ends_[i];
    }
  }

  const ModelFit& fit_;
  std::vector<StrutMotion> motion_;        // per sample of all stretches
  std::vector<std::size_t> ends_;          // of the stretches
  std::vector<std::vector<double>> taps_;  // of the filter of each stretch
  MotionScale scale_;
  WeightedProjection rows_;  // of z'' by v, d and the forces of the present effects; weight 0 where held out
};

constexpr double kWindow = 4.0;  // natural periods

/// A function by points (x, y), in straight lines between them and on along the outermost ones.
using Polyline = std::vector<std::pair<double, double>>;

double at(const Polyline& points, double x) {
  if (points.empty()) return 0.0;
  const auto after = std::lower_bound(points.begin() + 1, points.end() - 1, x,
                                      [](const auto& point, double value) { return point.first < value; });
  const auto& [x0, y0] = *(after - 1);
  return y0 + (x - x0) / (after->first - x0) * (after->second - y0);
}

/// @return of every window ln of rms velocity over rms position of the wheel, and the time in its middle [s].
Polyline windowsOf(const Records& records, double stiffness_to_mass) {
  const double length_in_time = kWindow * 2.0 * M_PI / std::sqrt(stiffness_to_mass);
  Polyline windows;
  for (const DriveSegment* segment : segmentsOf(records)) {
    const MotionError wheel = motionError(segment->unsprung, 0.0, segment->period, stiffness_to_mass);
    const auto length = static_cast<std::size_t>(std::ceil(length_in_time / segment->period));
    for (std::size_t first = 0; first + length <= segment->size(); first += length) {
      double position = 0.0, velocity = 0.0;
      for (std::size_t k = first; k < first + length; ++k) {
        position += square(wheel.travel[k]);
        velocity += square(wheel.travel_rate[k]);
      }
      if (!(position > 0.0 && velocity > 0.0)) continue;
      windows.emplace_back(0.5 * std::log(velocity / position), segment->timeDriven(first + length / 2));
    }
  }
  return windows;
}

/// The time that a window's frequency tells, by its own time: by the windows whose frequencies are next to its own, one
/// below and one above, not by its own time. At the ends by the two next ones.
Polyline toldByFrequency(Polyline windows) {
  Polyline result;
  if (windows.size() < 3) return result;
  std::sort(windows.begin(), windows.end());
  const auto time = [&](std::size_t i) { return windows[i].second; };
  const auto last = windows.size() - 1;
  result.emplace_back(time(0), 2.0 * time(1) - time(2));
  for (std::size_t i = 1; i < last; ++i) result.emplace_back(time(i), (time(i - 1) + time(i + 1)) / 2.0);
  result.emplace_back(time(last), 2.0 * time(last - 1) - time(last - 2));
  std::sort(result.begin(), result.end());
  return result;
}

/// s of the last effect over time.
Polyline lastMemories(const ModelFit& fit, const Records& records) {
  Polyline points;
  std::vector<double> predicted;
  std::vector<StrutState> motion;
  const std::vector<const DriveSegment*> segments = segmentsOf(records);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!runFree(fit.model, *segments[s], fit.initial[s], predicted, &motion)) continue;
    for (std::size_t k = 0; k < motion.size(); ++k)
      points.emplace_back(segments[s]->timeDriven(k), motion[k].memory[fit.model.effects.size() - 1].s);
  }
  return points;
}

/// @return true if the force depends on time at some motion, or on a memory that lasts.
bool changesSlowly(const ActiveEffect& active) {
  if (active.effect.lasts) return true;
  const auto force = [&](double time) { return active.effect.force({1.0, 1.0, time, 0.5}, active.shapes.data()); };
  return force(0.0) != force(1.0) || force(1.0) != force(std::sqrt(2.0));
}

/// The rival of the last law of a fit, which changes slowly: the same with the time that the frequency of the wheel's
/// motion tells, or with what it remembered at that time.
/// Where that does as well, as on a sweep, nobody can tell a part that wears from one that answers to frequency.
/// Frequency: ln of rms velocity over rms position of the wheel (motionError() of w'') in windows of four natural
/// periods. It tells the mean time of the two windows that are next in frequency; in straight lines between the
/// middles.
ForceEffect frequencyRival(const ModelFit& fit, const Records& records, double stiffness_to_mass) {
  const ActiveEffect& last = fit.model.effects.back();
  const ForceEffect& effect = last.effect;
  const Polyline told = toldByFrequency(windowsOf(records, stiffness_to_mass));
  ForceEffect rival = effect;
  if (effect.lasts) {
    rival.memory_rate = {};
    rival.lasts = false;
    rival.shapes.clear();
    rival.force = [told, law = effect.force, memory = lastMemories(fit, records), known = last.shapes](
                      const StrutMotion& motion, const double*) {
      StrutMotion there = motion;
      there.memory = at(memory, at(told, motion.time));
      return law(there, known.data());
    };
    return rival;
  }
  const auto instead = [told](const auto& law) {
    return [told, law](const StrutMotion& motion, const double* shapes) {
      StrutMotion there = motion;
      there.time = at(told, motion.time);
      return law(there, shapes);
    };
  };
  rival.force = instead(effect.force);
  if (effect.memory_rate) rival.memory_rate = instead(effect.memory_rate);
  return rival;
}

/// How far a residual wanders more slowly than the strut moves [m/s^2, rms]. Any strut passes what is slow as it is, so
/// that no law of one leaves this: it is a reading that wanders, as that of a body that leans does, or of a sensor that
/// drifts. It is what the means over neighbouring windows of a natural period have in common; noise has nothing.
/// @param natural_period  [samples].
double wandering(const Residuals& residuals, double natural_period) {
  const auto length = static_cast<std::size_t>(std::max(1.0, std::ceil(natural_period)));
  const double mean = meanOf(residuals);
  double products = 0.0, count = 0.0;
  for (const std::vector<double>& segment : residuals) {
    double last = 0.0;
    for (std::size_t first = 0; first + length <= segment.size(); first += length) {
      double sum = 0.0;
      for (std::size_t k = first; k < first + length; ++k) sum += segment[k] - mean;
      if (first > 0) {
        products += last * sum;
        count += square(static_cast<double>(length));
      }
      last = sum;
    }
  }
  return products > 0.0 ? std::sqrt(products / count) : 0.0;
}

/// @return true if a fault of the reading makes an offset above all, and that is not larger than what wanders beside
/// it: then it is no constant, and no fault of a sensor.
bool isWanderingOffset(const Residuals& before, const Residuals& after, double natural_period) {
  const double offset = meanOf(before) - meanOf(after);
  return square(offset) > kMostOfIt * (meanSquare(before) - meanSquare(after)) &&
         std::abs(offset) < normalQuantile(kSure) * wandering(after, natural_period);
}

}  // namespace

std::size_t complexity(const StrutModel& model) { return numbersOf(model).size() - 2; }

ModelEvaluator::ModelEvaluator(const Records& records, const HoldOut& held_out, double outlier, std::size_t most_forces,
                               const DiagnoseOptions& options, const std::optional<StrutModel>& lagged)
    : records_(records),
      held_out_(held_out),
      outlier_(outlier),
      most_forces_(std::min(most_forces, kMostEffects)),
      options_(options),
      lagged_(lagged) {}

EvaluatedModel ModelEvaluator::weighed(const StrutModel& model, const Residuals& residuals) const {
  EvaluatedModel evaluated;
  evaluated.ranked.model = model;
  evaluated.ranked.effects = namesOf(model);
  evaluated.ranked.held_out_rmse = held_out_.rmse(held_out_.stretchErrors(residuals));
  evaluated.stretches = held_out_.stretchLosses(residuals, outlier_);
  evaluated.independent = held_out_.independentSquares(residuals);
  evaluated.loss = std::accumulate(evaluated.stretches.begin(), evaluated.stretches.end(), 0.0);
  return evaluated;
}

void ModelEvaluator::rank(const EvaluatedModel& before, EvaluatedModel& evaluated) const {
  evaluated.ranked.error_removed_percent =
      100.0 * (1.0 - square(evaluated.ranked.held_out_rmse / before.ranked.held_out_rmse));
  evaluated.ranked.significance = before.gainOf(evaluated).t;
  evaluated.ranked.significant = evaluated.ranked.fitted && isWorthHaving(before, evaluated);
}

bool ModelEvaluator::isWorthHaving(const EvaluatedModel& before, const EvaluatedModel& after) const {
  const auto tests = static_cast<double>(options_.candidates.forces.size() + options_.candidates.readings.size());
  return before.loss - after.loss > kWorthHaving * after.to_explain &&
         isSignificant(before.gainOf(after), kFalseAlarm / tests);
}

// What the user's own model has is not questioned.
FitFailure ModelEvaluator::againstPhysics(const ModelFit& fit) const {
  const std::size_t given = options_.model ? options_.model->effects.size() : 0;
  for (std::size_t j = given; j < fit.model.effects.size(); ++j) {
    const ActiveEffect& active = fit.model.effects[j];
    if (active.effect.positive && !(active.coefficient > 0.0)) return FitFailure::kWrongSign;
    if (hasShapeAtEnd(active, fit.motion)) return FitFailure::kShapeAtEnd;
  }
  // A strut carries its body: an effect that makes the spring superfluous does something else's work.
  const bool is_spring = fit.model.stiffness_to_mass > normalQuantile(kFalseAlarm) * fit.stddev[1];
  if (fit.model.effects.size() > given && !is_spring) return FitFailure::kNoSpring;
  return FitFailure::kNone;
}

EvaluatedModel ModelEvaluator::failed(const EvaluatedModel& before, FitFailure failure) const {
  EvaluatedModel nothing = before;
  nothing.ranked.fitted = nothing.ranked.significant = false;
  nothing.ranked.failure = failure;
  nothing.ranked.error_removed_percent = nothing.ranked.significance = nothing.training_gain = 0.0;
  nothing.tried = true;
  return nothing;
}

EvaluatedModel ModelEvaluator::evaluate(const StrutModel& start, const std::vector<StrutState>& initial,
                                        const EvaluatedModel* before) const {
  const FitOutcome fit = fitOutputError(records_, held_out_.training, start, initial);
  const FitFailure failure = fit ? againstPhysics(*fit) : fit.failure;
  const auto without = [&](FitFailure why) { return failed(before != nullptr ? *before : EvaluatedModel(), why); };
  if (failure != FitFailure::kNone) return without(failure);
  EvaluatedModel evaluated = weighed(fit->model, fit->residuals);
  if (const FitFailure held_out = runningAway(evaluated); held_out != FitFailure::kNone) return without(held_out);
  evaluated.fit = *fit;
  evaluated.ranked.fitted = true;
  evaluated.to_explain = before != nullptr ? before->to_explain : evaluated.loss;
  if (before != nullptr) rank(*before, evaluated);
  return evaluated;
}

EvaluatedModel ModelEvaluator::asItIs(const ModelFit& fit) const {
  EvaluatedModel evaluated = weighed(fit.model, fit.residuals);
  evaluated.fit = fit;
  evaluated.ranked.failure = runningAway(evaluated);
  evaluated.ranked.fitted = evaluated.ranked.failure == FitFailure::kNone;
  evaluated.to_explain = evaluated.loss;
  return evaluated;
}

// A delay is linear only where it is short against the motion.
std::optional<ScreenedModel> ModelEvaluator::screen(const Screening& screening,
                                                    const MeasurementEffect& reading) const {
  std::optional<ScreenedModel> screened = screening.screen(reading);
  if (!lagged_ || lagged_->reading.front().effect.name != reading.name) return screened;
  StrutModel model = screening.model();
  model.damping_to_mass = lagged_->damping_to_mass;
  model.stiffness_to_mass = lagged_->stiffness_to_mass;
  model.reading.push_back(lagged_->reading.front());
  std::optional<ScreenedModel> second = screening.asItIs(model);
  return second && (!screened || second->training_gain > screened->training_gain) ? second : screened;
}

std::vector<EvaluatedModel> ModelEvaluator::screenAll(const EvaluatedModel& current, const Tick& tick) const {
  const Screening screening(records_, held_out_, current.fit);
  const RowStart row_start(records_, held_out_, current.fit);
  const double to_gain = held_out_.trainingError(current.fit.residuals);
  const std::vector<ForceEffect>& forces = options_.candidates.forces;
  const std::vector<MeasurementEffect>& readings = options_.candidates.readings;
  const std::size_t count = forces.size() + readings.size();
  std::vector<std::optional<EvaluatedModel>> results(count);
  const std::vector<std::string>& present = current.ranked.effects;
  const auto note = [&](std::size_t i, const std::string& name, const ScreenedModel& screened) {
    EvaluatedModel& result = results[i].emplace();
    FitFailure failure = screened.failure;
    if (failure == FitFailure::kNone) {
      result = weighed(screened.model, screened.residuals);
      failure = runningAway(result);
    }
    if (failure == FitFailure::kNone) {
      result.training_gain = screened.training_gain;
      result.to_explain = current.to_explain;
      rank(current, result);
    } else {
      result = failed(current, failure);
      result.ranked.effects.push_back(name);
    }
    result.added = name;
  };
  const auto screenForce = [&](std::size_t i, const ForceEffect& effect) {
    std::optional<ScreenedModel> screened = screening.screen(effect);
    if (!screened) return;
    // A law without a number inside is linear in all that is fitted: one start is as good as another.
    const auto start = effect.shapes.empty() ? std::nullopt : row_start.with(effect);
    std::optional<ScreenedModel> second = start ? screening.asItIs(start->model) : std::nullopt;
    const bool failed = screened->failure != FitFailure::kNone;
    if (second && (failed || second->training_gain > screened->training_gain)) std::swap(*screened, *second);
    note(i, effect.name, *screened);
    if (!second) return;
    if (!failed) results[i]->second_start = second->model;
    results[i]->training_gain = std::max(results[i]->training_gain, start->share * to_gain);
  };
  const bool full = current.fit.model.effects.size() >= most_forces_;
  const auto screenAt = [&](std::size_t i) {
    const auto isPresent = [&](const std::string& name) {
      return std::find(present.begin(), present.end(), name) != present.end();
    };
    if (i < forces.size()) {
      if (!full && !isPresent(forces[i].name)) screenForce(i, forces[i]);
    } else if (const MeasurementEffect& reading = readings[i - forces.size()]; !isPresent(reading.name)) {
      if (const auto screened = screen(screening, reading)) note(i, reading.name, *screened);
    }
  };
  double done = 0.0;
  forEachInParallel(count, options_.threads, screenAt, [&] { tick(++done / static_cast<double>(count)); });
  std::vector<EvaluatedModel> ranking;
  for (std::optional<EvaluatedModel>& result : results)
    if (result) ranking.push_back(std::move(*result));
  std::sort(ranking.begin(), ranking.end(),
            [](const EvaluatedModel& a, const EvaluatedModel& b) { return a.training_gain > b.training_gain; });
  return ranking;
}

void ModelEvaluator::fitAll(const std::vector<std::size_t>& wanted, const EvaluatedModel& current,
                            std::vector<EvaluatedModel>& ranking, const Tick& tick) const {
  const auto fit = [&](std::size_t i) {
    EvaluatedModel& candidate = ranking[wanted[i]];
    EvaluatedModel fitted = evaluate(candidate.ranked.model, current.fit.initial, &current);
    if (!fitted.ranked.fitted && candidate.second_start)
      fitted = evaluate(*candidate.second_start, current.fit.initial, &current);
    fitted.added = candidate.added;
    if (isToldByFrequency(fitted, current)) fitted = failed(current, FitFailure::kToldByFrequency);
    if (wanders(fitted, current)) fitted = failed(current, FitFailure::kWanders);
    fitted.added = candidate.added;
    fitted.ranked.effects = candidate.ranked.effects;
    fitted.tried = true;
    candidate = std::move(fitted);
  };
  double done = 0.0;
  forEachInParallel(wanted.size(), options_.threads, fit, [&] { tick(++done / static_cast<double>(wanted.size())); });
}

bool ModelEvaluator::isToldByFrequency(const EvaluatedModel& candidate, const EvaluatedModel& current) const {
  const std::vector<ActiveEffect>& effects = candidate.ranked.model.effects;
  if (!candidate.ranked.significant || effects.empty() || effects.back().effect.name != candidate.added ||
      !changesSlowly(effects.back()))
    return false;
  const ForceEffect rival = frequencyRival(candidate.fit, records_, current.ranked.model.stiffness_to_mass);
  const std::optional<ScreenedModel> start = Screening(records_, held_out_, current.fit).screen(rival);
  if (!start) return false;
  const EvaluatedModel as_frequency = evaluate(start->model, current.fit.initial, &current);
  if (!as_frequency.ranked.fitted) return false;
  return !isWorthHaving(as_frequency, candidate);
}

bool ModelEvaluator::wanders(const EvaluatedModel& candidate, const EvaluatedModel& current) const {
  const StrutModel& model = candidate.ranked.model;
  if (!candidate.ranked.significant || model.reading.size() == current.ranked.model.reading.size()) return false;
  const double natural_period = 2.0 * M_PI / std::sqrt(model.stiffness_to_mass) / records_.front()->period();
  return isWanderingOffset(current.fit.residuals, candidate.fit.residuals, natural_period);
}

std::vector<EvaluatedModel> ModelEvaluator::rankAdditions(const EvaluatedModel& current, const Tick& tick) const {
  std::vector<EvaluatedModel> ranking = screenAll(current, [&](double share) { tick(kScreeningTime * share); });
  const double least_gain = kWorthHaving / 2.0 * held_out_.trainingError(current.fit.residuals);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < ranking.size(); ++i)
    if (!ranking[i].tried && (i < kFitted || ranking[i].training_gain > kPromising * ranking.front().training_gain))
      wanted.push_back(i);
  while (!wanted.empty()) {
    fitAll(wanted, current, ranking, [&](double share) { tick(kScreeningTime + (1.0 - kScreeningTime) * share); });
    // None that was only screened may look better than the best that was fitted.
    double limit = current.loss;
    for (const EvaluatedModel& candidate : ranking)
      if (candidate.ranked.fitted) limit = std::min(limit, kScreeningError * candidate.loss);
    wanted.clear();
    for (std::size_t i = 0; i < ranking.size(); ++i)
      if (!ranking[i].tried && ranking[i].training_gain > least_gain && ranking[i].loss < limit) wanted.push_back(i);
  }
  std::stable_sort(ranking.begin(), ranking.end(), [](const EvaluatedModel& a, const EvaluatedModel& b) {
    return a.ranked.fitted != b.ranked.fitted ? a.ranked.fitted : a.loss < b.loss;
  });
  return ranking;
}

EvaluatedModel ModelEvaluator::without(const EvaluatedModel& evaluated, const std::string& effect) const {
  StrutModel model = evaluated.ranked.model;
  const auto isIt = [&](const auto& active) { return active.effect.name == effect; };
  model.effects.erase(std::remove_if(model.effects.begin(), model.effects.end(), isIt), model.effects.end());
  model.reading.erase(std::remove_if(model.reading.begin(), model.reading.end(), isIt), model.reading.end());
  EvaluatedModel rest = evaluate(model, evaluated.fit.initial, nullptr);
  rest.to_explain = evaluated.to_explain;
  return rest;
}

}  // namespace suspension_health_monitor
