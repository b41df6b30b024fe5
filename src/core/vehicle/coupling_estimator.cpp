#include "suspension_health_monitor/internal/vehicle/coupling_estimator.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr int kRowsPerHorizon = 8;
// psi's noise is white within a horizon, but what the regressors make of theirs is not: the ratios scatter as if every
// other row counted (vehicle_table coupling: their mean square over the one expected).
constexpr double kRowsPerIndependent = 2.0;
constexpr int kFirstSteps = 30, kBarSteps = 10, kSteps = 3;  // of the alternation: from nothing, with one bar more, on
// A share of 3 % of a strut's own acceleration makes its b1 and b0 wrong by as much at most: a fifth of what warns.
constexpr double kMostDoubt = 0.03;
// The share that noise has in the rows is known to a half: it is that of the residual, which is not all noise.
constexpr double kNoiseKnown = 0.5;
// A law in one strut shows in the columns of another by chance only; a bar that is worth having takes a tenth.
constexpr double kLeastOfBar = 0.1;
constexpr double kCertainOfBar = 50.0;  // chi^2 of two more unknowns: chance gives as much once in 7e10
constexpr double kFarRest = 3.0;        // usual ones: a row that is farther off is limited to it

// Samples from a row that is taken to the next.
int rowSpacing(const IntegralFilterOptions& filter) { return std::max(1, filter.horizon_samples / kRowsPerHorizon); }

}  // namespace

bool CouplingEstimate::isKnown() const { return doubt <= kMostDoubt; }

std::vector<StrutModel> CouplingEstimate::models() const {
  std::vector<StrutModel> models;
  for (Eigen::Index i = 0; i < damping_to_mass.size(); ++i)
    models.push_back({damping_to_mass[i], stiffness_to_mass[i], {}, {}});
  return models;
}

CouplingEstimator::CouplingEstimator(int num_struts, int num_forces, const IntegralFilterOptions& filter, double memory)
    : num_struts_(num_struts),
      num_forces_(num_forces),
      forgetting_factor_(std::exp(-rowSpacing(filter) / memory)),
      noise_(filter),
      regressions_(static_cast<std::size_t>(num_struts), SuspensionRegression(filter)),
      forces_(static_cast<std::size_t>(num_forces), LinearIntegralFilter(2, filter, 2)),
      row_due_(rowSpacing(filter)),
      usual_rest_(forgetting_factor_) {
  const int columns = 3 * num_struts + num_forces + 1;
  row_ = Row::Zero(columns);
  moments_ = Moments::Zero(columns, columns);
  estimate_.coupling.ratios = StrutMatrix::Identity(num_struts, num_struts);
  estimate_.coupling.forces.setZero(num_struts, num_forces);
  estimate_.coupling.bars = StrutMatrix::Zero(num_struts, num_struts);
  estimate_.coupling.own_power = StrutVector::Zero(num_struts);
  estimate_.stddevs = StrutMatrix::Constant(num_struts, num_struts, HUGE_VAL);
  estimate_.force_stddevs = ForceMatrix::Constant(num_struts, num_forces, HUGE_VAL);
  estimate_.damping_to_mass = estimate_.stiffness_to_mass = StrutVector::Zero(num_struts);
  estimate_.own_stddevs.setZero(num_struts, 2);
}

void CouplingEstimator::add(const VehicleSample& sample) {
  if (first_forces_.size() == 0) first_forces_ = sample.forces;
  if (!fillRow(sample) || !row_due_()) return;
  const double weight = weightOfRow();
  weight_ = forgetting_factor_ * weight_ + weight;
  moments_ += weight / weight_ * (row_ * row_.transpose() - moments_);
}

