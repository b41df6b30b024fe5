#include <ceres/ceres.h>

#include <cmath>

#include "carried_memories.h"

namespace suspension_health_monitor {

std::optional<std::vector<StrutState>> estimateInitialStates(const Records& records, const StrutModel& model) {
  const FitOutcome at_rest = withoutFit(records, model);
  if (!at_rest) return std::nullopt;
  const double size = std::sqrt(meanSquare(at_rest->residuals));
  std::vector<StrutState> states;
  for (const DriveSegment* segment : segmentsOf(records)) {
    const auto stateAt = [&](const double* x) {
      return StrutState{x[0] * size / model.stiffness_to_mass, x[1] * size / std::sqrt(model.stiffness_to_mass),
                        at_rest->initial[states.size()].memory};
    };
    const auto left = [&](const double* x, double* residuals) {
      std::vector<double> predicted;
      if (!runFree(model, *segment, stateAt(x), predicted)) return false;
      for (std::size_t k = 0; k < predicted.size(); ++k) residuals[k] = segment->sprung[k] - predicted[k];
      return true;
    };
    using Cost = ceres::NumericDiffCostFunction<decltype(left), ceres::FORWARD, ceres::DYNAMIC, 2>;
    double x[] = {0.0, 0.0};
    ceres::Problem problem;
    problem.AddResidualBlock(new Cost(&left, ceres::DO_NOT_TAKE_OWNERSHIP, static_cast<int>(segment->size())), nullptr,
                             x);
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_QR;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    if (!summary.IsSolutionUsable()) return std::nullopt;
    states.push_back(stateAt(x));
  }
  return states;
}

}  // namespace suspension_health_monitor
