#include "suspension_health_monitor/internal/vehicle/coupling_estimator.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/vehicle/separation.h"

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
constexpr double kCertain = 50.0;  // chi^2 of two more unknowns: chance gives as much once in 7e10
constexpr double kFarRest = 3.0;   // usual ones: a row that is farther off is limited to it

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

CouplingEstimator::CouplingEstimator(int num_struts, int num_forces, const IntegralFilterOptions& filter, double memory,
                                     const SensorNoise& noise)
    : num_struts_(num_struts),
      num_forces_(num_forces),
      fill_(2 * filter.horizon_samples + 1),
      forgetting_factor_(std::exp(-rowSpacing(filter) / memory)),
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
  estimate_.stddevs.diagonal().setZero();
  setNoise(noise);
}

void CouplingEstimator::setNoise(const SensorNoise& noise) {
  CouplingEstimator rows(*this);  // its filters are at work on the drive
  const Eigen::Index columns = row_.size() - 1;
  noise_ = Moments::Zero(columns, columns);
  const VehicleSample at_rest{
      {}, StrutVector::Zero(num_struts_), StrutVector::Zero(num_struts_), ForceVector::Zero(num_forces_)};
  rows.first_forces_ = at_rest.forces;
  for (const StrutDrives& response : noise) {
    const VehicleDrive wrong{response};
    rows.startNewSeries();
    for (int k = 1; k < fill_; ++k) rows.fillRow(at_rest);
    const std::size_t length = response.front().samples.size();
    for (std::size_t k = 0; k < length + static_cast<std::size_t>(fill_); ++k) {
      VehicleSample sample = k < length ? sampleOf(wrong, k) : at_rest;
      sample.forces = at_rest.forces;
      rows.fillRow(sample);
      noise_ += rows.row_.head(columns) * rows.row_.head(columns).transpose();
    }
  }
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
  if (!estimate_.isKnown() && !start(plain)) return estimate_;
  refine(plain, kSteps);
  lookForBars(plain);
  const double variance = sensorVariance(plain);
  describe(plain, plain - variance * noise_, variance);
  return estimate_;
}

