#include "suspension_health_monitor/internal/signal/stream_resampler.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/tuning.h"

namespace suspension_health_monitor {

void SmoothingSpline::begin(std::int64_t first) {
  empty_ = false;
  oldest_open_ = first;
  settled_ = first - 1;
  matrix_ = {};
  right_ = {};
  penalise({1.0, -2.0, 1.0, 0.0, 0.0});  // two readings make a straight line
  penalise({-1.0, 3.0, -3.0, 1.0, 0.0});
  penaliseNewest();
}

void SmoothingSpline::penaliseNewest() {
  penalise({0.0, -1.4, 4.2, -4.2, 1.4});
  penalise({1.0, -4.0, 6.0, -4.0, 1.0});
}

void SmoothingSpline::penalise(const std::array<double, kOpen>& difference) {
  for (int i = 0; i < kOpen; ++i)
    for (int j = 0; j <= i; ++j) matrix_[i][j] += kSignalTuning.penalty * difference[i] * difference[j];
}

void SmoothingSpline::add(double position, double value) {
  const double knot = std::floor(position);
  const auto first = static_cast<std::int64_t>(knot) - 1;  // whose B-spline the position is in
  if (empty_) begin(first);
  while (oldest_open_ < first) {  // closes the oldest open coefficient, and opens the one after the newest
    eliminateOldest(closed_[place(oldest_open_++)]);
    penaliseNewest();
  }
  const double u = position - knot, v = 1.0 - u;
  const std::array<double, 4> weights{v * v * v / 6.0, 2.0 / 3.0 - u * u * (1.0 - u / 2.0),
                                      2.0 / 3.0 - v * v * (1.0 - v / 2.0), u * u * u / 6.0};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j <= i; ++j) matrix_[i][j] += weights[i] * weights[j];
    right_[i] += weights[i] * value;
  }
}

// From the equations of those after it, which move up.
void SmoothingSpline::eliminateOldest(Closed& closed) {
  const double pivot = matrix_[0][0], inverse = 1.0 / pivot;
  closed.value = right_[0] * inverse;
  for (int i = 1; i < kOpen; ++i) {
    closed.factors[i - 1] = matrix_[i][0] * inverse;
    const double eliminated = closed.factors[i - 1] * pivot;
    for (int j = 1; j <= i; ++j) matrix_[i - 1][j - 1] = matrix_[i][j] - eliminated * closed.factors[j - 1];
    right_[i - 1] = right_[i] - eliminated * closed.value;
  }
  matrix_[kOpen - 1] = {};
  right_[kOpen - 1] = 0.0;
}

void SmoothingSpline::solve(std::int64_t first, std::int64_t settled) {
  const auto matrix = matrix_;
  const auto right = right_;
  for (int k = 0; k < kOpen; ++k) eliminateOldest(closed_[place(oldest_open_ + k)]);
  matrix_ = matrix;  // they stay open
  right_ = right;
  double next = 0.0, second = 0.0, third = 0.0, fourth = 0.0;
  for (std::int64_t k = oldest_open_ + kOpen - 1; k >= std::max(first, settled_ + 1); --k) {
    const Closed& closed = closed_[place(k)];
    const double coefficient = closed.value - closed.factors[0] * next - closed.factors[1] * second -
                               closed.factors[2] * third - closed.factors[3] * fourth;
    fourth = std::exchange(third, std::exchange(second, std::exchange(next, coefficient)));
    coefficients_[place(k)] = coefficients_[place(k) + kKept] = coefficient;
  }
  settled_ = std::max(settled_, settled);
}

namespace {

constexpr int kReach = 2 * StreamResampler::kHalfWidth + 1;  // of the filter on the coefficients [knots]

using Taps = Eigen::Matrix<double, 2 * kReach + 1, 1>;

/// The low-pass filter on the spline's values at the knots, as one on its coefficients: a value is
/// (c_(k-1) + 4 c_k + c_(k+1)) / 6.
Taps makeTaps() {
  Taps taps = Taps::Zero();
  for (int k = 1 - kReach; k < kReach; ++k) {
    const double place = static_cast<double>(k) / (kReach - 1), angle = M_PI * kSignalTuning.cutoff * k;
    const double window = std::cyl_bessel_i(0.0, kSignalTuning.kaiser * std::sqrt(1.0 - place * place));
    const double sinc = k == 0 ? 1.0 : std::sin(angle) / angle;
    taps.segment<3>(kReach + k - 1) += sinc * window * Eigen::Vector3d(1.0, 4.0, 1.0);
  }
  return taps / taps.sum();
}

// @return periods of the stream from one reading to the next; 0 if its period is not known yet.
double periodsBetween(const SensorReading& before, const SensorReading& after) {
  return after.stream_period > 0.0 ? toSeconds(after.taken - before.taken) / after.stream_period : 0.0;
}

// @return the same in whole periods; 0 if they are not whole.
long wholePeriodsBetween(const SensorReading& before, const SensorReading& after) {
  const double periods = periodsBetween(before, after);
  return std::abs(periods - std::round(periods)) <= kSmall ? std::lround(periods) : 0;
}

}  // namespace

