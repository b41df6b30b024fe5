#include "suspension_health_monitor/internal/vehicle/body_inertia.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kCertain = 3.0;  // standard deviations: by chance once in a thousand
constexpr int kMostSteps = 50;
constexpr double kConverged = 1e-6;  // of a standard deviation
constexpr double kFlat = 1e-9;       // of the largest column: places are no more exact than their numbers

using Spread = Eigen::Vector4d;  // A1 to A4

/// a_ij = 1 + column(i, j)' A.
class Struts {
 public:
  explicit Struts(const StrutPlaces& places) : places_(places) {
    for (const auto& [x, y] : places) {
      middle_[0] += x / static_cast<double>(places.size());
      middle_[1] += y / static_cast<double>(places.size());
    }
    for (auto& [x, y] : places_) {
      x -= middle_[0];
      y -= middle_[1];
    }
  }

  std::size_t size() const { return places_.size(); }
  const std::array<double, 2>& middle() const { return middle_; }

  Spread column(std::size_t i, std::size_t j) const {
    const auto& [xi, yi] = places_[i];
    const auto& [xj, yj] = places_[j];
    return {xi + xj, yi + yj, xi * xj, yi * yj};
  }
  double mobility(std::size_t i, std::size_t j, const Spread& spread) const { return 1.0 + column(i, j).dot(spread); }

 private:
  StrutPlaces places_;
  std::array<double, 2> middle_{};
};

/// Rows whose squares are to be least, each over its standard deviation.
struct Equations {
  Eigen::MatrixXd slopes;  // of what the model says, by A
  Eigen::VectorXd rest;    // what it lacks

  bool isFullRank() const {
    const Eigen::VectorXd sizes = slopes.colwise().norm();
    if (!(sizes.minCoeff() > 0.0)) return false;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> scaled(slopes * sizes.cwiseInverse().asDiagonal());
    scaled.setThreshold(kFlat);
    return scaled.rank() == slopes.cols();
  }
  Spread solve() const { return slopes.colPivHouseholderQr().solve(rest); }
};

/// Calls each(row, i, j) for every pair of two struts.
template <class Each>
void forPairs(std::size_t struts, const Each& each) {
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < struts; ++i)
    for (std::size_t j = 0; j < struts; ++j)
      if (i != j) each(row++, i, j);
}

class Fit {
 public:
  Fit(const Eigen::MatrixXd& ratios, const Eigen::MatrixXd& stddevs, const StrutPlaces& places)
      : ratios_(ratios), stddevs_(stddevs), struts_(places) {}

  /// Whether every ratio has an error.
  bool isKnown() const {
    bool is_known = ratios_.allFinite();
    forPairs(struts_.size(), [&](Eigen::Index, std::size_t i, std::size_t j) {
      is_known = is_known && of(stddevs_, i, j) > 0.0 && std::isfinite(of(stddevs_, i, j));
    });
    return is_known;
  }

  /// (rho_ij a_jj - a_ij) / stddev_ij = 0, linear in A.
  Equations linear() const {
    Equations equations = empty();
    forPairs(struts_.size(), [&](Eigen::Index row, std::size_t i, std::size_t j) {
      const double ratio = of(ratios_, i, j), stddev = of(stddevs_, i, j);
      equations.slopes.row(row) = (struts_.column(i, j) - ratio * struts_.column(j, j)).transpose() / stddev;
      equations.rest[row] = (ratio - 1.0) / stddev;
    });
    return equations;
  }

  /// (rho_ij - a_ij / a_jj) / stddev_ij, at A.
  Equations at(const Spread& spread) const {
    Equations equations = empty();
    forPairs(struts_.size(), [&](Eigen::Index row, std::size_t i, std::size_t j) {
      const double own = struts_.mobility(j, j, spread), share = struts_.mobility(i, j, spread) / own;
      const double stddev = of(stddevs_, i, j);
      equations.slopes.row(row) = (struts_.column(i, j) - share * struts_.column(j, j)).transpose() / (own * stddev);
      equations.rest[row] = (of(ratios_, i, j) - share) / stddev;
    });
    return equations;
  }

