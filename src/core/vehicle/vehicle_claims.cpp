#include "suspension_health_monitor/internal/vehicle/vehicle_claims.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"

namespace suspension_health_monitor {
namespace {

using Kind = VehicleMistake::Kind;

double notShared(const Eigen::MatrixXd& products, Eigen::Index i, Eigen::Index j) {
  const double own = products(i, i) * products(j, j);
  return own > 0.0 ? 1.0 - products(i, j) * products(i, j) / own : 1.0;
}

}  // namespace

VehicleClaims::VehicleClaims(const VehicleChannels& vehicle, const Eigen::ArrayXcd& s, int most_blocks, bool gyro_died)
    : n_(vehicle.struts.size()),
      forces_(vehicle.known_forces.size()),
      s_(s),
      columns_(s.size(), Eigen::MatrixXcd(6 * n_ + forces_, most_blocks)),
      products_(columns_.size()),
      gyro_died_(gyro_died) {
  whole_.setZero(2 * n_, 2 * n_);
  measured_.setZero(6 * n_ + forces_, 6 * n_ + forces_);
  model_errors_.setZero(n_, 2);
  for (Eigen::Index i = 0; i < n_; ++i) {
    const VehicleChannels::Strut& strut = vehicle.struts[i];
    if (strut.sprung) continue;
    of_body_.push_back(i);
    places_.push_back({strut.position->x(), strut.position->y()});
  }
  in_step_ = measured_;
}

void VehicleClaims::add(const Eigen::ArrayXXcd& spectra) {
  Eigen::MatrixXcd columns = spectra.matrix().transpose();
  whole_ += (columns.topRows(2 * n_) * columns.topRows(2 * n_).adjoint()).real();
  columns.array().rowwise() /= (s_ * s_).transpose();  // displacements, which a bounce has most of
  for (Eigen::Index k = 0; k < s_.size(); ++k) columns_[k].col(blocks_) = columns.col(k);
  ++blocks_;
}

VehicleClaims::Mapping VehicleClaims::asFiled() const {
  Mapping mapping{Eigen::MatrixXd::Identity(2 * n_, 2 * n_), Eigen::VectorXd::Zero(2 * n_)};
  mapping.delays.tail(n_).fill(late_tops_);
  return mapping;
}

// A stream that is late by tau has exp(-s tau) of what happened.
Eigen::MatrixXd VehicleClaims::moments(const Eigen::VectorXd& delays) const {
  const Eigen::Index size = 6 * n_ + forces_;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXcd all = Eigen::VectorXcd::Ones(size);
  for (std::size_t k = 0; k < products_.size(); ++k) {
    const Eigen::ArrayXcd turn = (s_[k] * delays.array()).exp();
    all.head(6 * n_) = turn.matrix().replicate(3, 1);
    sum += (all.asDiagonal() * products_[k] * all.conjugate().asDiagonal()).real();
  }
  return sum;
}

VehicleClaims::Rows VehicleClaims::fit(const Mapping& mapping, const Eigen::MatrixXd& moments) const {
  const auto tops = mapping.streams.bottomRows(n_);
  const Eigen::MatrixXd travel = mapping.streams.topRows(n_) - tops;
  const Eigen::Index regressors = 2 * n_ + forces_;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(regressors + n_, moments.rows());
  columns.block(0, 2 * n_, n_, 2 * n_) = travel;  // rates: p = 1
  columns.block(n_, 0, n_, 2 * n_) = travel;      // travels: p = 0
  columns.block(2 * n_, 6 * n_, forces_, forces_).setIdentity();
  columns.block(regressors, 4 * n_, n_, 2 * n_) = tops;  // z'': p = 2
  const Eigen::MatrixXd products = columns * moments * columns.transpose();
  const Eigen::MatrixXd scores = products.topRightCorner(regressors, n_);
  const Eigen::MatrixXd rows = pseudoInverse(Eigen::MatrixXd(products.topLeftCorner(regressors, regressors))) * scores;
  const Eigen::ArrayXd total = products.diagonal().tail(n_).array();
  const Eigen::ArrayXd explained = (scores.array() * rows.array()).colwise().sum().transpose();
  Rows result{(total > 0.0).select(1.0 - explained / total, 1.0).mean(), Eigen::ArrayXXd(n_, 2), {}};
  result.own.col(0) = rows.topRows(n_).diagonal();
  result.own.col(1) = rows.middleRows(n_, n_).diagonal();
  const Eigen::ArrayXd powers = products.diagonal().head(2 * n_).array();
  result.moved = result.own.square() * Eigen::Map<const Eigen::ArrayXXd>(powers.data(), n_, 2);
  result.moved.colwise() /= (total > 0.0).select(total, 1.0);
  return result;
}

VehicleClaims::Rows VehicleClaims::fit(const Hypothesis& hypothesis, double size) const {
  Mapping mapping = asFiled();
  hypothesis.apply(size, mapping);
  return fit(mapping, mapping.delays == asFiled().delays ? in_step_ : moments(mapping.delays));
}

// The best size by a parabola through the best of those to begin with and its neighbours, then closer and closer.
VehicleMistake VehicleClaims::attempt(const Hypothesis& hypothesis) const {
  VehicleMistake found{hypothesis.kind, hypothesis.struts};
  const std::vector<double>& sizes = hypothesis.sizes;
  const auto unexplained = mapped(sizes, [&](double size) { return fit(hypothesis, size).unexplained; });
  const auto best = std::min_element(unexplained.begin(), unexplained.end()) - unexplained.begin();
  found.size = sizes[best];
  found.unexplained = unexplained[best];
  if (sizes.size() == 1) return found;
  double step = sizes[1] - sizes[0], curvature = 0.0;
  for (int i = 0; i < kVehicleTuning.refinements; ++i, step *= 0.5) {
    const double below = fit(hypothesis, found.size - step).unexplained,
                 above = fit(hypothesis, found.size + step).unexplained;
    curvature = (below + above - 2.0 * found.unexplained) / (step * step);
    if (!(curvature > 0.0)) break;
    found.size = std::clamp(found.size + (below - above) / (2.0 * curvature * step), sizes.front(), sizes.back());
    found.unexplained = fit(hypothesis, found.size).unexplained;
  }
  // Without a minimum inside the range this is not the mistake.
  if (!(curvature > 0.0) || found.size <= sizes.front() || found.size >= sizes.back()) {
    found.unexplained = 1.0;
    return found;
  }
  // How well the minimum of a sum of squares is known by its curvature. Neighbouring bins of a Hann window share half
  // of what they tell, so that half of the equations count.
  const double equations = 0.5 * blocks_ * 2.0 * static_cast<double>(s_.size() * n_);
  found.stddev = std::sqrt(2.0 * (noise_ + std::max(0.0, found.unexplained)) / (curvature * equations));
  return found;
}

VehicleMistake VehicleClaims::sameOrAlike() const {
  for (Eigen::Index i = 0; i < n_; ++i)
    for (Eigen::Index j = i + 1; j < n_; ++j) {
      if (notShared(whole_, i, j) < kRounding) return {Kind::kSameWheels, StrutPair(i, j)};
      if (!isByBody() && notShared(whole_, n_ + i, n_ + j) < kRounding) return {Kind::kSameTops, StrutPair(i, j)};
    }
  const Eigen::MatrixXd wheels = whole_.topLeftCorner(n_, n_), inverse = wheels.inverse();
  VehicleMistake found;
  double least = square(kSmall);  // of its power: a tenth of its motion
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double own = 1.0 / (wheels(i, i) * inverse(i, i));
    if (!(own < least)) continue;
    least = own;
    Eigen::Index partner = i == 0 ? 1 : 0;
    for (Eigen::Index j = 0; j < n_; ++j)
      if (j != i && notShared(wheels, i, j) < notShared(wheels, i, partner)) partner = j;
    found = {Kind::kAlike, StrutPair(i, partner)};
  }
  return found;
}

