#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

/// @return the mask of a segment; none if all samples are fitted.
inline const SampleMask* maskOf(const std::vector<SampleMask>& masks, std::size_t segment) {
  return masks.empty() ? nullptr : &masks[segment];
}

/// What a run from rest, the effects not acting yet, shows of the drives: rms values.
struct DriveSizes {
  MotionScale motion;
  std::vector<double> forces;  ///< of the effects, per unit of their coefficient
  ReadingSizes reading;  ///< of what is fitted only, the residual robust; of the body 0 where a channel is not known
};

/// @return rms of what else the body's IMU measured, by channel; 0 where it is not known.
inline std::array<double, kNumBodyChannels> bodySizes(const Segments& segments) {
  std::array<double, kNumBodyChannels> sizes{};
  for (std::size_t c = 0; c < kNumBodyChannels; ++c) {
    double count = 0.0;
    for (const DriveSegment* segment : segments) {
      for (const double value : segment->body[c]) sizes[c] += square(value);
      count += static_cast<double>(segment->size());
    }
    sizes[c] = std::sqrt(sizes[c] / count);
  }
  return sizes;
}

/// @return nothing if the model runs away or there is nothing to fit.
inline std::optional<DriveSizes> measureSizes(const Segments& segments, const std::vector<SampleMask>& masks,
                                              const StrutModel& start) {
  StrutModel linear = start;  // the effects' memories run along
  for (ActiveEffect& active : linear.effects) active.coefficient = 0.0;
  FreeMotion motion;
  const auto residuals = freeRunResiduals(linear, segments, std::vector<StrutState>(segments.size()), &motion);
  if (!residuals) return std::nullopt;
  DriveSizes sizes;
  sizes.forces.resize(start.effects.size(), 0.0);
  double count = 0.0;
  std::vector<double> fitted;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const DriveSegment& segment = *segments[s];
    const SampleMask* mask = maskOf(masks, s);
    count += static_cast<double>(segment.size());
    for (std::size_t k = 0; k < segment.size(); ++k) {
      const StrutState& state = motion[s][k];
      sizes.motion.travel += square(state.travel);
      sizes.motion.travel_rate += square(state.travel_rate);
      for (std::size_t j = 0; j < start.effects.size(); ++j) {
        const auto& [effect, coefficient, shapes] = start.effects[j];
        const StrutMotion here{state.travel, state.travel_rate, segment.timeDriven(k), state.memory[j]};
        sizes.forces[j] += square(effect.force(here, shapes.data()));
      }
      if (mask != nullptr && (*mask)[k] == 0) continue;
      sizes.reading.y += square(segment.sprung[k]);
      fitted.push_back((*residuals)[s][k]);
    }
  }
  if (fitted.empty()) return std::nullopt;
  sizes.motion = {std::sqrt(sizes.motion.travel / count), std::sqrt(sizes.motion.travel_rate / count),
                  1.0 / std::sqrt(start.stiffness_to_mass)};
  for (double& sum : sizes.forces) sum = std::sqrt(sum / count);
  const double y = std::sqrt(sizes.reading.y / static_cast<double>(fitted.size()));
  sizes.reading = {robustDeviation(std::move(fitted)), y, segments.front()->period, bodySizes(segments)};
  return sizes;
}

// In the logarithm, between a start and the end of a range that is widened for it.
inline constexpr double kRangeMargin = 0.02;

inline double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

/// A model as a vector of numbers of order 1, in the order of valuesOf(): b1 and b0 relative to their start,
/// coefficients relative to a force of the size of the linear one, shapes by their place in their range (logistic in
/// the logarithm): beyond its range many a law turns into another one that the model has already, and a fit would lose
/// its way there.
class Parameterization {
 public:
  /// @param coefficient_scales  of the effects, then of the reading's [unit of the coefficient].
  /// @param motion  what the shapes' ranges are counted in; ranges are widened to hold the start.
  Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales, const MotionScale& motion)
      : start_(start), motion_(motion) {
    numbers_ = {{start.damping_to_mass}, {start.stiffness_to_mass}};
    std::vector<double> x{1.0, 1.0};
    auto scale = coefficient_scales.begin();
    for (const auto& [effect, coefficient, shapes] : start.effects) {
      numbers_.push_back({*scale});
      x.push_back(coefficient / *scale++);
      for (std::size_t s = 0; s < shapes.size(); ++s) {
        const ShapeParameter& shape = effect.shapes[s];
        const double at = std::log(shapes[s]), unit = std::log(motion.unit(shape.scale));
        const double lower = std::min(std::log(shape.min) + unit, at - kRangeMargin);
        const double width = std::max(std::log(shape.max) + unit, at + kRangeMargin) - lower;
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

  const MotionScale& motion() const { return motion_; }

  StrutModel model(const double* x) const {
    StrutModel model = start_;
    auto number = numbers_.begin();
    for (double* value : valuesOf(model)) *value = number++->value(*x++);
    return model;
  }

  /// @return d(SI value)/dx at x.
  Eigen::VectorXd slopes(const double* x) const {
    Eigen::VectorXd slope(size());
    for (int i = 0; i < size(); ++i) slope[i] = numbers_[i].slope(x[i]);
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

  StrutModel start_;
  MotionScale motion_;
  std::vector<Number> numbers_;
  Eigen::VectorXd initial_;
};

inline bool hasLasting(const StrutModel& model) {
  return std::any_of(model.effects.begin(), model.effects.end(),
                     [](const ActiveEffect& active) { return active.effect.lasts; });
}

/// Gives every segment the memories that last (ForceEffect::lasts) from the run over those before it, less what the
/// time between them takes. Nothing happens where none lasts.
/// @param states  that the segments begin with; the memories are replaced.
inline void carryMemories(const StrutModel& model, const Segments& segments, std::vector<StrutState>& states) {
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

}  // namespace suspension_health_monitor
