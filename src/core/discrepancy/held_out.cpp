#include "suspension_health_monitor/discrepancy/held_out.h"

#include <Eigen/Dense>
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
constexpr int kPredictorLength = 16;
constexpr Eigen::Index kPredictorTerms = 3 * kPredictorLength + 1;

/// Calls take(row, z'') with what the predictor of every z'' may use: its own past, the wheel's motion during the steps
/// before and after it (which stands for w''), and a constant.
template <class Take>
void forEachPredictorRow(const std::vector<const DriveRecord*>& records, const Take& take) {
  Eigen::VectorXd row(kPredictorTerms);
  for (const DriveRecord* record : records)
    for (const DriveSegment& segment : record->segments()) {
      const auto last = static_cast<int>(segment.size()) - kPredictorLength - 1;
      for (int k = kPredictorLength; k < last; ++k) {
        for (int i = 0; i < kPredictorLength; ++i) row[i] = segment.sprung[static_cast<std::size_t>(k - 1 - i)];
        for (int i = 0; i < 2 * kPredictorLength; ++i) {
          const auto step = static_cast<std::size_t>((k - kPredictorLength + i) * record->steps());
          row[kPredictorLength + i] = segment.wheel[step].end_velocity / record->period();
        }
        row[kPredictorTerms - 1] = 1.0;
        take(row, segment.sprung[static_cast<std::size_t>(k)]);
      }
    }
}

}  // namespace

PairedComparison comparePaired(const std::vector<double>& before, const std::vector<double>& after) {
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
  if (total > sum && total > 0.0) result.log_ratio = n * std::log(total / (total - sum));
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
                             result.stretches_.back().last == k &&
                             k - result.stretches_.back().first < period;
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

std::vector<double> HeldOut::stretchErrors(const std::vector<std::vector<double>>& residuals) const {
  std::vector<double> errors;
  for (const Stretch& stretch : stretches_) {
    double sum = 0.0;
    for (std::size_t k = stretch.first; k < stretch.last; ++k)
      sum += residuals[stretch.segment][k] * residuals[stretch.segment][k];
    errors.push_back(sum);
  }
  return errors;
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

double estimateNoiseFloor(const std::vector<const DriveRecord*>& records, const StrutModel& model) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(kPredictorTerms, kPredictorTerms);
  Eigen::VectorXd moment = Eigen::VectorXd::Zero(kPredictorTerms);
  double count = 0.0;
  forEachPredictorRow(records, [&](const Eigen::VectorXd& row, double measured) {
    gram.selfadjointView<Eigen::Lower>().rankUpdate(row);
    moment += measured * row;
    count += 1.0;
  });
  if (count <= 2.0 * kPredictorTerms) return 0.0;
  gram.diagonal() *= 1.0 + 1e-12;
  const Eigen::VectorXd solution = gram.selfadjointView<Eigen::Lower>().ldlt().solve(moment);
  std::vector<double> innovations;
  innovations.reserve(static_cast<std::size_t>(count));
  forEachPredictorRow(records, [&](const Eigen::VectorXd& row, double measured) {
    innovations.push_back(std::abs(measured - row.dot(solution)));
  });
  // From the median, so that a blow into an end stop is no noise. 0.6745: the median of |x| for a unit normal x.
  const auto middle = innovations.begin() + static_cast<std::ptrdiff_t>(innovations.size() / 2);
  std::nth_element(innovations.begin(), middle, innovations.end());
  const double deviation = *middle / 0.6745 * std::sqrt(count / (count - kPredictorTerms));
  const double b1 = model.damping_to_mass;
  const double b0 = model.stiffness_to_mass;
  // White noise on w'' through G(s) = (b1 s + b0) / (s^2 + b1 s + b0): its variance grows by T (b1^2 + b0) / (2 b1).
  const double through = records.front()->period() * (b1 * b1 + b0) / (2.0 * b1);
  return deviation * std::sqrt(1.0 + through);
}

}  // namespace suspension_health_monitor
