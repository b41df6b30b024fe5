#include "suspension_health_monitor/internal/fit/output_error_fit.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/signal/filters.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

using Segments = std::vector<const DriveSegment*>;

/// @return the mask of a segment; none if all samples are fitted.
const SampleMask* maskOf(const std::vector<SampleMask>& masks, std::size_t segment) {
  return masks.empty() ? nullptr : &masks[segment];
}

/// What a run from rest, the effects not acting yet, shows of the drives: rms values.
struct DriveSizes {
  MotionScale motion;
  std::vector<double> forces;  ///< of the effects, per unit of their coefficient
  ReadingSizes reading;  ///< of what is fitted only, the residual robust; of the body 0 where a channel is not known
};

/// Sums squares over one segment.
void addSegment(const StrutModel& start, const DriveSegment& segment, const std::vector<StrutState>& motion,
                DriveSizes& sums) {
  for (std::size_t k = 0; k < segment.size(); ++k) {
    const StrutState& state = motion[k];
    sums.motion.travel += square(state.travel);
    sums.motion.travel_rate += square(state.travel_rate);
    for (std::size_t j = 0; j < start.effects.size(); ++j) {
      const auto& [effect, coefficient, shapes] = start.effects[j];
      const StrutMotion here{state.travel, state.travel_rate, segment.timeDriven(k), state.memory[j]};
      sums.forces[j] += square(effect.force(here, shapes.data()));
    }
  }
  for (std::size_t c = 0; c < kNumBodyChannels; ++c)
    for (const double value : segment.body[c]) sums.reading.body[c] += square(value);
}

/// @return nothing if the model runs away or there is nothing to fit.
std::optional<DriveSizes> measureSizes(const Segments& segments, const std::vector<SampleMask>& masks,
                                       const StrutModel& start) {
  StrutModel linear = start;  // the effects' memories run along
  for (ActiveEffect& active : linear.effects) active.coefficient = 0.0;
  DriveSizes sizes;
  sizes.forces.resize(start.effects.size(), 0.0);
  double count = 0.0;
  std::vector<double> fitted, predicted;
  std::vector<StrutState> motion;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const DriveSegment& segment = *segments[s];
    if (!runFree(linear, segment, {}, predicted, &motion)) return std::nullopt;
    addSegment(start, segment, motion, sizes);
    count += static_cast<double>(segment.size());
    const SampleMask* mask = maskOf(masks, s);
    for (std::size_t k = 0; k < segment.size(); ++k) {
      if (mask != nullptr && (*mask)[k] == 0) continue;
      sizes.reading.y += square(segment.sprung[k]);
      fitted.push_back(segment.sprung[k] - predicted[k]);
    }
  }
  if (fitted.empty()) return std::nullopt;
  sizes.motion = {std::sqrt(sizes.motion.travel / count), std::sqrt(sizes.motion.travel_rate / count),
                  1.0 / std::sqrt(start.stiffness_to_mass)};
  for (double& sum : sizes.forces) sum = std::sqrt(sum / count);
  for (double& sum : sizes.reading.body) sum = std::sqrt(sum / count);
  sizes.reading.y = std::sqrt(sizes.reading.y / static_cast<double>(fitted.size()));
  sizes.reading.residual = robustDeviation(std::move(fitted));
  sizes.reading.period = segments.front()->period;
  return sizes;
}

constexpr double kMargin = 0.02;  // in the logarithm, between a start and the end of a range that is widened for it

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

