#include "suspension_health_monitor/internal/fit/linear_response.h"

#include <cmath>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {

constexpr double kMotionStep = 1e-4;  // of the rms motion, for the slopes of the force

MotionScale scaleOf(const SegmentedMotion& motion, double stiffness_to_mass) {
  double travel = 0.0, travel_rate = 0.0;
  for (const StrutMotion& m : motion.samples) {
    travel += square(m.travel);
    travel_rate += square(m.travel_rate);
  }
  const auto count = static_cast<double>(motion.samples.size());
  return {std::sqrt(travel / count), std::sqrt(travel_rate / count), 1.0 / std::sqrt(stiffness_to_mass)};
}

LinearResponse::LinearResponse(const Records& records, const ModelFit& fit) : period_(records.front()->period()) {
  StrutModel force = fit.model;
  force.reading.clear();
  std::vector<std::array<Memory, kMostEffects>> memory;
  std::vector<double> predicted;
  std::vector<StrutState> states;
  for (const DriveSegment* segment : segmentsOf(records)) {
    runFree(force, *segment, fit.initial[segments_.size()], predicted, &states);
    predicted_.insert(predicted_.end(), predicted.begin(), predicted.end());
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double time = segment->timeDriven(k);
      motion_.samples.push_back({states[k].travel, states[k].travel_rate, time, 0.0,
                                 force.force(states[k].travel, states[k].travel_rate, time, states[k].memory.data())});
      memory.push_back(states[k].memory);
    }
    motion_.begins.push_back(motion_.samples.size());
    if (!segments_.empty()) motion_.rests.push_back(restBetween(*segments_.back(), *segment));
    segments_.push_back(segment);
  }
  const double y = std::sqrt(meanSquare({predicted_}));
  sizes_ = {kMotionStep * y, y, period_, bodySizes(segments_)};
  scale_ = scaleOf(motion_, fit.model.stiffness_to_mass);
  const double by_travel = kMotionStep * scale_.travel, by_rate = kMotionStep * scale_.travel_rate;
  for (std::size_t k = 0; k < memory.size(); ++k) {
    const StrutMotion& m = motion_.samples[k];
    const auto at = [&](double d, double v) {
      return force.force(m.travel + d, m.travel_rate + v, m.time, memory[k].data());
    };
    slope_travel_.push_back((at(by_travel, 0.0) - at(-by_travel, 0.0)) / (2.0 * by_travel));
    slope_rate_.push_back((at(0.0, by_rate) - at(0.0, -by_rate)) / (2.0 * by_rate));
  }
}

Eigen::VectorXd forceAlong(const ForceEffect& effect, const std::vector<double>& shapes,
                           const SegmentedMotion& motion) {
  const StrutModel alone{0.0, 0.0, {{effect, 1.0, shapes}}, {}};
  const auto& [samples, begins, rests] = motion;
  Eigen::VectorXd force(samples.size());
  std::array<Memory, kMostEffects> memory{};
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
    const std::size_t end = begins[i + 1];
    if (i > 0) keepLasting(alone, rests.empty() ? -1.0 : rests[i - 1], memory);
    for (std::size_t k = begins[i]; k < end; ++k) {
      StrutMotion here = samples[k];
      here.memory = memory[0];
      force[k] = effect.force(here, shapes.data());
      if (k + 1 < end) followMemories(alone, here, samples[k + 1], samples[k + 1].time - here.time, memory);
    }
  }
  return force;
}

Eigen::MatrixXd forcesAlong(const StrutModel& model, const SegmentedMotion& motion) {
  const std::vector<StrutMotion>& samples = motion.samples;
  Eigen::MatrixXd columns(samples.size(), 2 + model.effects.size());
  for (std::size_t k = 0; k < samples.size(); ++k)
    columns.row(k).head<2>() << samples[k].travel_rate, samples[k].travel;
  for (std::size_t j = 0; j < model.effects.size(); ++j)
    columns.col(2 + j) = forceAlong(model.effects[j].effect, model.effects[j].shapes, motion);
  return columns;
}

// Trapezoidal rule: stable however stiff the model is.
Eigen::VectorXd LinearResponse::respond(const Eigen::VectorXd& force) const {
  Eigen::VectorXd response(numSamples());
  const double half = period_ / 2.0;
  for (std::size_t s = 0; s < segments_.size(); ++s) {
    double x = 0.0, rate = 0.0;
    const std::size_t begin = motion_.begins[s], end = motion_.begins[s + 1];
    for (std::size_t k = begin; k < end; ++k) {
      const double f = force[k];
      if (k > begin) {
        // x1 = x + half (rate + rate1), rate1 = rate + half (acceleration + acceleration1)
        const double acceleration = -response[k - 1];
        const double known_x = x + half * rate, known_rate = rate + half * acceleration;
        rate = (known_rate - half * (slope_travel_[k] * known_x + f)) /
               (1.0 + half * (slope_rate_[k] + half * slope_travel_[k]));
        x = known_x + half * rate;
      }
      response[k] = slope_travel_[k] * x + slope_rate_[k] * rate + f;
    }
    auto passed = response.segment(begin, end - begin);
    passed = lowPassed(segments_[s]->taps, passed);
  }
  return response;
}

Eigen::MatrixXd LinearResponse::readingSlopes(const MeasurementEffect& effect) const {
  const std::size_t count = effect.coefficients.size();
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(numSamples(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const double step = effect.scale(sizes_, i);
    if (!std::isfinite(step)) continue;  // a channel that is not known
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      const std::size_t begin = motion_.begins[s], end = motion_.begins[s + 1];
      const auto readWith = [&](double coefficient) {
        std::vector<double> coefficients(count, 0.0), series(predicted_.begin() + begin, predicted_.begin() + end);
        coefficients[i] = coefficient;
        effect.apply(coefficients.data(), segments_[s]->body, period_, series);
        return joined<double>({series});
      };
      slopes.col(i).segment(begin, end - begin) = (readWith(step) - readWith(-step)) / (2.0 * step);
    }
  }
  return slopes;
}

}  // namespace suspension_health_monitor