bool VehicleClaims::work() {
  if (next_ == 0 && !begins()) return true;
  const std::size_t bins = columns_.size();
  if (next_ < bins)
    takeBin(next_);
  else if (next_ == bins)
    judgeAsFiled();
  else
    judge(hypotheses_[next_ - bins - 1]);
  if (++next_ <= bins + hypotheses_.size()) return false;
  // The motion that goes with the wheels, but that no row explains, may lie along any of the 2 n columns: each of them
  // has its share. Struts on links leave 0.1 % of the motion unexplained.
  const double each = filed_.unexplained / (2.0 * static_cast<double>(n_));
  if (found_.kind != Kind::kNone || each < square(kWorthHaving) || filed_.unexplained < noiseShare() * noise_)
    return true;
  found_.kind = Kind::kOthers;
  model_errors_ = (model_errors_.square() + each / filed_.moved.max(kRounding)).sqrt();
  return true;
}

bool VehicleClaims::begins() {
  if (gyro_died_ || hasDeadGyro())
    found_.kind = Kind::kDeadGyro;
  else if (blocks_ < int{kFewestForScatter} || n_ < 2)
    found_.kind = Kind::kTooLittle;
  else
    found_ = sameOrAlike();
  return found_.kind == Kind::kNone;
}

// Takes of all streams the part that goes with the wheels and the known forces. Noise of other sensors does not go with
// them, but for the share that chance explains.
void VehicleClaims::takeBin(std::size_t bin) {
  const auto columns = columns_[bin].leftCols(blocks_);
  const Eigen::MatrixXcd all = columns * columns.adjoint();
  Eigen::MatrixXcd causes = Eigen::MatrixXcd::Zero(6 * n_ + forces_, n_ + forces_);
  causes.block(2 * n_, 0, n_, n_).setIdentity();  // p = 1
  causes.bottomRightCorner(forces_, forces_).setIdentity();
  const Eigen::MatrixXcd with_causes = all * causes;
  const Eigen::MatrixXcd with_them =
      with_causes * pseudoInverse(Eigen::MatrixXcd(causes.adjoint() * with_causes)) * with_causes.adjoint();
  products_[bin] = (with_them - noiseShare() * all) / (1.0 - noiseShare());
  measured_ += all.real();
  in_step_ += products_[bin].real();
}

