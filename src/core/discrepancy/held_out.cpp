#include "suspension_health_monitor/discrepancy/held_out.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "suspension_health_monitor/pi.h"

namespace suspension_health_monitor {
namespace {

// Not in long double, as is Boost's habit: its tables are set up when the library is loaded, and that fails where long
// double is no longer than double, under valgrind for one.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

constexpr std::size_t kBlocks = 15;  // per record
constexpr std::size_t kFewestStretches = 8;
constexpr std::size_t kSettlingPeriods = 2;  // natural periods
}  // namespace

PairedComparison comparePaired(const std::vector<double>& before, const std::vector<double>& after,
                               double independent) {
  double sum = 0.0, square = 0.0, total = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double difference = before[i] - after[i];
    sum += difference;
    square += difference * difference;
    total += before[i];
  }
  const auto n = static_cast<double>(before.size());
  const double variance = std::max(0.0, (square - sum * sum / n) / (n - 1.0));
  PairedComparison result;
  if (total > 0.0) result.removed_share = sum / total;
  if (total > sum && total > 0.0) result.log_ratio = independent * std::log(total / (total - sum));
  if (variance > 0.0) result.t = sum / std::sqrt(n * variance);
  return result;
}

bool isSignificant(const PairedComparison& comparison, double probability) {
  const boost::math::normal_distribution<double, InDouble> normal;
  const boost::math::chi_squared_distribution<double, InDouble> chi_squared(2.0);  // a coefficient and a shape
  return comparison.t > boost::math::quantile(boost::math::complement(normal, probability)) ||
         comparison.log_ratio > boost::math::quantile(boost::math::complement(chi_squared, probability));
}

std::optional<HeldOut> holdOut(const std::vector<const DriveRecord*>& records, double stiffness_to_mass) {
  HeldOut result;
  double sum = 0.0, square = 0.0;
  std::size_t segment_index = 0;
  for (const DriveRecord* record : records) {
    const auto period = static_cast<std::size_t>(
        std::max(4.0, std::round(2.0 * kPi / std::sqrt(stiffness_to_mass) / record->period())));
    const std::size_t block = std::max<std::size_t>(1, record->numSamples() / kBlocks);
    std::size_t position = 0;  // in the record
    result.training.emplace_back();
    for (const DriveSegment& segment : record->segments()) {
      SampleMask mask(segment.size(), 1);
      for (std::size_t k = 0; k < segment.size(); ++k) {
        // The beginning of a segment is always fitted: nothing else tells its initial state.
        if (k < kSettlingPeriods * period || (position + k) / block % 3 != 2) continue;
        mask[k] = 0;
        sum += segment.sprung[k];
        square += segment.sprung[k] * segment.sprung[k];
        result.samples_ += 1.0;
        const bool goes_on = !result.stretches_.empty() && result.stretches_.back().segment == segment_index &&
                             result.stretches_.back().last == k && k - result.stretches_.back().first < period;
        if (goes_on)
          result.stretches_.back().last = k + 1;
        else
          result.stretches_.push_back({segment_index, k, k + 1});
      }
      position += segment.size();
      ++segment_index;
      result.training.back().push_back(std::move(mask));
    }
  }
  if (result.stretches_.size() < kFewestStretches) return std::nullopt;
  const double mean = sum / result.samples_;
  result.deviation_ = std::sqrt(std::max(0.0, square / result.samples_ - mean * mean));
  return result;
}

template <class Loss>
std::vector<double> HeldOut::sumByStretch(const std::vector<std::vector<double>>& residuals, const Loss& loss) const {
  std::vector<double> sums;
  for (const Stretch& stretch : stretches_) {
    double sum = 0.0;
    for (std::size_t k = stretch.first; k < stretch.last; ++k) sum += loss(residuals[stretch.segment][k]);
    sums.push_back(sum);
  }
  return sums;
}

std::vector<double> HeldOut::stretchErrors(const std::vector<std::vector<double>>& residuals) const {
  return sumByStretch(residuals, [](double r) { return r * r; });
}

std::vector<double> HeldOut::stretchLosses(const std::vector<std::vector<double>>& residuals, double outlier) const {
  return sumByStretch(residuals, [outlier](double r) {
    const double q = r / outlier;
    return 2.0 * r * r / (std::sqrt(1.0 + q * q) + 1.0);  // without the cancellation of the formula as it is written
  });
}

double HeldOut::independentSquares(const std::vector<std::vector<double>>& residuals) const {
  double square = 0.0;
  std::size_t most_lags = 0;
  for (const Stretch& stretch : stretches_) {
    most_lags = std::max(most_lags, stretch.last - stretch.first);
    for (std::size_t k = stretch.first; k < stretch.last; ++k)
      square += residuals[stretch.segment][k] * residuals[stretch.segment][k];
  }
  if (square == 0.0) return samples_;
  double coloured = 1.0;
  for (std::size_t lag = 1; lag < most_lags; ++lag) {
    double product = 0.0;  // with the samples before the stretch, held out or not
    for (const Stretch& stretch : stretches_)
      for (std::size_t k = std::max(stretch.first, lag); k < stretch.last; ++k)
        product += residuals[stretch.segment][k] * residuals[stretch.segment][k - lag];
    coloured += 2.0 * (product / square) * (product / square);
  }
  return samples_ / coloured;
}

double HeldOut::trainingError(const std::vector<std::vector<double>>& residuals) const {
  double sum = 0.0;
  std::size_t segment = 0;
  for (const std::vector<SampleMask>& record : training)
    for (const SampleMask& mask : record) {
      for (std::size_t k = 0; k < mask.size(); ++k)
        if (mask[k] != 0) sum += residuals[segment][k] * residuals[segment][k];
      ++segment;
    }
  return sum;
}

double HeldOut::rmse(const std::vector<double>& stretch_errors) const {
  double sum = 0.0;
  for (const double error : stretch_errors) sum += error;
  return std::sqrt(sum / samples_);
}

}  // namespace suspension_health_monitor
