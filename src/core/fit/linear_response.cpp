#include "suspension_health_monitor/internal/fit/linear_response.h"

#include <cmath>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {
namespace {

constexpr double kMotionStep = 1e-4;  // of the rms motion, for the slopes of the force

double rms(const std::vector<StrutMotion>& motion, double StrutMotion::*member) {
  double sum = 0.0;
  for (const StrutMotion& m : motion) sum += square(m.*member);
  return std::sqrt(sum / static_cast<double>(motion.size()));
}

}  // namespace

LinearResponse::LinearResponse(const Records& records, const ModelFit& fit)
    : fit_(&fit), period_(records.front()->period()) {
  StrutModel force = fit.model;
  force.reading.clear();
  std::vector<std::array<Memory, kMostEffects>> memory;
  std::vector<double> predicted;
  std::vector<StrutState> states;
  for (const DriveSegment* segment : segmentsOf(records)) {
    runFree(force, *segment, fit.initial[ends_.size()], predicted, &states);
    predicted_.insert(predicted_.end(), predicted.begin(), predicted.end());
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double time = segment->timeDriven(k);
      motion_.push_back({states[k].travel, states[k].travel_rate, time, 0.0,
                         force.force(states[k].travel, states[k].travel_rate, time, states[k].memory.data())});
      memory.push_back(states[k].memory);
    }
    ends_.push_back(motion_.size());
    if (!segments_.empty()) rests_.push_back(restBetween(*segments_.back(), *segment));
    segments_.push_back(segment);
  }
  measureSizes();
  travel_ = rms(motion_, &StrutMotion::travel);
  travel_rate_ = rms(motion_, &StrutMotion::travel_rate);
  const double by_travel = kMotionStep * travel_, by_rate = kMotionStep * travel_rate_;
  for (std::size_t k = 0; k < motion_.size(); ++k) {
    const StrutMotion& m = motion_[k];
    const auto at = [&](double d, double v) {
      return force.force(m.travel + d, m.travel_rate + v, m.time, memory[k].data());
    };
    slope_travel_.push_back((at(by_travel, 0.0) - at(-by_travel, 0.0)) / (2.0 * by_travel));
    slope_rate_.push_back((at(0.0, by_rate) - at(0.0, -by_rate)) / (2.0 * by_rate));
  }
}

void LinearResponse::measureSizes() {
  const auto count = static_cast<double>(predicted_.size());
  double squares = 0.0;
  for (const double y : predicted_) squares += square(y);
  sizes_.y = std::sqrt(squares / count);
  sizes_.residual = kMotionStep * sizes_.y;
  sizes_.period = period_;
  for (std::size_t c = 0; c < kNumBodyChannels; ++c) {
    double sum = 0.0;
    for (const DriveSegment* segment : segments_)
      for (const double value : segment->body[c]) sum += square(value);
    sizes_.body[c] = std::sqrt(sum / count);
  }
}

Eigen::VectorXd forceAlong(const ForceEffect& effect, const std::vector<double>& shapes,
                           const std::vector<StrutMotion>& motion, const std::vector<std::size_t>& ends,
                           const std::vector<double>& rests) {
  const StrutModel alone{0.0, 0.0, {{effect, 1.0, shapes}}, {}};
  Eigen::VectorXd force(motion.size());
  std::array<Memory, kMostEffects> memory{};
  std::size_t k = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::size_t end = ends[i];
    if (i > 0) keepLasting(alone, rests.empty() ? -1.0 : rests[i - 1], memory);
    for (; k < end; ++k) {
      StrutMotion here = motion[k];
      here.memory = memory[0];
      force[k] = effect.force(here, shapes.data());
      if (k + 1 < end) followMemories(alone, here, motion[k + 1], motion[k + 1].time - here.time, memory);
    }
  }
  return force;
}

Eigen::MatrixXd forcesAlong(const StrutModel& model, const std::vector<StrutMotion>& motion,
                            const std::vector<std::size_t>& ends, const std::vector<double>& rests) {
  Eigen::MatrixXd columns(motion.size(), 2 + model.effects.size());
  for (std::size_t k = 0; k < motion.size(); ++k) columns.row(k).head<2>() << motion[k].travel_rate, motion[k].travel;
  for (std::size_t j = 0; j < model.effects.size(); ++j)
    columns.col(2 + j) = forceAlong(model.effects[j].effect, model.effects[j].shapes, motion, ends, rests);
  return columns;
}

// Trapezoidal rule: stable however stiff the model is.
Eigen::VectorXd LinearResponse::respond(const Eigen::VectorXd& force) const {
  Eigen::VectorXd response(numSamples());
  const double half = period_ / 2.0;
  std::size_t k = 0;
  for (const DriveSegment* segment : segments_) {
    double x = 0.0, rate = 0.0;
    const std::size_t begin = k, end = begin + segment->size();
    for (; k < end; ++k) {
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
    passed = lowPassed(segment->taps, passed);
  }
  return response;
}

Eigen::MatrixXd LinearResponse::readingSlopes(const MeasurementEffect& effect) const {
  const std::size_t count = effect.coefficients.size();
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(numSamples(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const double step = effect.scale(sizes_, i);
    if (!std::isfinite(step)) continue;  // a channel that is not known
    std::vector<double> coefficients(count, 0.0);
    std::size_t begin = 0;
    for (std::size_t s = 0; s < ends_.size(); ++s) {
      std::vector<double> before(predicted_.begin() + begin, predicted_.begin() + ends_[s]);
      std::vector<double> after = before;
      coefficients[i] = -step;
      effect.apply(coefficients.data(), segments_[s]->body, period_, before);
      coefficients[i] = step;
      effect.apply(coefficients.data(), segments_[s]->body, period_, after);
      for (std::size_t k = 0; k < after.size(); ++k) slopes(begin + k, i) = (after[k] - before[k]) / (2.0 * step);
      begin = ends_[s];
    }
  }
  return slopes;
}

}  // namespace suspension_health_monitor
