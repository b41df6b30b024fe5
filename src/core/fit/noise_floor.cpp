#include "suspension_health_monitor/internal/fit/noise_floor.h"

#include <Eigen/Core>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/free_form.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {
namespace {

using Series = std::vector<std::vector<double>>;  // per segment

constexpr Eigen::Index kReach = 16;  // samples to either side
constexpr Eigen::Index kTerms = 4 * kReach + 1;
constexpr std::size_t kMostRows = 6000;  // of long drives every so many: 1 % of the floor is chance
constexpr int kReweightings = 2;
constexpr int kRounds = 3;  // interpolation and laws in turns
constexpr int kNodes = 17;  // of a force of travel or of travel rate alone
constexpr Eigen::Index kLawTerms = 2 * kNodes + kForceNodes * kForceNodes + 2;

/// One sample that is interpolated: its segment, and its place there.
using Place = std::pair<std::size_t, Eigen::Index>;

std::vector<Place> choosePlaces(const Segments& segments) {
  std::vector<Place> all;
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (Eigen::Index k = kReach; k + kReach < static_cast<Eigen::Index>(segments[s]->size()); ++k)
      all.emplace_back(s, k);
  const std::size_t stride = 1 + all.size() / kMostRows;
  std::vector<Place> chosen;
  for (std::size_t i = 0; i < all.size(); i += stride) chosen.push_back(all[i]);
  return chosen;
}

double deviationOf(const Eigen::VectorXd& error) {
  return robustDeviation({error.data(), error.data() + error.size()});
}

/// A robust linear regression.
/// @return the solution, and what it leaves.
std::pair<Eigen::VectorXd, Eigen::VectorXd> regressed(const Eigen::MatrixXd& rows, const Eigen::VectorXd& measured) {
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(measured.size()), solution, error;
  for (int pass = 0; pass <= kReweightings; ++pass) {
    const Eigen::MatrixXd weighted = weight.asDiagonal() * rows;
    Eigen::MatrixXd gram = rows.transpose() * weighted;
    gram.diagonal().array() += 1e-12 * gram.trace();  // for columns that are 0
    solution = solveSymmetric(gram, weighted.transpose() * measured);
    error = measured - rows * solution;
    const double outlier = kOutlierScale * deviationOf(error);
    if (outlier == 0.0) break;
    weight = error.unaryExpr([&](double e) { return 1.0 / (1.0 + square(square(e / outlier))); });
  }
  return {solution, error};
}

/// z'' from its neighbours, from the wheel's motion during the steps around it (which stands for w''), and a constant.
/// @param series  z'' per segment.  @return as regressed().
std::pair<Eigen::VectorXd, Eigen::VectorXd> interpolated(const Segments& segments, const std::vector<Place>& places,
                                                         const Series& series) {
  Eigen::MatrixXd rows(places.size(), kTerms);
  Eigen::VectorXd measured(rows.rows());
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const auto [index, k] = places[r];
    const DriveSegment& segment = *segments[index];
    const double* const y = series[index].data() + k;
    for (Eigen::Index i = 0; i < kReach; ++i) {
      rows(r, i) = y[-1 - i];
      rows(r, kReach + i) = y[1 + i];
    }
    for (Eigen::Index i = 0; i < 2 * kReach; ++i) {
      const auto step = (segment.lead() + k - kReach + i) * segment.steps;
      rows(r, 2 * kReach + i) = segment.wheel[step].end_velocity / segment.period;
    }
    rows(r, kTerms - 1) = 1.0;
    measured[r] = *y;
  }
  return regressed(rows, measured);
}

/// Laws that a model may lack, along its free run: a free-form force of travel rate, with nodes that lie closer the
/// nearer to 0, where friction turns; one of travel; one of both; and both times time.
class FreeFormLaws {
 public:
  explicit FreeFormLaws(const Segments& segments) : segments_(segments) {}