// @return false while the filters fill.
bool CouplingEstimator::fillRow(const VehicleSample& sample) {
  bool is_full = true;
  for (int j = 0; j < num_struts_; ++j) {
    auto& regression = regressions_[static_cast<std::size_t>(j)];
    const RegressionRow* row = regression.push({sample.stamp, sample.sprung[j], sample.unsprung[j]});
    is_full = row != nullptr;
    if (!is_full) continue;
    row_[j] = row->regressor[kDampingToMass];
    row_[num_struts_ + j] = row->regressor[kStiffnessToMass];
    row_[2 * num_struts_ + num_forces_ + j] = row->output;
  }
  for (int k = 0; k < num_forces_; ++k) {
    auto& force = forces_[static_cast<std::size_t>(k)];
    force.push(sample.forces[k] - first_forces_[k]);
    row_[2 * num_struts_ + k] = force.output(2);
  }
  row_[row_.size() - 1] = 1.0;
  return is_full;
}

// Rows whose rest is larger than usual count less, as those of lost readings.
double CouplingEstimator::weightOfRow() {
  if (!has_start_) return 1.0;
  const Coupling& coupling = estimate_.coupling;
  StrutVector own(num_struts_);
  for (int j = 0; j < num_struts_; ++j) own[j] = ownColumns(j).dot(row_.head(2 * num_struts_));
  const StrutVector rest = row_.segment(2 * num_struts_ + num_forces_, num_struts_) - coupling.ratios * own -
                           coupling.forces * row_.segment(2 * num_struts_, num_forces_);
  const double size = rest.norm();
  usual_rest_.add(size);
  return std::min(1.0, kFarRest * usual_rest_.mean() / size);
}

void CouplingEstimator::startNewSeries() {
  for (auto& regression : regressions_) regression.reset();
  for (auto& force : forces_) force.reset();
}

const CouplingEstimate& CouplingEstimator::solve() {
  if (weight_ <= 0.0) return estimate_;
  const Eigen::Index columns = row_.size() - 1;
  const Row mean = moments_.topRightCorner(columns, 1);
  const Moments plain = moments_.topLeftCorner(columns, columns) - mean * mean.transpose();
  const bool is_first = !has_start_;
  if (is_first && !start(plain)) return estimate_;
  refine(plain, is_first ? kFirstSteps : kSteps);
  lookForBars(plain);
  Moments moments = plain;
  const double variance = sensorVariance(plain);
  takeOffNoise(moments, variance);
  describe(plain, moments, variance);
  return estimate_;
}

// @param plain  moments with the noise's.
void CouplingEstimator::refine(const Moments& plain, int steps) {
  for (int i = 0; i < steps; ++i) {
    Moments moments = plain;
    takeOffNoise(moments, sensorVariance(plain));
    solveRatios(moments);
    solveStruts(moments);
  }
}

// Greedily: the bar that takes most, then the next.
void CouplingEstimator::lookForBars(const Moments& plain) {
  while (addBar(plain)) {
  }
}

// @return true if there is one more.
bool CouplingEstimator::addBar(const Moments& plain) {
  const double before = shareLeft(plain);
  const CouplingEstimate known = estimate_;
  CouplingEstimate best = known;
  std::pair<int, int> pair;
  double least = before;
  for (int i = 0; i < num_struts_; ++i)
    for (int j = i + 1; j < num_struts_; ++j) {
      if (std::find(bars_.begin(), bars_.end(), std::pair(i, j)) != bars_.end()) continue;
      estimate_ = known;
      bars_.emplace_back(i, j);
      refine(plain, kBarSteps);
      bars_.pop_back();
      const StrutMatrix& bars = estimate_.coupling.bars;
      const double left = shareLeft(plain);
      if (!(left < least && bars(i, j) > 0.0 && bars(j, i) > 0.0)) continue;
      least = left;
      best = estimate_;
      pair = {i, j};
    }
  // Of moments that are no numbers, before there are rows enough, nothing is certain.
  const double gain = before - least;
  const bool stays = gain >= kLeastOfBar * before && weight_ * gain >= kCertainOfBar * kRowsPerIndependent * least;
  estimate_ = stays && gain > 0.0 ? best : known;
  if (!stays || !(gain > 0.0)) return false;
  bars_.push_back(pair);
  return true;
}