  const Struts& struts() const { return struts_; }

 private:
  static double of(const Eigen::MatrixXd& matrix, std::size_t i, std::size_t j) {
    return matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  Equations empty() const {
    const auto n = static_cast<Eigen::Index>(struts_.size());
    return {Eigen::MatrixXd(n * (n - 1), 4), Eigen::VectorXd(n * (n - 1))};
  }

  const Eigen::MatrixXd &ratios_, &stddevs_;
  Struts struts_;
};

/// From A and its covariance to what has a name.
BodyInertia named(const Spread& spread, const Eigen::Matrix4d& covariance, const std::array<double, 2>& middle) {
  const double x = -spread[0] / spread[2], y = -spread[1] / spread[3];  // where a(r, r) is least
  const double at_centre = 1.0 - square(spread[0]) / spread[2] - square(spread[1]) / spread[3];
  const double pitch = spread[2] / at_centre, roll = spread[3] / at_centre;
  const Spread centre_slope{2.0 * x, 2.0 * y, square(x), square(y)};  // of at_centre
  const auto measured = [&](double value, const Spread& slope) {
    return Measured{value, std::sqrt(slope.dot(covariance * slope))};
  };
  return {measured(pitch, (Spread::Unit(2) - pitch * centre_slope) / at_centre),
          measured(roll, (Spread::Unit(3) - roll * centre_slope) / at_centre),
          measured(middle[0] + x, -(Spread::Unit(0) + x * Spread::Unit(2)) / spread[2]),
          measured(middle[1] + y, -(Spread::Unit(1) + y * Spread::Unit(3)) / spread[3])};
}

bool isCertain(const Measured& number) { return number.value > kCertain * number.stddev; }

}  // namespace

StrutPlaces placesOf(const VehicleLayout& layout) {
  StrutPlaces places;
  for (const VehicleLayout::Strut& strut : layout.struts) {
    if (!strut.position) return {};
    places.push_back({(*strut.position)[0], (*strut.position)[1]});
  }
  return places;
}

BodyInertiaResult bodyInertia(const Eigen::MatrixXd& ratios, const Eigen::MatrixXd& stddevs,
                              const StrutPlaces& places) {
  if (places.size() != static_cast<std::size_t>(ratios.rows())) return {{}, InertiaDoubt::kNoPositions};
  if (places.size() < 3) return {{}, InertiaDoubt::kOnOneLine};
  const Fit fit(ratios, stddevs, places);
  if (!fit.isKnown()) return {{}, InertiaDoubt::kUncertain};
  const Equations begin = fit.linear();
  if (!begin.isFullRank()) return {{}, InertiaDoubt::kOnOneLine};
  Spread spread = begin.solve();
  Equations equations = fit.at(spread);
  bool converged = false;
  for (int step = 0; step < kMostSteps && !converged; ++step) {
    if (!equations.slopes.allFinite() || !equations.isFullRank()) return {{}, InertiaDoubt::kUncertain};
    const Spread change = equations.solve();
    converged = (equations.slopes * change).norm() < kConverged;
    spread += change;
    equations = fit.at(spread);
  }
  if (!converged) return {{}, InertiaDoubt::kUncertain};
  const double freedom = static_cast<double>(equations.rest.size() - spread.size());
  const double misfit = std::max(1.0, equations.rest.squaredNorm() / freedom);
  const Eigen::Matrix4d information = equations.slopes.transpose() * equations.slopes;
  const BodyInertia body = named(spread, misfit * information.inverse(), fit.struts().middle());
  if (!isCertain(body.mass_to_pitch_inertia) || !isCertain(body.mass_to_roll_inertia))
    return {{}, InertiaDoubt::kUncertain};
  return {body, InertiaDoubt::kNone};
}

}  // namespace suspension_health_monitor
