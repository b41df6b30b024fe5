#include "suspension_health_monitor/internal/vehicle/vehicle_claims.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <functional>
#include <vector>

namespace suspension_health_monitor {
namespace {

using Kind = VehicleMistake::Kind;

constexpr int kFewestBlocks = 8;
constexpr double kSame = 1e-9;   // 1 - r^2 of two streams of one sensor, by rounding; noise of two makes 1e-5
constexpr double kAlike = 0.01;  // of a wheel's power is all that the other wheels do not have: a tenth of its motion
constexpr double kBetter = 0.5;  // of what the file leaves
constexpr double kFits = 0.2;    // of the tops' motion, that a file which is right leaves at most
constexpr std::size_t kMotions = 3;  // of a body that struts see
constexpr double kMuch = 0.25;       // that is left where something else moves the body

// Complex columns as real ones of twice the length.
Eigen::MatrixXd asReal(const Eigen::ArrayXXcd& columns) {
  Eigen::MatrixXd result(2 * columns.rows(), columns.cols());
  result << columns.real().matrix(), columns.imag().matrix();
  return result;
}

double notShared(const Eigen::MatrixXd& products, Eigen::Index i, Eigen::Index j) {
  const double own = products(i, i) * products(j, j);
  return own > 0.0 ? 1.0 - products(i, j) * products(i, j) / own : 1.0;
}

}  // namespace

VehicleClaims::VehicleClaims(std::size_t struts) : n_(static_cast<Eigen::Index>(struts)) {
  moments_.setZero(6 * n_, 6 * n_);
  whole_.setZero(2 * n_, 2 * n_);
}

void VehicleClaims::add(const Spectra& wheels, const Spectra& tops, const Eigen::ArrayXcd& s) {
  Eigen::ArrayXXcd columns(s.size(), 6 * n_);
  for (std::size_t p = 0; p < 3; ++p)
    columns.middleCols(static_cast<Eigen::Index>(p) * 2 * n_, 2 * n_) << wheels[p], tops[p];
  const Eigen::MatrixXd plain = asReal(columns.leftCols(2 * n_));
  whole_ += plain.transpose() * plain;
  columns.colwise() /= s * s;  // displacements, which a bounce has most of
  const Eigen::MatrixXd rows = asReal(columns);
  moments_ += rows.transpose() * rows;
  ++blocks_;
}

VehicleClaims::Mapping VehicleClaims::asFiled() const {
  Mapping mapping{Eigen::MatrixXd::Zero(n_, 2 * n_), Eigen::MatrixXd::Zero(n_, 2 * n_)};
  mapping.wheels.leftCols(n_).setIdentity();
  mapping.tops.rightCols(n_).setIdentity();
  return mapping;
}

double VehicleClaims::unexplained(const Mapping& mapping) const {
  const Eigen::MatrixXd travel = mapping.wheels - mapping.tops;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < n_; ++i) {
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(2 * n_ + 1, 6 * n_);
    columns.topRows(n_).middleCols(2 * n_, 2 * n_) = travel;          // rates: p = 1
    columns.middleRows(n_, n_).leftCols(2 * n_) = travel;             // travels: p = 0
    columns.bottomRows<1>().rightCols(2 * n_) = mapping.tops.row(i);  // z'': p = 2
    const Eigen::MatrixXd products = columns * moments_ * columns.transpose();
    const Eigen::VectorXd score = products.topRightCorner(2 * n_, 1);
    const double total = products(2 * n_, 2 * n_);
    const double explained =
        score.dot(products.topLeftCorner(2 * n_, 2 * n_).completeOrthogonalDecomposition().solve(score));
    sum += total > 0.0 ? 1.0 - explained / total : 1.0;
  }
  return sum / static_cast<double>(n_);
}