// @return what is left of all outputs, each over its own size.
double CouplingEstimator::shareLeft(const Moments& plain) const {
  const StrutVector rest = restOf(plain);
  double share = 0.0;
  for (int i = 0; i < num_struts_; ++i) {
    const int output = 2 * num_struts_ + num_forces_ + i;
    share += rest[i] / plain(output, output);
  }
  return share;
}

// @return p_j as a combination of the columns I_1^2 u, I_0^2 u of all struts.
CouplingEstimator::Row CouplingEstimator::ownColumns(int j) const {
  Row own = Row::Zero(2 * num_struts_);
  own[j] = estimate_.damping_to_mass[j];
  own[num_struts_ + j] = estimate_.stiffness_to_mass[j];
  for (int m = 0; m < num_struts_; ++m) {
    own[num_struts_ + j] += estimate_.coupling.bars(j, m);
    own[num_struts_ + m] -= estimate_.coupling.bars(j, m);
  }
  return own;
}

// Every strut by the columns of all, without the knowledge that the ratios are the same for damper and spring.
// @return false: there is no strut yet.
bool CouplingEstimator::start(const Moments& moments) {
  const int regressors = 2 * num_struts_ + num_forces_;
  const Moments solution =
      moments.topLeftCorner(regressors, regressors).ldlt().solve(moments.block(0, regressors, regressors, num_struts_));
  for (int j = 0; j < num_struts_; ++j) {
    estimate_.damping_to_mass[j] = solution(j, j);
    estimate_.stiffness_to_mass[j] = solution(num_struts_ + j, j);
  }
  has_start_ = solution.allFinite();
  return has_start_;
}

// Of all struts as they are the ratios, and what each strut is of the ratios.
void CouplingEstimator::solveRatios(const Moments& moments) {
  Coupling& coupling = estimate_.coupling;
  const int n = num_struts_, known = n + num_forces_;
  const Moments of_struts = combined(moments);
  const Moments solution = of_struts.topLeftCorner(known, known).ldlt().solve(of_struts.block(0, known, known, n));
  for (int j = 0; j < n; ++j) {
    const double own = solution(j, j);
    coupling.ratios.col(j) = solution.row(j).transpose() / own;
    coupling.bars.row(j) *= own;
    estimate_.damping_to_mass[j] *= own;
    estimate_.stiffness_to_mass[j] *= own;
  }
  coupling.forces = solution.middleRows(n, num_forces_).transpose();
}

void CouplingEstimator::solveStruts(const Moments& moments) {
  Coupling& coupling = estimate_.coupling;
  const int n = num_struts_;
  const auto unknowns = static_cast<int>(2 * static_cast<std::size_t>(n) + 2 * bars_.size());
  // What one of each unknown is as a combination of the columns, and in which strut.
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(unknowns, 2 * n);
  std::vector<int> place;
  for (int a = 0; a < 2 * n; ++a) {
    columns(a, a) = 1.0;
    place.push_back(a % n);
  }
  for (const auto& [i, j] : bars_)
    for (const auto& [at, other] : {std::pair(i, j), std::pair(j, i)}) {
      const auto row = static_cast<Eigen::Index>(place.size());
      columns(row, n + at) = 1.0;
      columns(row, n + other) = -1.0;
      place.push_back(at);
    }
  const StrutMatrix products = coupling.ratios.transpose() * coupling.ratios;
  const Eigen::MatrixXd inputs = columns * moments.topLeftCorner(2 * n, 2 * n) * columns.transpose();
  const Eigen::MatrixXd outputs = columns * (moments.block(0, 2 * n + num_forces_, 2 * n, n) -
                                             moments.block(0, 2 * n, 2 * n, num_forces_) * coupling.forces.transpose());
  Eigen::MatrixXd normal(unknowns, unknowns);
  Eigen::VectorXd right(unknowns);
  for (int a = 0; a < unknowns; ++a) {
    const int at = place[static_cast<std::size_t>(a)];
    for (int b = 0; b < unknowns; ++b) normal(a, b) = products(at, place[static_cast<std::size_t>(b)]) * inputs(a, b);
    right[a] = outputs.row(a).dot(coupling.ratios.col(at));
  }
  const Eigen::VectorXd own = normal.ldlt().solve(right);
  estimate_.damping_to_mass = own.head(n);
  estimate_.stiffness_to_mass = own.segment(n, n);
  Eigen::Index next = 2 * n;
  for (const auto& [i, j] : bars_) {
    coupling.bars(i, j) = own[next++];
    coupling.bars(j, i) = own[next++];
  }
}

