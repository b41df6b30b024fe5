#include "suspension_health_monitor/internal/monitor/error_budget.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "suspension_health_monitor/internal/identification/excitation.h"
#include "suspension_health_monitor/internal/monitor/validity_gate.h"
#include "suspension_health_monitor/internal/pi.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr int kStddevsEvery = 8;        // rows
constexpr double kFactorOfLevel = 2.0;  // of few blocks or windows a level is known within that
constexpr double kSurely = 3.0;         // standard deviations
constexpr double kMostNoise = 0.8;  // of a residual or moment: no level of noise is known better than within a tenth

double& stddevOf(StrutEstimate& estimate, int i) {
  return i == kDampingToMass     ? estimate.damping_to_mass_stddev
         : i == kStiffnessToMass ? estimate.stiffness_to_mass_stddev
                                 : estimate.coefficient_stddevs[static_cast<std::size_t>(i - kNumStrutParameters)];
}

// What LS and LA differ by beyond the scatter of LS is an error of LS, which suffers wrong readings for as long as it
// remembers them, and whose own scatter does not show that they were all of one sign.
double withDifference(double stddev, double ls, double la) {
  return std::hypot(stddev, std::max(0.0, std::abs(ls - la) - stddev));
}

Eigen::Vector2d strutShift(const RecursiveLeastSquares& least_squares, const Eigen::Vector2d& moment) {
  return {least_squares.parameterShift(kDampingToMass, moment), least_squares.parameterShift(kStiffnessToMass, moment)};
}

}  // namespace

ErrorBudget::ErrorBudget(const IntegralFilterOptions& filter, const RegressorNoise& noise, int num_columns,
                         double forgetting_factor, bool removes_noise_shift)
    : noise_(noise),
      block_(NoiseLevel::blockRows(filter)),
      noise_shift_(Eigen::VectorXd::Zero(num_columns)),
      resampling_noise_(filter.period, forgetting_factor),
      level_changes_(filter.period, forgetting_factor),
      skew_effects_{RunningMeans<kNumSkewEffects>(forgetting_factor), RunningMeans<kNumSkewEffects>(forgetting_factor)},
      stddevs_due_(kStddevsEvery) {
  if (removes_noise_shift) noise_level_.emplace(filter);
}

void ErrorBudget::changeColumns(const std::vector<ColumnOrigin>& columns) {
  const Eigen::VectorXd before = noise_shift_;
  noise_shift_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    if (columns[j].before) noise_shift_[static_cast<Eigen::Index>(j)] = before[*columns[j].before];
  stddevs_due_.restart();
}

void ErrorBudget::addSkew(const RegressionRow& row, const WheelRow& wheel, double skew,
                          const RecursiveEstimator& estimator) {
  const Eigen::VectorXd& strut = estimator.parameters();
  const double x = strut[kDampingToMass] * wheel.output + strut[kStiffnessToMass] * wheel.damping;
  for (int i = 0; i < kNumStrutParameters; ++i) {
    const double moment = x * row.regressor[i];
    if (!estimator.holds(i)) skew_effects_[static_cast<std::size_t>(i)].add({moment, moment * skew});
  }
}

void ErrorBudget::addRow(const RegressionRow& row, double innovation, const RecursiveEstimator& estimator) {
  constexpr double kNoSpring = 1e-6;  // of the residual; beside such a force the regressor itself stands for the level
  const double regressor = row.regressor[kStiffnessToMass], b0 = estimator.parameters()[kStiffnessToMass];
  const bool has_spring = std::abs(b0 * regressor) > kNoSpring * std::abs(innovation);
  level_changes_.add(regressor, has_spring ? innovation / b0 : regressor, !estimator.holds(kStiffnessToMass));
  if (hears_noise_ && noise_level_) noise_level_->add(innovation);
}

void ErrorBudget::interrupt() {
  if (noise_level_) noise_level_->interrupt();
  resampling_noise_.interrupt();
  level_changes_.interrupt();
}

void ErrorBudget::noteValidity(const StrutEstimate& la) {
  // Noise that is as large as the motion is to be known before an estimate can be valid.
  const bool is_doubted = la.doubt == EstimateDoubt::kWrongReadings || la.doubt == EstimateDoubt::kOffsetChanges;
  const bool may_be_noise = is_doubted && la.explained >= kLeastExplained;
  hears_noise_ = la.valid() || may_be_noise || (noise_.isOfVehicle() && la.doubt == EstimateDoubt::kNotExplained);
}

void ErrorBudget::setForgettingFactor(double forgetting_factor) {
  for (auto& effect : skew_effects_) effect.setForgettingFactor(forgetting_factor);
  resampling_noise_.setForgettingFactor(forgetting_factor);
  level_changes_.setForgettingFactor(forgetting_factor);
}