void VehicleClaims::judgeAsFiled() {
  const Mapping filed = asFiled();
  found_.unexplained = fit(filed, measured_).unexplained;
  filed_ = fit(filed, in_step_);
  noise_ = std::max(0.0, found_.unexplained - filed_.unexplained);
  least_ = kVehicleTuning.fits;
  hypotheses_ = hypotheses();
}

void VehicleClaims::judge(const Hypothesis& hypothesis) {
  VehicleMistake other = attempt(hypothesis);
  const double slack = kVehicleTuning.noise_known_to * noiseShare() * noise_, unexplained = other.unexplained;
  const bool is_by_links = other.isDelay() && std::abs(other.size) < kBlockTuning.least_delay;
  if (unexplained < least_ && unexplained + slack < kMajority * (filed_.unexplained + slack)) {
    const Eigen::ArrayXXd change = (fit(hypothesis, other.size).own / filed_.own - 1.0).abs();
    if (is_by_links) {
      model_errors_ = model_errors_.max(change);
    } else if (change.maxCoeff() > kLeastDifference) {
      least_ = unexplained;
      other.unexplained = found_.unexplained;
      found_ = other;
    }
  }
  // A delay of all tops that links make would hide other mistakes: they are looked for in what it leaves.
  if (hypothesis.kind != allTops() || !is_by_links || found_.kind != Kind::kNone || unexplained > filed_.unexplained)
    return;
  late_tops_ = other.size;
  in_step_ = moments(asFiled().delays);
  filed_ = fit(asFiled(), in_step_);
}

}  // namespace suspension_health_monitor