VehicleMistake VehicleClaims::sameOrAlike(bool has_own_tops) const {
  const auto pairOf = [](Eigen::Index i, Eigen::Index j) {
    return StrutPair(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  };
  for (Eigen::Index i = 0; i < n_; ++i)
    for (Eigen::Index j = i + 1; j < n_; ++j) {
      if (notShared(whole_, i, j) < kSame) return {Kind::kSameWheels, pairOf(i, j)};
      if (has_own_tops && notShared(whole_, n_ + i, n_ + j) < kSame) return {Kind::kSameTops, pairOf(i, j)};
    }
  const Eigen::MatrixXd wheels = whole_.topLeftCorner(n_, n_), inverse = wheels.inverse();
  VehicleMistake found;
  double least = kAlike;
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double own = 1.0 / (wheels(i, i) * inverse(i, i));
    if (!(own < least)) continue;
    least = own;
    Eigen::Index partner = i == 0 ? 1 : 0;
    for (Eigen::Index j = 0; j < n_; ++j)
      if (j != i && notShared(wheels, i, j) < notShared(wheels, i, partner)) partner = j;
    found = {Kind::kAlike, pairOf(i, partner)};
  }
  return found;
}

VehicleMistake VehicleClaims::find(const StrutPlaces& places) const {
  if (blocks_ < kFewestBlocks || n_ < 2) return {Kind::kTooLittle, {}};
  VehicleMistake found = sameOrAlike(places.empty());
  const Mapping filed = asFiled();
  found.unexplained = unexplained(filed);
  if (found.kind != Kind::kNone) return found;

  double least = std::min(kBetter * found.unexplained, kFits);
  const auto attempt = [&](Kind kind, std::size_t i, std::size_t j, const Mapping& mapping) {
    const double left = unexplained(mapping);
    if (!(left < least)) return;
    least = left;
    found.kind = kind;
    found.struts = {i, j};
  };
  for (Eigen::Index i = 0; i < n_; ++i) {
    Mapping turned = filed;
    turned.wheels.row(i) *= -1.0;
    attempt(Kind::kUpsideDown, static_cast<std::size_t>(i), static_cast<std::size_t>(i), turned);
    for (Eigen::Index j = i + 1; j < n_; ++j) {
      Mapping swapped = filed;
      swapped.wheels.row(i).swap(swapped.wheels.row(j));
      attempt(Kind::kSwapped, static_cast<std::size_t>(i), static_cast<std::size_t>(j), swapped);
    }
  }
  const auto motions = [&](const StrutPlaces& at) {
    Eigen::MatrixXd q = Eigen::MatrixXd::Ones(n_, 3);
    for (Eigen::Index i = 0; i < n_; ++i)
      q.row(i).tail<2>() << at[static_cast<std::size_t>(i)][0], at[static_cast<std::size_t>(i)][1];
    return q;
  };
  const auto moved = [&](Kind kind, std::size_t strut, const std::function<void(StrutPlaces&)>& change) {
    StrutPlaces other = places;
    change(other);
    Mapping mapping = filed;
    const Eigen::MatrixXd inverse = motions(places).completeOrthogonalDecomposition().pseudoInverse();
    mapping.tops.rightCols(n_) = motions(other) * inverse;
    attempt(kind, strut, strut, mapping);
  };
  for (const std::size_t axis : {0u, 1u}) {
    if (places.size() <= kMotions) break;  // any body would do
    moved(axis == 0 ? Kind::kMirroredAhead : Kind::kMirroredSides, 0, [&](StrutPlaces& other) {
      for (auto& place : other) place[axis] *= -1.0;
    });
    for (std::size_t i = 0; i < places.size(); ++i)
      moved(axis == 0 ? Kind::kSignAhead : Kind::kSignSide, i, [&](StrutPlaces& other) { other[i][axis] *= -1.0; });
  }
  if (found.kind == Kind::kNone && found.unexplained > kMuch) found.kind = Kind::kOthers;
  return found;
}

}  // namespace suspension_health_monitor