// @param plain  moments with the noise's.
void CouplingEstimator::refine(const Moments& plain, int steps) {
  for (int i = 0; i < steps; ++i) {
    const Moments moments = plain - sensorVariance(plain) * noise_;
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
  const bool stays = gain >= kLeastOfBar * before && isCertain(before, least);
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

// The alternation goes downhill, and where tracks are alike there is more than one valley. It is begun by what is known
// so far, by every strut alone, and by the columns of all without the knowledge that the ratios are the same for damper
// and spring. The best is kept; how far the others are from it that are no worse for certain is in doubt.
// @return false: there is no strut yet.
bool CouplingEstimator::start(const Moments& plain) {
  const int n = num_struts_, regressors = 2 * n + num_forces_;
  const Moments of_all =
      plain.topLeftCorner(regressors, regressors).ldlt().solve(plain.block(0, regressors, regressors, n));
  const CouplingEstimate before = estimate_;
  CouplingEstimate alone = before, together = before;
  for (int j = 0; j < n; ++j) {
    together.damping_to_mass[j] = of_all(j, j);
    together.stiffness_to_mass[j] = of_all(n + j, j);
    Eigen::Matrix2d own;
    own << plain(j, j), plain(j, n + j), plain(n + j, j), plain(n + j, n + j);
    const Eigen::Vector2d strut =
        own.ldlt().solve(Eigen::Vector2d(plain(j, regressors + j), plain(n + j, regressors + j)));
    alone.damping_to_mass[j] = strut[0];
    alone.stiffness_to_mass[j] = strut[1];
  }
  std::vector<std::pair<double, CouplingEstimate>> valleys;
  std::vector<CouplingEstimate> begins{together, alone};
  if (has_start_) begins.push_back(before);
  for (const CouplingEstimate& begin : begins) {
    estimate_ = begin;
    refine(plain, kFirstSteps);
    const double left = shareLeft(plain);
    if (left < HUGE_VAL) valleys.emplace_back(left, estimate_);
  }
  if (valleys.empty()) {
    estimate_ = before;
    return false;
  }
  const auto& [least, best] =
      *std::min_element(valleys.begin(), valleys.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  estimate_ = best;
  has_start_ = true;
  valley_doubt_ = 0.0;
  const StrutVector power = combined(plain).diagonal().head(n);
  for (const auto& [left, valley] : valleys) {
    if (isCertain(left, least)) continue;
    const StrutMatrix off = (valley.coupling.ratios - best.coupling.ratios).cwiseAbs2();
    valley_doubt_ = std::max(valley_doubt_, std::sqrt((off * power).cwiseQuotient(power).maxCoeff()));
  }
  return true;
}

// @return true if rows that are left so much of by two models are so by no chance.
bool CouplingEstimator::isCertain(double left, double less) const {
  return weight_ * (left - less) >= kCertain * kRowsPerIndependent * less;
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

// b1 and b0 of all struts, then two for every bar.
CouplingEstimator::OwnUnknowns CouplingEstimator::ownUnknowns() const {
  const int n = num_struts_;
  OwnUnknowns unknowns;
  unknowns.columns = Eigen::MatrixXd::Zero(static_cast<int>(2 * static_cast<std::size_t>(n) + 2 * bars_.size()), 2 * n);
  for (int a = 0; a < 2 * n; ++a) {
    unknowns.columns(a, a) = 1.0;
    unknowns.place.push_back(a % n);
  }
  for (const auto& [i, j] : bars_)
    for (const auto& [at, other] : {std::pair(i, j), std::pair(j, i)}) {
      const auto row = static_cast<Eigen::Index>(unknowns.place.size());
      unknowns.columns(row, n + at) = 1.0;
      unknowns.columns(row, n + other) = -1.0;
      unknowns.place.push_back(at);
    }
  return unknowns;
}

void CouplingEstimator::solveStruts(const Moments& moments) {
  Coupling& coupling = estimate_.coupling;
  const int n = num_struts_;
  const auto [columns, place] = ownUnknowns();
  const Eigen::Index unknowns = columns.rows();
  const StrutMatrix products = coupling.ratios.transpose() * coupling.ratios;
  const Eigen::MatrixXd inputs = columns * moments.topLeftCorner(2 * n, 2 * n) * columns.transpose();
  const Eigen::MatrixXd outputs = columns * (moments.block(0, 2 * n + num_forces_, 2 * n, n) -
                                             moments.block(0, 2 * n, 2 * n, num_forces_) * coupling.forces.transpose());
  Eigen::MatrixXd normal(unknowns, unknowns);
  Eigen::VectorXd right(unknowns);
  for (Eigen::Index a = 0; a < unknowns; ++a) {
    const int at = place[static_cast<std::size_t>(a)];
    for (Eigen::Index b = 0; b < unknowns; ++b)
      normal(a, b) = products(at, place[static_cast<std::size_t>(b)]) * inputs(a, b);
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

// What the sensors' noise would have to be to leave the least of the rests.
double CouplingEstimator::sensorVariance(const Moments& moments) const {
  const StrutVector rest = restOf(moments);
  double least = HUGE_VAL;
  const StrutVector gain = restOf(noise_);
  for (int i = 0; i < num_struts_; ++i) least = std::min(least, std::max(0.0, rest[i]) / gain[i]);
  return least;
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
  estimate_.doubt = share + kNoiseKnown / estimate_.told_apart + valley_doubt_;
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
  const Moments noise = sensor_variance * noise_;
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

// Standard deviations of ratios, of forces' coefficients and of the struts' own parameters, from the information that
// the rows have of all of them together: of z_i'' by rho_ij, j != i, kappa_ik and by what every strut does of its own.
// One by one they would seem to be known far better where tracks are alike.
// @param of_struts  moments of p_j and x_k.  @param rest  of each output.
// @return the largest rms that the errors of the first two give a strut's own acceleration, as a share of it.
double CouplingEstimator::describeErrors(const Moments& moments, const Moments& of_struts, const StrutVector& rest) {
  const int n = num_struts_;
  const StrutMatrix& ratios = estimate_.coupling.ratios;
  const auto [columns, place] = ownUnknowns();
  const int num_others = n - 1 + num_forces_;  // of a strut: other struts, then forces
  const auto coefficient = [&](int i, int j) { return i * num_others + (j < i ? j : j - 1); };
  const Eigen::Index num_coefficients = n * num_others, num_own = columns.rows();
  const Eigen::MatrixXd with_own = columns * moments.topLeftCorner(2 * n, 2 * n);
  const Eigen::MatrixXd among_own = with_own * columns.transpose();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(num_coefficients + num_own, num_coefficients + num_own);
  for (int i = 0; i < n; ++i) {
    const double rows = weight_ / (kRowsPerIndependent * rest[i]);
    Eigen::VectorXd own_ratios(num_own);
    for (Eigen::Index a = 0; a < num_own; ++a) own_ratios[a] = ratios(i, place[static_cast<std::size_t>(a)]);
    for (int j = 0; j < n + num_forces_; ++j) {
      if (j == i) continue;
      for (int l = 0; l < n + num_forces_; ++l)
        if (l != i) information(coefficient(i, j), coefficient(i, l)) = rows * of_struts(j, l);
      const Eigen::VectorXd with_other =
          j < n ? Eigen::VectorXd(with_own * ownColumns(j)) : columns * moments.col(n + j).head(2 * n);
      information.row(coefficient(i, j)).tail(num_own) = rows * own_ratios.cwiseProduct(with_other).transpose();
    }
    information.bottomRightCorner(num_own, num_own) +=
        rows * own_ratios.asDiagonal() * among_own * own_ratios.asDiagonal();
  }
  information.bottomLeftCorner(num_own, num_coefficients) =
      information.topRightCorner(num_coefficients, num_own).transpose();
  const Eigen::MatrixXd covariance =
      information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  const auto deviation = [&](Eigen::Index unknown) { return std::sqrt(covariance(unknown, unknown)); };
  double most = 0.0;
  for (int i = 0; i < n; ++i) {
    double error = 0.0;
    for (int j = 0; j < n + num_forces_; ++j) {
      if (j == i) continue;
      if (j < n)
        estimate_.stddevs(i, j) = deviation(coefficient(i, j));
      else
        estimate_.force_stddevs(i, j - n) = of_struts(j, j) > 0.0 ? deviation(coefficient(i, j)) : HUGE_VAL;
      for (int l = 0; l < n + num_forces_; ++l)
        if (l != i) error += covariance(coefficient(i, j), coefficient(i, l)) * of_struts(j, l);
    }
    most = std::max(most, error / of_struts(i, i));
    const double of_noise = kNoiseKnown / estimate_.told_apart;
    estimate_.own_stddevs(i, 0) = std::hypot(deviation(num_coefficients + i), of_noise * estimate_.damping_to_mass[i]);
    estimate_.own_stddevs(i, 1) =
        std::hypot(deviation(num_coefficients + n + i), of_noise * estimate_.stiffness_to_mass[i]);
  }
  return std::sqrt(most);
}

}  // namespace suspension_health_monitor
