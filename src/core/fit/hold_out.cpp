#include "suspension_health_monitor/internal/fit/hold_out.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

constexpr std::size_t kSettlingPeriods = 2;  // natural periods

PairedTest testPaired(const std::vector<double>& before, const std::vector<double>& after, double independent) {
  using Series = Eigen::Map<const Eigen::ArrayXd>;
  const Eigen::Index count = before.size();
  const Series whole(before.data(), count);
  const Eigen::ArrayXd removed = whole - Series(after.data(), count);
  const double sum = removed.sum(), total = whole.sum(), n = static_cast<double>(count);
  const double variance = (removed - removed.mean()).square().sum() / (n - 1.0);
  PairedTest result;
  if (total > 0.0) result.removed_share = sum / total;
  if (total > sum && total > 0.0) result.log_ratio = independent * std::log(total / (total - sum));
  if (variance > 0.0) result.t = sum / std::sqrt(n * variance);
  return result;
}

bool isSignificant(const PairedTest& comparison, double probability) {
  // chi square of two degrees of freedom, a coefficient and a shape: P(x > q) = exp(-q / 2).
  return comparison.t > normalQuantile(probability) || comparison.log_ratio > -2.0 * std::log(probability);
}

std::optional<HoldOut> splitHoldOut(const Records& records, double stiffness_to_mass) {
  HoldOut result;
  double sum = 0.0, squares = 0.0;
  for (const DriveRecord* record : records) {
    const double natural_period = std::round(2.0 * M_PI / std::sqrt(stiffness_to_mass) / record->period());
    const double longest = static_cast<double>(record->numSamples());  // then nothing is held out
    const auto period = static_cast<std::size_t>(std::max(4.0, std::min(natural_period, longest)));
    const std::size_t block = std::max<std::size_t>(1, record->numSamples() / static_cast<std::size_t>(kEnoughPeriods));
    std::size_t position = 0;  // in the record
    for (const DriveSegment& segment : record->segments()) {
      const std::size_t index = result.training.size();
      SampleMask& mask = result.training.emplace_back(segment.size(), 1);
      for (std::size_t k = 0; k < segment.size(); ++k) {
        // The beginning of a segment is always fitted: nothing else tells its initial state.
        if (k < kSettlingPeriods * period || (position + k) / block % 3 != 2) continue;
        mask[k] = 0;
        sum += segment.sprung[k];
        squares += square(segment.sprung[k]);
        result.samples_ += 1.0;
        std::vector<HoldOut::Stretch>& stretches = result.stretches_;
        const bool goes_on = !stretches.empty() && stretches.back().segment == index && stretches.back().last == k &&
                             k - stretches.back().first < period;
        if (!goes_on) stretches.push_back({index, k, k});
        stretches.back().last = k + 1;
      }
      position += segment.size();
    }
  }
  if (result.stretches_.size() < kFewestForScatter) return std::nullopt;
  const double mean = sum / result.samples_;
  result.deviation_ = std::sqrt(std::max(0.0, squares / result.samples_ - mean * mean));
  return result;
}

std::vector<double> HoldOut::stretchLosses(const Residuals& residuals, double outlier) const {
  std::vector<double> losses;
  for (const Stretch& stretch : stretches_) {
    double& loss = losses.emplace_back(0.0);
    for (std::size_t k = stretch.first; k < stretch.last; ++k) {
      const double r = residuals[stretch.segment][k];
      // without the cancellation of the formula as it is written
      loss += 2.0 * square(r) / (std::sqrt(1.0 + square(r / outlier)) + 1.0);
    }
  }
  return losses;
}

double HoldOut::independentSquares(const Residuals& residuals) const {
  double squares = 0.0;
  std::size_t most_lags = 0;
  for (const Stretch& stretch : stretches_) {
    most_lags = std::max(most_lags, stretch.last - stretch.first);
    for (std::size_t k = stretch.first; k < stretch.last; ++k) squares += square(residuals[stretch.segment][k]);
  }
  if (squares == 0.0) return samples_;
  double coloured = 1.0;
  for (std::size_t lag = 1; lag < most_lags; ++lag) {
    double product = 0.0;  // with the samples before the stretch, held out or not
    for (const Stretch& stretch : stretches_)
      for (std::size_t k = std::max(stretch.first, lag); k < stretch.last; ++k)
        product += residuals[stretch.segment][k] * residuals[stretch.segment][k - lag];
    coloured += 2.0 * square(product / squares);
  }
  return samples_ / coloured;
}

double HoldOut::trainingError(const Residuals& residuals) const {
  return joined(training).dot(joined(residuals).cwiseAbs2());
}

double HoldOut::rmse(const Residuals& residuals) const {
  const std::vector<double> squares = stretchLosses(residuals);
  return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / samples_);
}

}  // namespace suspension_health_monitor