// @return the moments of p_j, x_k and I_2^2 z_i'', in this order.
CouplingEstimator::Moments CouplingEstimator::combined(const Moments& moments) const {
  const int n = num_struts_, rest = n + num_forces_;
  Moments to = Moments::Zero(n + rest, 2 * n + rest);
  for (int j = 0; j < n; ++j) to.row(j).head(2 * n) = ownColumns(j).transpose();
  for (int k = 0; k < rest; ++k) to(n + k, 2 * n + k) = 1.0;
  const Moments half = to * moments;
  return half * to.transpose();
}

// @return mean square of what the model leaves of each I_2^2 z_i''.
StrutVector CouplingEstimator::restOf(const Moments& moments) const {
  const int n = num_struts_, known = n + num_forces_;
  const Moments of_struts = combined(moments);
  StrutVector rest(n);
  for (int i = 0; i < n; ++i) {
    Row with = Row::Zero(2 * n + num_forces_);
    with.head(n) = -estimate_.coupling.ratios.row(i).transpose();
    with.segment(n, num_forces_) = -estimate_.coupling.forces.row(i).transpose();
    with[known + i] = 1.0;
    rest[i] = with.dot(of_struts * with);
  }
  return rest;
}

// What noise of both sensors of every strut alike would have to be to leave the least of the rests.
double CouplingEstimator::sensorVariance(const Moments& moments) const {
  const StrutVector rest = restOf(moments);
  double least = HUGE_VAL;
  for (int i = 0; i < num_struts_; ++i) {
    double gain = noise_.residualGain(strut(i));
    for (int j = 0; j < num_struts_; ++j)
      if (j != i) gain += std::pow(estimate_.coupling.ratios(i, j), 2) * noise_.forceGain(strut(j));
    least = std::min(least, std::max(0.0, rest[i]) / gain);
  }
  return least;
}

void CouplingEstimator::takeOffNoise(Moments& moments, double sensor_variance) const {
  const int n = num_struts_;
  const Eigen::Matrix3d noise = sensor_variance * noise_.rowMoments();
  for (int j = 0; j < n; ++j) {
    const std::array<int, 3> columns{j, n + j, 2 * n + num_forces_ + j};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        moments(columns[static_cast<std::size_t>(a)], columns[static_cast<std::size_t>(b)]) -= noise(a, b);
  }
}

// @param plain  with the noise's.
void CouplingEstimator::describe(const Moments& plain, const Moments& moments, double sensor_variance) {
  const int n = num_struts_, known = n + num_forces_;
  Coupling& coupling = estimate_.coupling;
  const Moments of_struts = combined(moments).topLeftCorner(known, known);
  const StrutVector rest = restOf(plain);
  coupling.own_power = of_struts.diagonal().head(n);
  coupling.rest_power = rest.minCoeff();
  describeAlike(plain, sensor_variance);
  const double share = describeErrors(moments, of_struts, rest);
  estimate_.doubt = share + kNoiseKnown / estimate_.told_apart;
  const bool are_struts = estimate_.damping_to_mass.minCoeff() > 0.0 && estimate_.stiffness_to_mass.minCoeff() > 0.0;
  if (!(estimate_.doubt >= 0.0) || !are_struts || !(coupling.own_power.minCoeff() > 0.0)) estimate_.doubt = HUGE_VAL;

  const Moments columns = plain.topLeftCorner(2 * n, 2 * n);
  const Row size = columns.diagonal().cwiseSqrt().cwiseInverse();
  const Moments scaled = size.asDiagonal() * columns * size.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Moments> spread(scaled, Eigen::EigenvaluesOnly);
  estimate_.condition = std::sqrt(spread.eigenvalues()[2 * n - 1] / spread.eigenvalues()[0]);
}