/// A model as a vector of numbers of order 1, in the order of valuesOf(): b1 and b0 relative to their start,
/// coefficients relative to a force of the size of the linear one, shapes by their place in their range (logistic in
/// the logarithm): beyond its range many a law turns into another one that the model has already, and a fit would lose
/// its way there.
class Parameterization {
 public:
  /// @param coefficient_scales  of the effects, then of the reading's [unit of the coefficient].
  /// @param motion  what the shapes' ranges are counted in; ranges are widened to hold the start.
  Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales, const MotionScale& motion) {
    numbers_ = {{start.damping_to_mass}, {start.stiffness_to_mass}};
    std::vector<double> x{1.0, 1.0};
    auto scale = coefficient_scales.begin();
    for (const auto& [effect, coefficient, shapes] : start.effects) {
      numbers_.push_back({*scale});
      x.push_back(coefficient / *scale++);
      for (std::size_t s = 0; s < shapes.size(); ++s) {
        const ShapeParameter& shape = effect.shapes[s];
        const double at = std::log(shapes[s]), unit = std::log(motion.unit(shape.scale));
        const double lower = std::min(std::log(shape.min) + unit, at - kMargin);
        const double width = std::max(std::log(shape.max) + unit, at + kMargin) - lower;
        const double place = (at - lower) / width;
        numbers_.push_back({0.0, lower, width});
        x.push_back(std::log(place / (1.0 - place)));
      }
    }
    for (const ActiveMeasurementEffect& reading : start.reading)
      for (const double coefficient : reading.coefficients) {
        numbers_.push_back({*scale});
        x.push_back(coefficient / *scale++);
      }
    initial_ = Eigen::Map<const Eigen::VectorXd>(x.data(), size());
  }

  int size() const { return static_cast<int>(numbers_.size()); }

  /// @return the start as a vector.
  const Eigen::VectorXd& initial() const { return initial_; }

  /// @param model  its numbers are replaced; it has the effects of the start.
  void apply(const double* x, StrutModel& model) const {
    auto number = numbers_.begin();
    for (double* value : valuesOf(model)) *value = number++->value(*x++);
  }

  /// @return d(SI value)/dx at x.
  Eigen::VectorXd slopes(const double* x) const {
    Eigen::VectorXd slope(size());
    for (int i = 0; i < size(); ++i) slope[i] = numbers_[static_cast<std::size_t>(i)].slope(x[i]);
    return slope;
  }

 private:
  /// value = scale x; of a shape ln value = lower + width / (1 + exp(-x)), width > 0.
  struct Number {
    double scale = 0.0, lower = 0.0, width = 0.0;

    bool isShape() const { return width > 0.0; }
    double value(double x) const { return isShape() ? std::exp(lower + width * logistic(x)) : scale * x; }
    double slope(double x) const { return isShape() ? value(x) * width * logistic(x) * (1.0 - logistic(x)) : scale; }
  };

  std::vector<Number> numbers_;
  Eigen::VectorXd initial_;
};

bool hasLasting(const StrutModel& model) {
  return std::any_of(model.effects.begin(), model.effects.end(),
                     [](const ActiveEffect& active) { return active.effect.lasts; });
}

/// Gives every segment the memories that last (ForceEffect::lasts) from the run over those before it, less what the
/// time between them takes. Nothing happens where none lasts.
/// @param states  that the segments begin with; the memories are replaced.
void carryMemories(const StrutModel& model, const Segments& segments, std::vector<StrutState>& states) {
  if (!hasLasting(model)) return;
  std::vector<double> predicted;
  std::vector<StrutState> motion;
  for (std::size_t s = 0; s + 1 < segments.size(); ++s) {
    if (!runFree(model, *segments[s], states[s], predicted, &motion)) return;
    states[s + 1].memory = motion.back().memory;
    keepLasting(model, restBetween(*segments[s], *segments[s + 1]), states[s + 1].memory);
  }
}

/// The same for a fit, whose costs ask segment by segment for the same models again and again.
class CarriedMemories {
 public:
  /// @param states  travel and travel rate that the segments begin with, about.
  CarriedMemories(const Segments& segments, std::vector<StrutState> states)
      : segments_(segments), states_(std::move(states)) {}

  /// @return of one segment, by kMostEffects.
  const std::array<Memory, kMostEffects>& at(std::size_t segment, StrutModel& model) {
    if (segment == 0 || !hasLasting(model)) return states_[segment].memory;
    std::vector<double> numbers;
    for (const double* number : valuesOf(model)) numbers.push_back(*number);
    if (known_.size() > 2 * numbers.size()) known_.clear();  // a point and its derivatives, and the point before
    const auto [known, is_new] = known_.try_emplace(std::move(numbers), states_);
    if (is_new) carryMemories(model, segments_, known->second);
    return known->second[segment].memory;
  }

 private:
  const Segments& segments_;
  std::vector<StrutState> states_;
  std::map<std::vector<double>, std::vector<StrutState>> known_;  // by the numbers of the model
};

using LocalStates = std::vector<std::array<double, 2>>;  // travel and travel rate that segments begin with, scaled

constexpr double kParameterStep = 1e-6;  // relative step of the numerical derivatives
constexpr double kSmallForce = 0.1;      // of the measured acceleration: what a coefficient of 1 makes of its effect

/// @return nothing if an effect never acts in these drives, or a fault of the measurement cannot show in them.
std::optional<std::vector<double>> coefficientScales(const StrutModel& start, const DriveSizes& sizes) {
  std::vector<double> scales;
  for (const double force : sizes.forces) {
    if (force == 0.0) return std::nullopt;
    scales.push_back(kSmallForce * sizes.reading.y / force);
  }
  for (const ActiveMeasurementEffect& reading : start.reading) {
    bool shows = false;
    for (std::size_t i = 0; i < reading.coefficients.size(); ++i) {
      const double scale = reading.effect.scale(sizes.reading, i);
      shows = shows || std::isfinite(scale);
      scales.push_back(std::isfinite(scale) ? scale : 1.0);  // nothing moves the coefficient of a channel that is empty
    }
    if (!shows) return std::nullopt;
  }
  return scales;
}

