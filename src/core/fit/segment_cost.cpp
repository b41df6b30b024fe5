#include <algorithm>
#include <cmath>

#include "parameterization.h"

namespace suspension_health_monitor {
namespace {

constexpr double kParameterStep = 1e-6;  // relative step of the numerical derivatives

}  // namespace

SegmentCost::SegmentCost(const Segments& segments, std::size_t index, const SampleMask* mask,
                         const Parameterization& parameters, const StrutModel& model, const CostScales& scales,
                         CarriedMemories& memories)
    : segment_(*segments[index]),
      index_(index),
      parameters_(parameters),
      model_(model),
      scales_(scales),
      memories_(memories) {
  for (std::size_t k = 0; k < segment_.size(); ++k)
    if (mask == nullptr || (*mask)[k] != 0) used_.push_back(k);
  set_num_residuals(static_cast<int>(used_.size()));
  mutable_parameter_block_sizes()->push_back(parameters.size());
  mutable_parameter_block_sizes()->push_back(2);
}

bool SegmentCost::Evaluate(double const* const* x, double* residuals, double** jacobians) const {
  Eigen::VectorXd shared = Eigen::Map<const Eigen::VectorXd>(x[0], parameters_.size());
  Eigen::VectorXd local = Eigen::Map<const Eigen::VectorXd>(x[1], 2);
  Eigen::VectorXd base(num_residuals());
  if (!evaluate(shared, local, base)) return false;
  Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = base.unaryExpr([this](double r) { return damp(r); });
  if (jacobians == nullptr) return true;
  return (jacobians[0] == nullptr || differentiate(shared, local, shared, base, jacobians[0])) &&
         (jacobians[1] == nullptr || differentiate(shared, local, local, base, jacobians[1]));
}

bool SegmentCost::differentiate(const Eigen::VectorXd& shared, const Eigen::VectorXd& local, Eigen::VectorXd& varied,
                                const Eigen::VectorXd& base, double* jacobian) const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor> columns(jacobian, num_residuals(), varied.size());
  Eigen::VectorXd moved(num_residuals());
  for (Eigen::Index i = 0; i < varied.size(); ++i) {
    const double kept = varied[i];
    double step = kParameterStep * std::max(1.0, std::abs(kept));
    varied[i] = kept + step;
    if (!evaluate(shared, local, moved)) {  // at the edge of stability: look the other way
      step = -step;
      varied[i] = kept + step;
      if (!evaluate(shared, local, moved)) moved = base;  // on a ridge: it stays where it is
    }
    varied[i] = kept;
    for (int k = 0; k < num_residuals(); ++k) columns(k, i) = (moved[k] - base[k]) / step * dampSlope(base[k]);
  }
  return true;
}

bool SegmentCost::evaluate(const Eigen::VectorXd& shared, const Eigen::VectorXd& local,
                           Eigen::VectorXd& residuals) const {
  StrutModel model = model_;
  parameters_.apply(shared.data(), model);
  StrutState state{0.0, 0.0, memories_.at(index_, model)};
  state.travel = local[0] * scales_.travel;
  state.travel_rate = local[1] * scales_.travel_rate;
  std::vector<double> predicted;
  if (!runFree(model, segment_, state, predicted)) return false;
  for (std::size_t i = 0; i < used_.size(); ++i)
    residuals[static_cast<Eigen::Index>(i)] = segment_.sprung[used_[i]] - predicted[used_[i]];
  return true;
}

double SegmentCost::damp(double r) const {
  const double q = r / scales_.outlier;
  return std::copysign(scales_.outlier * std::sqrt(2.0 * q * q / (std::sqrt(1.0 + q * q) + 1.0)), r);
}

double SegmentCost::dampSlope(double r) const {
  const double q = r / scales_.outlier;
  const double damped = damp(r);
  return damped == 0.0 ? 1.0 : r / (std::sqrt(1.0 + q * q) * damped);
}

}  // namespace suspension_health_monitor