  /// The motion of the free run, corrected by what its residual says: the forces that are missing move the strut.
  /// @return false if the model runs away, or nothing moves.
  bool run(const StrutModel& model) {
    const auto residuals = freeRunResiduals(model, segments_, std::vector<StrutState>(segments_.size()), &motion_);
    if (!residuals) return false;
    double count = 0.0;
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      const std::vector<double>& residual = (*residuals)[s];
      const MotionError wrong =
          motionError(residual, meanOf({residual}), segments_[s]->period, model.stiffness_to_mass);
      for (std::size_t k = 0; k < residual.size(); ++k) {
        travel_ += square(motion_[s][k].travel -= wrong.travel[k]);
        travel_rate_ += square(motion_[s][k].travel_rate -= wrong.travel_rate[k]);
      }
      count += static_cast<double>(residual.size());
    }
    for (double* sum : {&travel_, &travel_rate_}) *sum = std::sqrt(*sum / count);
    return travel_ > 0.0 && travel_rate_ > 0.0;
  }

  /// What the laws do to an interpolation, which sees the same forces in the neighbours.
  Eigen::MatrixXd interpolated(const std::vector<Place>& places, const Eigen::VectorXd& interpolation) const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(places.size(), kLawTerms);
    for (Eigen::Index r = 0; r < rows.rows(); ++r) {
      const auto& [segment, sample] = places[r];
      const auto add = [&, segment = segment, sample = sample](Eigen::Index offset, double factor) {
        at(segment, sample + offset, [&](Eigen::Index term, double value) { rows(r, term) += factor * value; });
      };
      add(0, 1.0);
      for (Eigen::Index i = 0; i < kReach; ++i) {
        add(-1 - i, -interpolation[i]);
        add(1 + i, -interpolation[kReach + i]);
      }
    }
    return rows;
  }

  /// Takes the laws off a series.
  void takeOff(const Eigen::VectorXd& coefficients, Series& series) const {
    for (std::size_t s = 0; s < series.size(); ++s)
      for (std::size_t k = 0; k < series[s].size(); ++k)
        at(s, k, [&](Eigen::Index term, double value) { series[s][k] -= coefficients[term] * value; });
  }

 private:
  /// Calls take(term, value) for every term that is not 0 at a sample.
  template <class Take>
  void at(std::size_t segment, std::size_t sample, const Take& take) const {
    const StrutState& state = motion_[segment][sample];
    const double travel = state.travel / travel_, rate = state.travel_rate / travel_rate_;
    const double near_zero = std::copysign(std::sqrt(std::abs(rate) * kOutermostNode), rate);
    forHatsAt(near_zero, kNodes, take);
    forHatsAt(travel, kNodes, [&](int node, double value) { take(kNodes + node, value); });
    forHatsAt(travel, rate, kForceNodes, [&](int node, double value) { take(2 * kNodes + node, value); });
    const double time =
        segments_[segment]->timeDriven(sample) / segments_.back()->timeDriven(segments_.back()->size()) - 0.5;
    take(kLawTerms - 2, time * rate);
    take(kLawTerms - 1, time * travel);
  }

  const Segments& segments_;
  FreeMotion motion_;
  double travel_ = 0.0, travel_rate_ = 0.0;  // rms
};

/// @return standard deviation of what neither an interpolation of z'' nor laws predict; 0 if there are too few samples.
double unpredicted(const Segments& segments, const StrutModel& model) {
  const std::vector<Place> places = choosePlaces(segments);
  const auto count = static_cast<double>(places.size());
  if (count <= 2.0 * kTerms) return 0.0;
  Series series = mapped(segments, &DriveSegment::sprung);
  auto [weights, error] = interpolated(segments, places, series);
  const double plain = deviationOf(error) * std::sqrt(count / (count - kTerms));
  FreeFormLaws laws(segments);
  if (count <= 2.0 * (kTerms + kLawTerms) || !laws.run(model)) return plain;
  double deviation = 0.0;
  for (int round = 1;; ++round) {
    const auto [coefficients, left] = regressed(laws.interpolated(places, weights), error);
    deviation = deviationOf(left) * std::sqrt(count / (count - kTerms - kLawTerms));
    if (round == kRounds) break;
    laws.takeOff(coefficients, series);
    std::tie(weights, error) = interpolated(segments, places, series);
  }
  return std::min(plain, deviation);
}

double ofBothSensors(double body_noise, double period, const StrutModel& model) {
  return body_noise * std::sqrt(noiseOfBothSensors(model.damping_to_mass, model.stiffness_to_mass, period));
}

}  // namespace

double estimateNoiseFloor(const Records& records, const StrutModel& model) {
  const double floor = records.front()->noise().empty()
                           ? ofBothSensors(unpredicted(segmentsOf(records), model), records.front()->period(), model)
                           : floorOfKnownNoise(records, model);
  return floor > 0.0 ? std::max(floor, accuracyOfFreeRuns(records)) : 0.0;
}

double lostInSampling(const Records& records, const ModelFit& fit) {
  const Segments segments = segmentsOf(records);
  const std::vector<Place> places = choosePlaces(segments);
  const auto count = static_cast<double>(places.size());
  if (count <= 2.0 * kTerms) return 0.0;
  Series predicted = mapped(segments, &DriveSegment::sprung);
  for (std::size_t s = 0; s < predicted.size(); ++s)
    for (std::size_t k = 0; k < predicted[s].size(); ++k) predicted[s][k] -= fit.residuals[s][k];
  const Eigen::VectorXd error = interpolated(segments, places, predicted).second;
  const double lost = std::sqrt(error.squaredNorm() / (count - kTerms));
  return ofBothSensors(lost, records.front()->period(), fit.model);
}

double accuracyOfFreeRuns(const Records& records) {
  const double power = meanSquare(mapped(segmentsOf(records), &DriveSegment::sprung));
  return kInterpolationAccuracy * std::sqrt(power);
}

}  // namespace suspension_health_monitor