/// Residuals of one segment. Parameter blocks: the model, the segment's initial travel and travel rate.
/// The arguments must outlive it.
class SegmentCost : public ceres::CostFunction {
 public:
  /// @param index  of the segment.  @param mask  none: all samples.
  /// @param scale  what the initial state is counted in.
  /// @param outlier  where a residual begins to count as one [m/s^2].
  SegmentCost(const Segments& segments, std::size_t index, const SampleMask* mask, const Parameterization& parameters,
              const StrutModel& model, const MotionScale& scale, double outlier, CarriedMemories& memories)
      : segment_(*segments[index]),
        index_(index),
        parameters_(parameters),
        model_(model),
        scale_(scale),
        outlier_(outlier),
        memories_(memories) {
    for (std::size_t k = 0; k < segment_.size(); ++k)
      if (mask == nullptr || (*mask)[k] != 0) used_.push_back(k);
    set_num_residuals(static_cast<int>(used_.size()));
    mutable_parameter_block_sizes()->push_back(parameters.size());
    mutable_parameter_block_sizes()->push_back(2);
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    Eigen::VectorXd shared = Eigen::Map<const Eigen::VectorXd>(x[0], parameters_.size());
    Eigen::VectorXd local = Eigen::Map<const Eigen::VectorXd>(x[1], 2);
    Eigen::VectorXd base(num_residuals());
    if (!evaluate(shared, local, base)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = base.unaryExpr([this](double r) { return damp(r); });
    if (jacobians == nullptr) return true;
    return (jacobians[0] == nullptr || differentiate(shared, local, shared, base, jacobians[0])) &&
           (jacobians[1] == nullptr || differentiate(shared, local, local, base, jacobians[1]));
  }

 private:
  bool evaluate(const Eigen::VectorXd& shared, const Eigen::VectorXd& local, Eigen::VectorXd& residuals) const {
    StrutModel model = model_;
    parameters_.apply(shared.data(), model);
    StrutState state{0.0, 0.0, memories_.at(index_, model)};
    state.travel = local[0] * scale_.travel;
    state.travel_rate = local[1] * scale_.travel_rate;
    std::vector<double> predicted;
    if (!runFree(model, segment_, state, predicted)) return false;
    for (std::size_t i = 0; i < used_.size(); ++i)
      residuals[static_cast<Eigen::Index>(i)] = segment_.sprung[used_[i]] - predicted[used_[i]];
    return true;
  }

  /// Derivative of the damped residuals with respect to `varied`, one of the two others. Row by row.
  bool differentiate(const Eigen::VectorXd& shared, const Eigen::VectorXd& local, Eigen::VectorXd& varied,
                     const Eigen::VectorXd& base, double* jacobian) const {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> columns(jacobian, num_residuals(), varied.size());
    Eigen::VectorXd moved(num_residuals());
    for (Eigen::Index i = 0; i < varied.size(); ++i) {
      const double kept = varied[i];
      double step = kParameterStep * std::max(1.0, std::abs(kept));
      varied[i] = kept + step;
      if (!evaluate(shared, local, moved)) {  // at the edge of stability: look the other way
        step = -step;
        varied[i] = kept + step;
        if (!evaluate(shared, local, moved)) moved = base;  // on a ridge: it stays where it is
      }
      varied[i] = kept;
      for (int k = 0; k < num_residuals(); ++k) columns(k, i) = (moved[k] - base[k]) / step * dampSlope(base[k]);
    }
    return true;
  }

  // Smooth Huber loss as a change of the residual: half its square is a^2 (sqrt(1 + (r/a)^2) - 1).
  double damp(double r) const {
    const double q = r / outlier_;
    return std::copysign(outlier_ * std::sqrt(2.0 * q * q / (std::sqrt(1.0 + q * q) + 1.0)), r);
  }

  double dampSlope(double r) const {
    const double q = r / outlier_;
    const double damped = damp(r);
    return damped == 0.0 ? 1.0 : r / (std::sqrt(1.0 + q * q) * damped);
  }

  const DriveSegment& segment_;
  std::size_t index_;
  const Parameterization& parameters_;
  const StrutModel& model_;
  MotionScale scale_;
  double outlier_;
  CarriedMemories& memories_;
  std::vector<std::size_t> used_;
};

/// Standard deviations of the model's numbers (in SI), the initial states of the segments being unknown, too.
std::vector<double> standardDeviations(const ceres::Problem& problem, const Parameterization& parameters,
                                       const double* model) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(parameters.size(), parameters.size());
  double square = 0.0, count = 0.0;
  std::vector<ceres::ResidualBlockId> blocks;
  problem.GetResidualBlocks(&blocks);
  for (const ceres::ResidualBlockId block : blocks) {
    std::vector<double*> x;
    problem.GetParameterBlocksForResidualBlock(block, &x);
    const ceres::CostFunction* cost = problem.GetCostFunctionForResidualBlock(block);
    Eigen::VectorXd residuals(cost->num_residuals());
    RowMajor shared(cost->num_residuals(), parameters.size()), local(cost->num_residuals(), 2);
    double* jacobians[2] = {shared.data(), local.data()};
    if (!cost->Evaluate(x.data(), residuals.data(), jacobians)) continue;
    const Eigen::MatrixXd cross = local.transpose() * shared;
    information += shared.transpose() * shared - cross.transpose() * (local.transpose() * local).ldlt().solve(cross);
    square += residuals.squaredNorm();
    count += static_cast<double>(residuals.size());
  }
  const Eigen::MatrixXd covariance =
      square / count * information.ldlt().solve(Eigen::MatrixXd::Identity(parameters.size(), parameters.size()));
  const Eigen::VectorXd deviations =
      covariance.diagonal().cwiseMax(0.0).cwiseSqrt().cwiseProduct(parameters.slopes(model).cwiseAbs());
  return {deviations.data(), deviations.data() + deviations.size()};
}

