#include "suspension_health_monitor/internal/search/screening.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/fit/free_form.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kIndependent = 1e-6;  // share of a column that the model's own columns must leave

constexpr double kRatio = 1.45;  // between neighbours
constexpr double kMostCombinations = 36.0;
constexpr Eigen::Index kSurfaceRows = 20000;

Residuals split(const Eigen::VectorXd& all, const std::vector<std::size_t>& begins) {
  Residuals segments;
  for (std::size_t s = 0; s + 1 < begins.size(); ++s)
    segments.emplace_back(all.data() + begins[s], all.data() + begins[s + 1]);
  return segments;
}

// Weights of the smooth Huber loss, 0 where a sample is held out.
Eigen::VectorXd trainingWeights(const HoldOut& held_out, const Eigen::VectorXd& residual) {
  const double limit = kOutlierScale * robustDeviation({residual.data(), residual.data() + residual.size()});
  const Eigen::VectorXd trained = joined(held_out.training);
  if (!(limit > 0.0)) return trained;
  return trained.array() / (1.0 + (residual.array() / limit).square()).sqrt();
}

}  // namespace

WeightedProjection::WeightedProjection(Eigen::MatrixXd common, Eigen::VectorXd weight, Eigen::VectorXd target)
    : common_(std::move(common)), weight_(std::move(weight)), target_(std::move(target)) {
  const Eigen::MatrixXd weighted = weight_.asDiagonal() * common_;
  gram_.compute(common_.transpose() * weighted);
  own_ = weighted.transpose() * target_;
}

std::optional<WeightedProjection::Part> WeightedProjection::project(const Columns& columns) const {
  const Eigen::MatrixXd weighted = weight_.asDiagonal() * columns;
  const Eigen::MatrixXd cross = common_.transpose() * weighted;
  const Eigen::MatrixXd carried = gram_.solve(cross);
  const Eigen::MatrixXd square = columns.transpose() * weighted;
  const Eigen::MatrixXd independent = square - cross.transpose() * carried;
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    if (!(independent(i, i) > kIndependent * square(i, i))) return std::nullopt;  // 0 and NaN, too
  Part part;
  const Eigen::VectorXd moment = weighted.transpose() * target_ - carried.transpose() * own_;
  part.coefficients = solveSymmetric(independent, moment);
  part.gain = moment.dot(part.coefficients);
  part.common = gram_.solve(own_) - carried * part.coefficients;
  return part;
}

std::vector<std::vector<double>> scanShapes(const ForceEffect& effect, const MotionScale& scales) {
  const auto dimensions = static_cast<double>(effect.shapes.size());
  const auto most = dimensions > 0.0 ? static_cast<int>(std::pow(kMostCombinations, 1.0 / dimensions) + 1e-9) : 1;
  std::vector<std::vector<double>> result{{}};
  for (const ShapeParameter& shape : effect.shapes) {
    const double ratio = shape.max / shape.min;
    const int count =
        std::clamp(static_cast<int>(std::lround(std::log(ratio) / std::log(kRatio))), std::min(2, most), most);
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& shapes : result)
      for (int i = 0; i < count; ++i) {
        longer.push_back(shapes);
        longer.back().push_back(scales.unit(shape.scale) * shape.min * std::pow(ratio, (i + 0.5) / count));
      }
    result = std::move(longer);
  }
  return result;
}

Screening::Screening(const Records& records, const HoldOut& held_out, const ModelFit& fit)
    : records_(records), fit_(fit), response_(records, fit) {
  Eigen::MatrixXd common = forcesAlong(fit.model, response_.motion());
  for (Eigen::Index j = 0; j < common.cols(); ++j) common.col(j) = response_.respond(common.col(j));
  const Eigen::VectorXd residual = joined(fit.residuals);
  rows_ = WeightedProjection(common, trainingWeights(held_out, residual), residual);
}

ScreenedModel Screening::expect(const WeightedProjection::Columns& columns,
                                const WeightedProjection::Part& part) const {
  const Eigen::VectorXd residual = rows_.target() - columns * part.coefficients - rows_.common() * part.common;
  ScreenedModel screened{fit_.model, part.gain, split(residual, response_.motion().begins)};
  StrutModel& model = screened.model;
  // A fit begins badly at a linear guess that is far away: b1 and b0 go half their size at most.
  const auto change = [](double value, double by) { return std::clamp(value + by, 0.5 * value, 1.5 * value); };
  model.damping_to_mass = change(model.damping_to_mass, part.common[0]);
  model.stiffness_to_mass = change(model.stiffness_to_mass, part.common[1]);
  for (std::size_t j = 0; j < model.effects.size(); ++j) model.effects[j].coefficient += part.common[2 + j];
  return screened;
}