// Which struts the rows tell apart least.
void CouplingEstimator::describeAlike(const Moments& plain, double sensor_variance) {
  const int n = num_struts_;
  Moments noise = Moments::Zero(plain.rows(), plain.cols());
  takeOffNoise(noise, -sensor_variance);
  const StrutMatrix of_noise = combined(noise).topLeftCorner(n, n);
  const StrutMatrix with_noise = combined(plain).topLeftCorner(n, n);
  const Eigen::GeneralizedSelfAdjointEigenSolver<StrutMatrix> parts(with_noise, of_noise);
  estimate_.told_apart = parts.eigenvalues()[0];
  StrutVector sizes = parts.eigenvectors().col(0).cwiseAbs();
  const auto largest = [&] {
    return static_cast<int>(std::max_element(sizes.data(), sizes.data() + n) - sizes.data());
  };
  estimate_.first_alike = largest();
  sizes[estimate_.first_alike] = -1.0;
  estimate_.second_alike = largest();
}

// Standard deviations of ratios and forces' coefficients, and what they make of each strut's own parameters: an error
// of rho_ij is taken for the strut's own, as far as strut j moves like it; so with a force.
// @param of_struts  moments of p_j and x_k.  @param rest  of each output.
// @return the largest rms that they give a strut's own acceleration, as a share of it.
double CouplingEstimator::describeErrors(const Moments& moments, const Moments& of_struts, const StrutVector& rest) {
  const int n = num_struts_;
  const Row power = of_struts.diagonal();
  const Moments inverse = of_struts.ldlt().solve(Moments::Identity(of_struts.rows(), of_struts.cols()));
  double most = 0.0;
  for (int i = 0; i < n; ++i) {
    Moments variances = rest[i] * kRowsPerIndependent / weight_ * inverse;
    variances.row(i).setZero();
    variances.col(i).setZero();
    estimate_.stddevs.row(i) = variances.diagonal().head(n).cwiseSqrt().transpose();
    for (int k = 0; k < num_forces_; ++k)
      estimate_.force_stddevs(i, k) = power[n + k] > 0.0 ? std::sqrt(variances(n + k, n + k)) : HUGE_VAL;
    most = std::max(most, variances.diagonal().dot(power) / power[i]);
    Eigen::Matrix2d of_own;
    of_own << moments(i, i), moments(i, n + i), moments(n + i, i), moments(n + i, n + i);
    using Shared = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMostStruts + kMostKnownForces>;
    Shared with_others(2, n + num_forces_);
    for (int j = 0; j < n; ++j) {
      with_others(0, j) = strut(j).dot(Eigen::Vector2d(moments(i, j), moments(i, n + j)));
      with_others(1, j) = strut(j).dot(Eigen::Vector2d(moments(n + i, j), moments(n + i, n + j)));
    }
    for (int k = 0; k < num_forces_; ++k) with_others.col(n + k) << moments(i, 2 * n + k), moments(n + i, 2 * n + k);
    const Shared taken = of_own.inverse() * with_others;
    const Eigen::Matrix2d shared = taken * variances * taken.transpose();
    estimate_.own_stddevs.row(i) = shared.diagonal().cwiseSqrt().transpose();
  }
  return std::sqrt(most);
}

}  // namespace suspension_health_monitor