/// Fits the model `x` and the initial states in place.
/// @param holds_model  it stays as it is.
/// @return false if the solver fails.
bool solve(ceres::Problem& problem, bool holds_model, Eigen::VectorXd& x, LocalStates& initial) {
  auto* ordering = new ceres::ParameterBlockOrdering;  // the solver's options own it
  ceres::Solver::Options solver;
  solver.linear_solver_ordering.reset(ordering);
  for (auto& of_segment : initial) ordering->AddElementToGroup(of_segment.data(), 0);
  ordering->AddElementToGroup(x.data(), 1);
  if (holds_model) problem.SetParameterBlockConstant(x.data());
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  solver.max_num_iterations = 25;
  solver.function_tolerance = 1e-7;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable();
}

/// A first guess of coefficients by linear thinking may make the model run away: they are halved until it does not.
/// @return false if that does not help.
bool tame(const Segments& segments, const std::vector<StrutState>& initial, StrutModel& model) {
  constexpr int most_halvings = 4;
  std::vector<double> predicted;
  for (int i = 0; i <= most_halvings; ++i) {
    bool runs = true;
    for (std::size_t s = 0; s < segments.size() && runs; ++s)
      runs = runFree(model, *segments[s], initial.empty() ? StrutState{} : initial[s], predicted);
    if (runs) return true;
    for (ActiveEffect& active : model.effects) active.coefficient /= 2.0;
  }
  return false;
}

/// Adds initial states and residuals.
/// @param states  travel and travel rate that the segments begin with.
bool addResiduals(const Segments& segments, std::vector<StrutState> states, ModelFit& fit) {
  carryMemories(fit.model, segments, states);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    std::vector<double>& residuals = fit.residuals.emplace_back();
    if (!runFree(fit.model, *segments[s], states[s], residuals)) return false;
    for (std::size_t k = 0; k < residuals.size(); ++k) residuals[k] = segments[s]->sprung[k] - residuals[k];
  }
  fit.initial = std::move(states);
  return true;
}