std::optional<ScreenedModel> Screening::screen(const ForceEffect& effect) const {
  std::optional<ScreenedModel> best;
  bool acts = false;
  for (const std::vector<double>& shapes : scanShapes(effect, response_.scale())) {
    const Eigen::VectorXd column = response_.respond(forceAlong(effect, shapes, response_.motion()));
    const std::optional<WeightedProjection::Part> projection = rows_.project(column);
    acts = acts || projection;
    if (!projection || (effect.positive && !(projection->coefficients[0] > 0.0))) continue;
    if (best && projection->gain <= best->training_gain) continue;
    best = expect(column, *projection);
    best->model.effects.push_back({effect, projection->coefficients[0], shapes});
  }
  if (acts && !best) return ScreenedModel{fit_.model, 0.0, fit_.residuals, FitFailure::kWrongSign};
  return best;
}

std::optional<ScreenedModel> Screening::screen(const MeasurementEffect& effect) const {
  const Eigen::MatrixXd slopes = response_.readingSlopes(effect);
  std::vector<Eigen::Index> live;  // the others go with channels that are empty
  for (Eigen::Index i = 0; i < slopes.cols(); ++i)
    if (!slopes.col(i).isZero(0.0)) live.push_back(i);
  Eigen::MatrixXd columns(slopes.rows(), live.size());
  for (std::size_t i = 0; i < live.size(); ++i) columns.col(i) = slopes.col(live[i]);
  const std::optional<WeightedProjection::Part> projection = live.empty() ? std::nullopt : rows_.project(columns);
  if (!projection) return std::nullopt;
  ScreenedModel screened = expect(columns, *projection);
  std::vector<double> coefficients(slopes.cols(), 0.0);
  for (std::size_t i = 0; i < live.size(); ++i) coefficients[live[i]] = projection->coefficients[i];
  screened.model.reading.push_back({effect, coefficients});
  return screened;
}

std::optional<ScreenedModel> Screening::asItIs(const StrutModel& model) const {
  std::optional<Residuals> residuals = freeRunResiduals(model, segmentsOf(records_), fit_.initial);
  if (!residuals) return std::nullopt;
  const double gain = rows_.weight().dot(rows_.target().cwiseAbs2() - joined(*residuals).cwiseAbs2());
  return ScreenedModel{model, gain, std::move(*residuals)};
}

double Screening::surfaceGain() const {
  const Eigen::Index n = response_.numSamples(), stride = 1 + n / kSurfaceRows;
  const Eigen::Index rows = (n + stride - 1) / stride;
  using Strided = Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>>;
  const auto thinned = [&](const Eigen::VectorXd& all) {
    return Strided(all.data(), rows, Eigen::InnerStride<>(stride));
  };
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(n, kForceNodes * kForceNodes);
  for (Eigen::Index k = 0; k < n; ++k) {
    const StrutMotion& m = response_.motion().samples[k];
    forHatsAt(m.travel / response_.scale().travel, m.travel_rate / response_.scale().travel_rate, kForceNodes,
              [&](int node, double value) { forces(k, node) = value; });
  }
  Eigen::MatrixXd columns(rows, forces.cols());
  for (Eigen::Index node = 0; node < forces.cols(); ++node)
    columns.col(node) = thinned(response_.respond(forces.col(node)));
  const Eigen::VectorXd residual = thinned(rows_.target()), weight = thinned(rows_.weight());
  Eigen::MatrixXd gram = columns.transpose() * weight.asDiagonal() * columns;
  gram.diagonal().array() += 1e-6 * gram.trace() / static_cast<double>(gram.rows());  // nodes that are never visited
  const Eigen::VectorXd solution = gram.llt().solve(columns.transpose() * weight.cwiseProduct(residual));
  const Eigen::VectorXd unexplained = residual - columns * solution;
  double before = 0.0, after = 0.0;
  for (Eigen::Index k = 0; k < rows; ++k) {
    if (weight[k] != 0.0) continue;
    before += square(residual[k]);
    after += square(unexplained[k]);
  }
  return before > 0.0 ? std::max(0.0, 1.0 - after / before) : 0.0;
}

}  // namespace suspension_health_monitor