StreamResampler::StreamResampler(Stamp period)
    : period_(period), reach_(kHalfWidth * period), after_loss_(LostReadings::kWindow) {}

void StreamResampler::clear() {
  origin_.reset();
  first_.reset();
}

std::optional<Stamp> StreamResampler::earliest(const ReadingQueue& waiting) const {
  if (first_) return *first_ + reach_;
  if (waiting.empty()) return std::nullopt;
  return waiting.front().taken + reach_;
}

StreamResampler::Coverage StreamResampler::advance(Stamp t, ReadingQueue& waiting) {
  if (!origin_) origin_ = t;
  while (!first_ || last_.taken < t + reach_) {
    if (waiting.empty() || !fillIn(waiting)) return Coverage::kComes;
    const SensorReading reading = waiting.front();
    waiting.pop_front();
    const bool interrupted = first_ && followsAfterGap(reading);
    if (!first_ || interrupted) begin(reading);
    take(reading);
    if (interrupted) return Coverage::kInterrupted;
  }
  return *first_ <= t - reach_ ? Coverage::kCovered : Coverage::kInterrupted;
}

bool StreamResampler::followsAfterGap(const SensorReading& reading) const {
  const double period = toSeconds(period_);
  const double spacing = std::clamp(reading.stream_period, period, kSignalTuning.slowest * period);
  return toSeconds(reading.taken - last_.taken) > kSignalTuning.longest_bridge * spacing;
}

// Predicts what was lost before the next reading. @return false: readings by which it is predicted are to come.
bool StreamResampler::fillIn(const ReadingQueue& waiting) {
  const long farthest = LostReadings::kWindow - LostReadings::kReach;  // periods after the last reading
  // Of a slower stream the readings after the loss would come too late for those that wait for it.
  const bool is_slow = static_cast<double>(farthest) * waiting.front().stream_period > toSeconds(kMostOptionalLag);
  if (!first_ || is_slow || !lost_readings_.isReady()) return true;
  const long periods = wholePeriodsBetween(last_, waiting.front());
  if (periods < 2 || periods > LostReadings::kMost + 1) return true;
  after_loss_.clear();
  const SensorReading* before = &last_;
  for (long place = 0; place < farthest;) {
    if (after_loss_.size() == waiting.size()) return false;
    const SensorReading& next = waiting[after_loss_.size()];
    const long since = wholePeriodsBetween(*before, next);
    place += since;
    if (since == 0 || place > farthest) break;
    after_loss_.push_back({static_cast<int>(place), next.value});
    before = &next;
  }
  SensorReading filled = last_;
  const Stamp spacing = (waiting.front().taken - last_.taken) / periods;
  for (const double value : lost_readings_.predict(static_cast<int>(periods) - 1, after_loss_)) {
    filled.taken += spacing;
    filled.value = value;
    take(filled);
    ++bridged_;
  }
  return true;
}

void StreamResampler::begin(const SensorReading& reading) {
  first_ = reading.taken;
  last_ = reading;
  reference_ = reading.value;
  spline_.clear();
  next_knot_ = static_cast<std::int64_t>(std::ceil(2.0 * toSeconds(reading.taken - *origin_) / toSeconds(period_)));
}

void StreamResampler::take(const SensorReading& reading) {
  bridged_ += static_cast<std::uint64_t>(std::max(1L, std::lround(periodsBetween(last_, reading))) - 1);
  if (wholePeriodsBetween(last_, reading) != 1) lost_readings_.startNewSeries();
  const double position =
      2.0 * static_cast<double>((reading.taken - *origin_).count()) / static_cast<double>(period_.count());
  for (; static_cast<double>(next_knot_) < position; ++next_knot_) stillAt(next_knot_) = last_.still;
  spline_.add(position, reading.value - reference_);
  lost_readings_.add(reading.value);
  last_ = reading;
}

StreamResampler::Value StreamResampler::at(Stamp t) {
  static const Taps taps = makeTaps();
  const std::int64_t middle = 2 * ((t - *origin_) / period_);
  spline_.solve(middle - kReach, middle);
  const double filtered = taps.dot(Eigen::Map<const Taps>(spline_.coefficients(middle - kReach)));
  return {reference_ + filtered, stillAt(middle)};
}

}  // namespace suspension_health_monitor