template <class Value>
void cutEnds(std::size_t count, std::vector<Value>& values) {
  values.resize(values.size() - count);
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

bool runFree(const StrutModel& model, const DriveSegment& segment, StrutState state, std::vector<double>& predicted,
             std::vector<StrutState>* motion) {
  double largest = 0.0;
  for (const double y : segment.sprung) largest = std::max(largest, std::abs(y));
  const std::size_t lead = segment.lead();
  const RecordedWheel wheel{segment.wheel, segment.timeDriven(0) - static_cast<double>(lead) * segment.period,
                            segment.period, segment.steps, segment.size() + 2 * lead};
  if (!FreeRun::follow(model, wheel, state, kRunaway * largest, predicted, motion)) return false;
  passLow(segment.taps, predicted);
  cutEnds(lead, predicted);
  if (motion != nullptr) cutEnds(lead, *motion);
  for (const ActiveMeasurementEffect& reading : model.reading)
    reading.effect.apply(reading.coefficients.data(), segment.body, segment.period, predicted);
  return true;
}

FitOutcome fitOutputError(const Records& records, const std::vector<SampleMask>& masks, const StrutModel& guess,
                          const std::vector<StrutState>& guessed_states) {
  const Segments segments = segmentsOf(records);
  StrutModel start = guess;
  if (!(start.stiffness_to_mass > 0.0)) return FitFailure::kNoSpring;
  if (!tame(segments, guessed_states, start)) return FitFailure::kRunsAway;
  const std::optional<DriveSizes> sizes = measureSizes(segments, masks, start);
  if (!sizes) return FitFailure::kRunsAway;
  const auto coefficient_scales = coefficientScales(start, *sizes);
  if (!coefficient_scales) return FitFailure::kNeverActs;
  const MotionScale& scale = sizes->motion;
  const Parameterization parameters(start, *coefficient_scales, scale);
  const double outlier = std::max(kOutlierScale * sizes->reading.residual, 1e-9 * sizes->reading.y);
  Eigen::VectorXd x = parameters.initial();
  std::vector<StrutState> states(segments.size());
  LocalStates initial(segments.size(), {0.0, 0.0});
  for (std::size_t s = 0; s < guessed_states.size(); ++s) {
    states[s] = {guessed_states[s].travel, guessed_states[s].travel_rate, {}};
    initial[s] = {states[s].travel / scale.travel, states[s].travel_rate / scale.travel_rate};
  }
  CarriedMemories memories(segments, states);
  ceres::Problem problem;
  for (std::size_t s = 0; s < segments.size(); ++s)
    problem.AddResidualBlock(
        new SegmentCost(segments, s, maskOf(masks, s), parameters, start, scale, outlier, memories), nullptr, x.data(),
        initial[s].data());
  if (!solve(problem, false, x, initial)) return FitFailure::kNotSolved;

  ModelFit fit;
  fit.model = start;
  fit.stddev = standardDeviations(problem, parameters, x.data());
  fit.motion = scale;
  parameters.apply(x.data(), fit.model);
  if (!(fit.model.stiffness_to_mass > 0.0)) return FitFailure::kNoSpring;
  if (!canFollow(fit.model, records.front()->period())) return FitFailure::kTooFast;
  for (std::size_t s = 0; s < segments.size(); ++s)
    states[s] = {initial[s][0] * scale.travel, initial[s][1] * scale.travel_rate, {}};
  if (!addResiduals(segments, states, fit)) return FitFailure::kRunsAway;
  return fit;
}

std::optional<std::vector<StrutState>> estimateInitialStates(const Records& records, const StrutModel& model) {
  const FitOutcome at_rest = withoutFit(records, model);
  if (!at_rest) return std::nullopt;
  const Segments segments = segmentsOf(records);
  const double size = std::sqrt(meanSquare(at_rest->residuals)), rate = std::sqrt(model.stiffness_to_mass);
  if (size == 0.0) return at_rest->initial;
  const MotionScale scale{size / model.stiffness_to_mass, size / rate, 1.0 / rate};
  const Parameterization parameters(model, std::vector<double>(numbersOf(model).size(), 1.0), scale);
  CarriedMemories memories(segments, at_rest->initial);
  Eigen::VectorXd x = parameters.initial();
  LocalStates initial(segments.size(), {0.0, 0.0});
  ceres::Problem problem;
  for (std::size_t s = 0; s < segments.size(); ++s)
    problem.AddResidualBlock(
        new SegmentCost(segments, s, nullptr, parameters, model, scale, kOutlierScale * size, memories), nullptr,
        x.data(), initial[s].data());
  if (!solve(problem, true, x, initial)) return std::nullopt;
  std::vector<StrutState> states = at_rest->initial;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    states[s].travel = initial[s][0] * scale.travel;
    states[s].travel_rate = initial[s][1] * scale.travel_rate;
  }
  return states;
}

double meanOf(const Residuals& residuals) {
  const Eigen::VectorXd all = joined(residuals);
  return all.size() > 0 ? all.mean() : 0.0;
}

double meanSquare(const Residuals& residuals) {
  const Eigen::VectorXd all = joined(residuals);
  return all.size() > 0 ? all.squaredNorm() / static_cast<double>(all.size()) : 0.0;
}

FitOutcome withoutFit(const Records& records, const StrutModel& model) {
  ModelFit fit;
  fit.model = model;
  const Segments segments = segmentsOf(records);
  if (!addResiduals(segments, std::vector<StrutState>(segments.size()), fit)) return FitFailure::kRunsAway;
  return fit;
}

}  // namespace suspension_health_monitor