void ErrorBudget::describe(const PairedEstimators& estimators, const SkewProfile* skew, StrutEstimate& ls,
                           StrutEstimate& la) {
  // Of the start values there is no error to tell, and the first estimate comes with its own.
  const bool is_due = stddevs_due_() || std::isnan(la.damping_to_mass_stddev);
  if (!is_due || !(la.effective_rows > 0.0)) return;
  const RecursiveLeastSquares& least_squares = estimators.leastSquares();
  const RecursiveLeastAbsolute& least_absolute = estimators.leastAbsolute();
  const NoiseMoments moments = takeNoise(estimators, {la.damping_to_mass, la.stiffness_to_mass});
  for (int i = 0; i < kNumStrutParameters + static_cast<int>(la.num_effects); ++i) {
    if (least_squares.holds(i)) continue;
    const double by_noise = std::hypot(least_squares.parameterShift(i, moments.mean) - noise_shift_[i],
                                       least_squares.parameterShift(i, moments.spread));
    const double by_wrong = moments.of_wrong_readings ? least_squares.parameterShift(i, *moments.of_wrong_readings)
                                                      : std::numeric_limits<double>::infinity();
    const double by_skew = skewShift(least_squares, skew, i);
    const double by_input = i < kNumStrutParameters ? input_stddevs_[i] : 0.0;
    const double systematic = square(by_noise) + square(by_wrong) + square(by_skew) + square(by_input);
    const auto with_all = [&](double random) { return std::sqrt(random + systematic); };
    stddevOf(ls, i) = withDifference(with_all(least_squares.parameterVariance(i)), least_squares.parameters()[i],
                                     least_absolute.parameters()[i]);
    stddevOf(la, i) = with_all(least_absolute.parameterVariance(i));
  }
}

// The shift by the sensors' noise is taken off from the next description on, by the strut that it leaves now: the fixed
// point of that is the strut whose rows, less the noise's share of their moments, it solves. What is left is what it is
// not taken off of, and that nobody knows how the noise is divided between the sensors.
ErrorBudget::NoiseMoments ErrorBudget::takeNoise(const PairedEstimators& estimators, const Eigen::Vector2d& strut) {
  // For a normal distribution the variance is pi/2 times the mean size squared.
  const double size = estimators.leastAbsolute().usualResidual();
  const double left = 0.5 * kPi * size * size / noise_.residualGain(strut);
  // Beside a parameter that is held P is not that of the rows.
  const bool knows_rows = !estimators.leastSquares().holdsAny();
  const auto unfitted = [&](double variance) {
    return noise_level_ && knows_rows ? unfittedNoise(estimators.leastSquares(), strut, variance) : variance;
  };
  const double present = unfitted(left);
  // A mean of n squares of normal deviates has the variance 2 / n: by so much more noise the few blocks of the memory
  // may have than there is on average.
  const double by_chance = 1.0 + kSurely * std::sqrt(2.0 * block_ / estimators.leastAbsolute().effectiveRows());
  std::optional<double> lasting;
  wrong_.variances = resampling_noise_.variances();
  if (const auto heard = noise_level_ ? noise_level_->sensorVariances(noise_, strut) : std::nullopt) {
    lasting = std::min(heard->of_changes, unfitted(heard->of_means));
    const double slow = unfitted(std::max(heard->of_means, heard->of_late_means));
    wrong_.variances[1] += mostUnanswered(slow, *lasting, by_chance, strut);
  } else {
    // The whole of the residuals stands for their slow part, and the spectrum for what has hardly been in them yet.
    const double folded = square(wheel_.folded) - kFactorOfLevel * present;
    wrong_.variances[1] += std::max(folded, mostUnanswered(by_chance * present, present, by_chance, strut));
  }
  const double variance = std::min(lasting.value_or(present), present);
  noise_variance_ = lasting.value_or(0.0);
  noise_share_ = lasting ? variance / present : 0.0;
  const Eigen::Vector2d moment = noise_.moment(strut, variance);
  const bool removes = lasting && knows_rows;
  if (removes) removeShift(estimators, moment);
  const Eigen::Vector2d spread = lasting ? noise_.momentSpread(strut, variance) : Eigen::Vector2d::Zero();
  return {moment, spread, wrongMoment(estimators.leastSquares(), strut)};
}

// Noise of the wheel's readings that the body does not answer, as of a sensor that is noisier than the body's or of
// motion that the sampling folds back, is no more than what the slow part of the residuals has beside the noise of
// both: that is known within a factor of two. Nor is it more than the wheel's readings have at half the rate beside
// that noise, but for what few blocks have by chance.
double ErrorBudget::mostUnanswered(double slow, double noise, double by_chance, const Eigen::Vector2d& strut) const {
  const double of_residuals = kFactorOfLevel * std::max(0.0, slow - noise) / noise_.wheelShareOfMean(strut);
  return std::min(of_residuals, by_chance * std::max(0.0, square(wheel_.at_limit) - kFactorOfLevel * noise));
}

