// The mistakes that VehicleClaims looks for.
#include <algorithm>
#include <functional>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_claims.h"

namespace suspension_health_monitor {
namespace {

using Kind = VehicleMistake::Kind;

// Sizes to begin with. A clock that is off by more has another time altogether.
const std::vector<double> kFactors{0.6, 0.8, 1.0, 1.2, 1.4, 1.6}, kOtherSign{-1.0};
const std::vector<double> kDelays{-0.05, -0.04, -0.03, -0.02, -0.01, 0.0, 0.01, 0.02, 0.03, 0.04, 0.05};
const std::vector<double> kShifts{-0.4, -0.2, 0.0, 0.2, 0.4};  // of the wheelbase, or of the track

double spreadOf(const StrutPlaces& places, std::size_t axis) {
  const auto [least, most] = std::minmax_element(places.begin(), places.end(),
                                                 [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; });
  return (*most)[axis] - (*least)[axis];
}

/// @return true if struts stand so far from one another along it that they see the body turn.
bool isSpread(const StrutPlaces& places, std::size_t axis) {
  return spreadOf(places, axis) > kSmall * std::max(spreadOf(places, 0), spreadOf(places, 1));
}

/// @return what heave, pitch and roll do to the tops; 0 about an axis on which all stand.
Eigen::MatrixXd motionsOf(const StrutPlaces& places) {
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(places.size(), 3);
  motions.col(0).setOnes();
  for (const std::size_t axis : {0u, 1u})
    for (std::size_t i = 0; i < places.size() && isSpread(places, axis); ++i) motions(i, 1 + axis) = places[i][axis];
  return motions;
}

}  // namespace

// At the bounce and below a body follows its wheels, in pitch and roll as in heave.
bool VehicleClaims::hasDeadGyro() const {
  if (places_.empty() || blocks_ < int{kFewestForScatter}) return false;
  Eigen::MatrixXd wheels = Eigen::MatrixXd::Zero(n_, n_), tops = wheels;
  for (const Eigen::MatrixXcd& columns : columns_) {
    const auto wheel = columns.topLeftCorner(n_, blocks_), top = columns.block(n_, 0, n_, blocks_);
    const Eigen::MatrixXcd of_wheels = wheel * wheel.adjoint(), both = top * wheel.adjoint();
    wheels += of_wheels.real();
    tops += (both * pseudoInverse(of_wheels) * both.adjoint()).real();  // that goes with them
  }
  const Eigen::MatrixXd of_tops = pseudoInverse(motionsOf(places_));
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3, n_);
  for (std::size_t i = 0; i < of_body_.size(); ++i) motions.col(of_body_[i]) = of_tops.col(i);
  const Eigen::ArrayXd passed = (motions * tops * motions.transpose()).diagonal().array() /
                                (motions * wheels * motions.transpose()).diagonal().array();
  for (const std::size_t axis : {0u, 1u})
    if (isSpread(places_, axis) && passed[1 + axis] < square(kSmall) * passed[0]) return true;
  return false;
}

std::vector<VehicleClaims::Hypothesis> VehicleClaims::hypotheses() const {
  std::vector<Hypothesis> all;
  const auto struts = static_cast<std::size_t>(n_);
  for (std::size_t i = 0; i < struts; ++i) {
    all.push_back({Kind::kWheelDelay, {i, i}, kDelays, [i](double size, Mapping& m) { m.delays[i] = size; }});
    if (!isByBody())
      all.push_back(
          {Kind::kTopDelay, {i, i}, kDelays, [i, n = n_](double size, Mapping& m) { m.delays[n + i] = size; }});
  }
  all.push_back({allTops(), {}, kDelays, [n = n_](double size, Mapping& m) { m.delays.tail(n).fill(size); }});
  for (std::size_t i = 0; i < struts; ++i) {
    all.push_back({Kind::kUpsideDown, {i, i}, {1.0}, [i](double, Mapping& m) { m.streams.row(i) *= -1.0; }});
    for (std::size_t j = i + 1; j < struts; ++j)
      all.push_back(
          {Kind::kSwapped, {i, j}, {1.0}, [i, j](double, Mapping& m) { m.streams.row(i).swap(m.streams.row(j)); }});
  }
  if (isByBody()) addPositions(all);
  return all;
}

// Tops that the body's IMU tells of move with its heave, pitch and roll.
void VehicleClaims::addPositions(std::vector<Hypothesis>& all) const {
  const Eigen::MatrixXd inverse = pseudoInverse(motionsOf(places_));
  for (const std::size_t axis : {0u, 1u}) {
    if (!isSpread(places_, axis)) continue;
    using Change = std::function<double(double coordinate, double size)>;
    // Changes where the struts `from` to `to` - 1 stand along the axis.
    const auto add = [&](Kind kind, std::size_t from, std::size_t to, const std::vector<double>& sizes,
                         const Change& change) {
      all.push_back({kind,
                     {from, from},
                     sizes,
                     [from, to, axis, change, inverse, places = places_, n = n_](double size, Mapping& m) {
                       StrutPlaces other = places;
                       for (std::size_t i = from; i < to; ++i) other[i][axis] = change(other[i][axis], size);
                       m.streams.bottomRightCorner(n, n) = motionsOf(other) * inverse;
                     }});
    };
    const bool is_ahead = axis == 0;
    const auto shifts = mapped(kShifts, [&](double share) { return share * spreadOf(places_, axis); });
    add(is_ahead ? Kind::kShiftAhead : Kind::kShiftSide, 0, places_.size(), shifts, std::plus<>());
    for (const std::vector<double>* sizes : {&kOtherSign, &kFactors}) {
      add(is_ahead ? Kind::kAhead : Kind::kSide, 0, places_.size(), *sizes, std::multiplies<>());
      for (std::size_t i = 0; i < places_.size(); ++i)
        add(is_ahead ? Kind::kAheadOfOne : Kind::kSideOfOne, i, i + 1, *sizes, std::multiplies<>());
    }
  }
}

}  // namespace suspension_health_monitor
