#include <algorithm>
#include <array>
#include <cmath>

#include "bin_range.h"
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/compare/tuning.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

struct Sample {
  StrutMotion motion;
  double seen = 0.0, law = 0.0;
};

double StrutMotion::*memberOf(ForceVariable variable) {
  constexpr std::array members{&StrutMotion::travel, &StrutMotion::travel_rate, &StrutMotion::time};
  return members[static_cast<std::size_t>(variable)];
}

double valueOf(const Sample& sample, ForceVariable variable) { return sample.motion.*memberOf(variable); }

/// Whether the force of some samples changes when one of its variables is taken from other samples.
bool dependsOn(const ActiveEffect& active, ForceVariable variable, const std::vector<Sample>& samples) {
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / kCompareTuning.probes);
  for (std::size_t i = 0; i < samples.size(); i += stride) {
    StrutMotion other = samples[i].motion;
    other.*memberOf(variable) = valueOf(samples[(i + samples.size() / 2 + 1) % samples.size()], variable);
    const double force = samples[i].law, changed = active.force(other);
    if (std::abs(changed - force) > kRounding * (std::abs(force) + std::abs(changed))) return true;
  }
  return false;
}

std::vector<ForceVariable> variablesOf(const ActiveEffect& active, const std::vector<Sample>& samples) {
  if (active.effect.memory_rate) return {ForceVariable::kTravel};
  std::vector<ForceVariable> variables;
  for (const ForceVariable variable : {ForceVariable::kTravel, ForceVariable::kTravelRate, ForceVariable::kTime})
    if (variables.size() < 2 && dependsOn(active, variable, samples)) variables.push_back(variable);
  if (variables.empty()) variables.push_back(ForceVariable::kTravel);
  return variables;
}

/// Even edges over nearly all values.
std::vector<double> edgesOver(const std::vector<Sample>& samples, ForceVariable variable, std::size_t bins) {
  Eigen::VectorXd values(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) values[k] = valueOf(samples[k], variable);
  const auto [from, to] = coveredRange(std::move(values));
  return evenEdges(from, to, bins);
}

/// Index of the range that holds the value, or the number of ranges if none does.
std::size_t rangeOf(const std::vector<double>& edges, double value) {
  const bool is_inside = value >= edges.front() && value <= edges.back();
  return is_inside ? binOf(edges, value) : edges.size() - 1;
}

/// @param bin  whose deviation is the sum of squares until finish().
void add(const Sample& sample, PartialResidualBin& bin) {
  const double share = 1.0 / static_cast<double>(++bin.count), step = sample.seen - bin.mean;
  bin.mean += share * step;
  bin.deviation += step * (sample.seen - bin.mean);
  bin.law += share * (sample.law - bin.law);
}

void finish(PartialResidualBin& bin) {
  bin.deviation = bin.count > 1 ? std::sqrt(bin.deviation / static_cast<double>(bin.count - 1)) : 0.0;
}

/// @param direction  +1 compressing, -1 extending, 0 both.
std::vector<PartialResidualBin> curveOver(const std::vector<Sample>& samples, ForceVariable variable, int direction) {
  const std::vector<double> edges = edgesOver(samples, variable, kCompareTuning.bins);
  std::vector<PartialResidualBin> curve(kCompareTuning.bins + 1);  // the last one for what is outside
  for (const Sample& sample : samples)
    if (direction == 0 || direction * sample.motion.travel_rate > 0.0)
      add(sample, curve[rangeOf(edges, valueOf(sample, variable))]);
  curve.pop_back();
  for (std::size_t i = 0; i < kCompareTuning.bins; ++i) {
    curve[i].at = 0.5 * (edges[i] + edges[i + 1]);
    finish(curve[i]);
  }
  const auto is_empty = [](const PartialResidualBin& bin) { return bin.count < kFewestForScatter; };
  curve.erase(std::remove_if(curve.begin(), curve.end(), is_empty), curve.end());
  return curve;
}

PartialResidualGrid gridOver(const std::vector<Sample>& samples, ForceVariable first, ForceVariable second) {
  PartialResidualGrid grid{
      edgesOver(samples, first, kCompareTuning.columns), edgesOver(samples, second, kCompareTuning.rows), {}};
  // The last ones for what is outside.
  grid.cells.assign(kCompareTuning.columns + 1, std::vector<PartialResidualBin>(kCompareTuning.rows + 1));
  for (const Sample& sample : samples)
    add(sample, grid.cells[rangeOf(grid.first_edges, valueOf(sample, first))]
                          [rangeOf(grid.second_edges, valueOf(sample, second))]);
  grid.cells.pop_back();
  for (std::vector<PartialResidualBin>& column : grid.cells) {
    column.pop_back();
    for (PartialResidualBin& cell : column) {
      finish(cell);
      if (cell.count < kCompareTuning.fewest_in_cell) cell = {};
    }
  }
  return grid;
}

/// Every sample with the force of one effect.
std::vector<Sample> samplesOf(const std::vector<ComparedSegment>& segments, const FreeMotion& motion,
                              const ActiveEffect& active, std::size_t index) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t k = 0; k < segments[i].size(); ++k) {
      const StrutState& state = motion[i][k];
      Sample sample{{state.travel, state.travel_rate, segments[i].timeDriven(k), state.memory[index]}};
      sample.law = active.force(sample.motion);
      sample.seen = segments[i].missing_force[k] + sample.law;
      samples.push_back(sample);
    }
  return samples;
}

PartialResidual partialResidual(const ActiveEffect& active, const std::vector<Sample>& samples) {
  PartialResidual force;
  force.effect = active;
  force.variables = variablesOf(active, samples);
  if (force.variables.size() == 2) {
    force.grid = gridOver(samples, force.variables[0], force.variables[1]);
  } else {
    force.curve = curveOver(samples, force.variables.front(), force.hasMemory() ? 1 : 0);
    if (force.hasMemory()) force.back = curveOver(samples, force.variables.front(), -1);
  }
  return force;
}

}  // namespace

double PartialResidual::lawAt(double value) const {
  StrutMotion motion;
  motion.*memberOf(variables.front()) = value;
  return effect.force(motion);
}

std::vector<PartialResidual> partialResiduals(const std::vector<ComparedSegment>& segments, const FreeMotion& motion,
                                              const StrutModel& model) {
  std::vector<PartialResidual> forces;
  for (std::size_t j = 0; j < model.effects.size(); ++j)
    forces.push_back(partialResidual(model.effects[j], samplesOf(segments, motion, model.effects[j], j)));
  return forces;
}

}  // namespace suspension_health_monitor