// The moment is made by the true strut t, which readings as wrong as they may be have moved to the estimate,
// t + R^-1 m(t): with m(t) = m(0) + M t that is (1 + R^-1 M) t = estimate - R^-1 m(0). Where such readings would make
// nearly all of the rows' moments there is no telling.
std::optional<Eigen::Vector2d> ErrorBudget::wrongMoment(const RecursiveLeastSquares& least_squares,
                                                        const Eigen::Vector2d& estimate) {
  const Eigen::Vector2d& variances = wrong_.variances;
  const auto shiftBy = [&](const Eigen::Vector2d& moment) { return strutShift(least_squares, moment); };
  const double level = std::max(0.0, level_changes_.variance() - noise_variance_ * noise_.slowGain());
  const auto ofLevel = [&](const Eigen::Vector2d& strut) -> Eigen::Vector2d {
    return -strut[kStiffnessToMass] * level * Eigen::Vector2d::Unit(kStiffnessToMass);
  };
  const auto momentOf = [&](const Eigen::Vector2d& strut) -> Eigen::Vector2d {
    return noise_.momentOf(strut, variances) + ofLevel(strut);
  };
  const Eigen::Vector2d of_none = momentOf(Eigen::Vector2d::Zero());
  Eigen::Matrix2d kept = Eigen::Matrix2d::Identity();
  for (int j = 0; j < kNumStrutParameters; ++j) kept.col(j) += shiftBy(momentOf(Eigen::Vector2d::Unit(j)) - of_none);
  wrong_.share = std::numeric_limits<double>::infinity();
  wrong_.is_of_level = 2.0 * ofLevel(estimate).norm() > momentOf(estimate).norm();
  if (!(kept.determinant() > 1.0 - kMostNoise)) return std::nullopt;
  const Eigen::Vector2d strut = kept.inverse() * (estimate - shiftBy(of_none));
  wrong_.share = ((strut - estimate).array() / strut.array()).abs().maxCoeff();
  // All of it or none, or a part: a uniform distribution from its end, which the estimate is at.
  return momentOf(strut) / std::sqrt(3.0);
}

// Least squares fits the noise, too, which is missing from what it leaves: where g is the residual's variance by that
// of a sensor, v, and v m the noise's moment, it leaves g v - v^2 m'R^-1 m. @return v, at most twice the left of which
// g would make that.
double ErrorBudget::unfittedNoise(const RecursiveLeastSquares& least_squares, const Eigen::Vector2d& strut,
                                  double left) const {
  const Eigen::Vector2d moment = noise_.moment(strut, 1.0);
  const double share = 4.0 * left * moment.dot(strutShift(least_squares, moment)) / noise_.residualGain(strut);
  return left * 2.0 / (1.0 + std::sqrt(std::clamp(1.0 - share, 0.0, 1.0)));
}

// Noise does no more to a parameter that is excited than kLeastExcitation says.
void ErrorBudget::removeShift(const PairedEstimators& estimators, const Eigen::Vector2d& moment) {
  const RecursiveLeastSquares& least_squares = estimators.leastSquares();
  for (int i = 0; i < estimators.numModelColumns(); ++i) {
    const double most = std::abs(least_squares.parameters()[i]) / Excitation::kLeastExcitation;
    noise_shift_[i] = std::clamp(least_squares.parameterShift(i, moment), -most, most);
  }
}

// What parameter i is off by if the skew is off by its standard deviation, and by what the rows of the memory, which
// were made with the skew as it was known then, differ by from those with the skew as it is known now.
double ErrorBudget::skewShift(const RecursiveLeastSquares& least_squares, const SkewProfile* skew, int i) const {
  if (skew == nullptr) return 0.0;
  const auto shiftBy = [&](SkewEffect which) {
    return least_squares.parameterShift(
        i, {skew_effects_[kDampingToMass].mean(which), skew_effects_[kStiffnessToMass].mean(which)});
  };
  const double of_skew = shiftBy(kOfSkew);
  return std::hypot(std::sqrt(skew->variance()) * of_skew, skew->skew() * of_skew - shiftBy(kTakenOff));
}

double ErrorBudget::explainedBesideNoise(const StrutEstimate& estimate) const {
  if (!noise_.isOfVehicle()) return estimate.explained;
  const double share = std::min(noise_share_, kMostNoise), left = std::pow(1.0 - estimate.explained, 2);
  const Eigen::Vector2d strut(estimate.damping_to_mass, estimate.stiffness_to_mass);
  const double of_output = 1.0 - share * left * noise_.outputGain() / noise_.residualGain(strut);
  return of_output > 0.0 ? 1.0 - std::sqrt((1.0 - share) * left / of_output) : 0.0;
}

}  // namespace suspension_health_monitor
