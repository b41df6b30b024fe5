#include "parameterization.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

/// Sums squares over one segment.
void addSegment(const StrutModel& start, const DriveSegment& segment, const std::vector<StrutState>& motion,
                DriveSizes& sums) {
  for (std::size_t k = 0; k < segment.size(); ++k) {
    const StrutState& state = motion[k];
    sums.travel += square(state.travel);
    sums.travel_rate += square(state.travel_rate);
    for (std::size_t j = 0; j < start.effects.size(); ++j) {
      const auto& [effect, coefficient, shapes] = start.effects[j];
      const StrutMotion here{state.travel, state.travel_rate, segment.timeDriven(k), state.memory[j]};
      sums.forces[j] += square(effect.force(here, shapes.data()));
    }
  }
  for (std::size_t c = 0; c < kNumBodyChannels; ++c)
    for (const double value : segment.body[c]) sums.body[c] += square(value);
}

}  // namespace

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
      sizes.acceleration += square(segment.sprung[k]);
      fitted.push_back(segment.sprung[k] - predicted[k]);
    }
  }
  if (fitted.empty()) return std::nullopt;
  for (double* sum : {&sizes.travel, &sizes.travel_rate}) *sum = std::sqrt(*sum / count);
  for (double& sum : sizes.forces) sum = std::sqrt(sum / count);
  for (double& sum : sizes.body) sum = std::sqrt(sum / count);
  sizes.acceleration = std::sqrt(sizes.acceleration / static_cast<double>(fitted.size()));
  sizes.residual = robustDeviation(std::move(fitted));
  return sizes;
}

namespace {

constexpr double kMargin = 0.02;  // in the logarithm, between a start and the end of a range that is widened for it

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

}  // namespace

Parameterization::Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales,
                                   const MotionScale& motion) {
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

double Parameterization::Number::value(double x) const {
  return isShape() ? std::exp(lower + width * logistic(x)) : scale * x;
}

double Parameterization::Number::slope(double x) const {
  return isShape() ? value(x) * width * logistic(x) * (1.0 - logistic(x)) : scale;
}

void Parameterization::apply(const double* x, StrutModel& model) const {
  auto number = numbers_.begin();
  for (double* value : valuesOf(model)) *value = number++->value(*x++);
}

Eigen::VectorXd Parameterization::slopes(const double* x) const {
  Eigen::VectorXd slope(size());
  for (int i = 0; i < size(); ++i) slope[i] = numbers_[static_cast<std::size_t>(i)].slope(x[i]);
  return slope;
}

namespace {

bool hasLasting(const StrutModel& model) {
  return std::any_of(model.effects.begin(), model.effects.end(),
                     [](const ActiveEffect& active) { return active.effect.lasts; });
}

}  // namespace

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

CarriedMemories::CarriedMemories(const Segments& segments, std::vector<StrutState> states)
    : segments_(segments), states_(std::move(states)) {}

const std::array<Memory, kMostEffects>& CarriedMemories::at(std::size_t segment, StrutModel& model) {
  if (segment == 0 || !hasLasting(model)) return states_[segment].memory;
  std::vector<double> numbers;
  for (const double* number : valuesOf(model)) numbers.push_back(*number);
  if (known_.size() > 2 * numbers.size()) known_.clear();  // a point and its derivatives, and the point before
  const auto [known, is_new] = known_.try_emplace(std::move(numbers), states_);
  if (is_new) carryMemories(model, segments_, known->second);
  return known->second[segment].memory;
}

}  // namespace suspension_health_monitor
