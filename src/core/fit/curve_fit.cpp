#include "suspension_health_monitor/internal/fit/curve_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "nodal_law.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "whitening.h"

namespace suspension_health_monitor {
namespace {

constexpr int kRefinements = 4;            // to a sixteenth of the first nodes' distance: a thirtieth of the rms
constexpr std::size_t kMostNodes = 50;     // of a law: it does not bend everywhere
constexpr double kTolerated = 0.5;         // misfit over standard deviation: adds an eighth of the variance
constexpr double kSteepest = 10.0;         // change of slope, over the slope, that is not unusual (an end stop)
constexpr int kMostSteps = 8;              // some three per refinement
constexpr int kMostHalvings = 6;           // of a step after which the model runs away
constexpr double kTransient = 1e-3;        // share of a wrong initial state that the first sample that counts still has
constexpr double kPeriodsOfCluster = 2.0;  // noise that a strut passes is forgotten after a natural period
constexpr Eigen::Index kRowsPerColumn = 20;  // fewest samples

enum Which : std::size_t { kDamper, kSpring };

double variableOf(const StrutMotion& motion, std::size_t which) {
  return which == kDamper ? motion.travel_rate : motion.travel;
}

bool hasMemory(const ActiveEffect& active) { return static_cast<bool>(active.effect.memory_rate); }

double sumOf(const std::vector<ActiveEffect>& effects, const StrutMotion& motion) {
  double sum = 0.0;
  for (const ActiveEffect& active : effects) sum += active.force(motion);
  return sum;
}

/// The fit of both laws and of an offset between the sensors, by Gauss-Newton steps.
class CurveFit {
 public:
  /// @param start  a model as it is, run from rest.
  CurveFit(const Records& records, const ModelFit& start)
      : records_(records),
        // A strut without a damper is given a tenth of the critical damping, so that its damper's law has a scale.
        slopes_{std::max(start.model.damping_to_mass, 0.2 * std::sqrt(start.model.stiffness_to_mass)),
                start.model.stiffness_to_mass},
        rest_(start.model),
        momentary_(takeUnless(rest_.effects, hasMemory)),
        fit_(start),
        accuracy_(accuracyOfFreeRuns(records)) {
    const LinearResponse response(records, start);
    rms_ = {response.scale().travel_rate, response.scale().travel};
    std::array<double, 2> most{};
    for (const StrutMotion& motion : response.motion().samples)
      for (const std::size_t w : {kDamper, kSpring}) most[w] = std::max(most[w], std::abs(variableOf(motion, w)));
    laws_ = {NodalLaw::sampled(most[kDamper], [&](double v) { return slopes_[kDamper] * v + alone(0.0, v); }),
             NodalLaw::sampled(most[kSpring], [&](double d) { return slopes_[kSpring] * d + alone(d, 0.0); })};
    rest_.damping_to_mass = rest_.stiffness_to_mass = 0.0;
    rest_.effects.push_back({{}, 1.0, {}});
    rest_.effects.back().effect.force = [this](const StrutMotion& m, const double*) {
      const double joint =
          momentary_.empty() ? 0.0 : sumOf(momentary_, m) - alone(m.travel, 0.0) - alone(0.0, m.travel_rate);
      return joint + laws_[kDamper].at(m.travel_rate) + laws_[kSpring].at(m.travel);
    };
    countSamples(response.motion().begins);
  }

  CurveFit(const CurveFit&) = delete;  // the model calls this object

  /// @return false if nothing moves enough, or the model runs away.
  bool solve() {
    if (!(rms_[kDamper] > 0.0) || counts_.sum() < static_cast<double>(kRowsPerColumn * size()) || !run()) return false;
    for (int refined = 0;; ++refined) {
      std::optional<bool> settled = false;
      for (int i = 0; i < kMostSteps && settled == false; ++i) settled = step();
      if (!settled) return false;
      if (refined == kRefinements || !refine()) return true;
    }
  }

  ForceCurve curve(std::size_t which) const {
    const NodalLaw& law = laws_[which];
    std::vector<double> stddev;
    for (std::size_t i = 0; i < law.nodes.size(); ++i) {
      const double beside = std::max(i > 0 ? misfit(which, i - 1) : 0.0, misfit(which, i + 1));
      stddev.push_back(std::hypot(byNoise(which, i), std::max(misfit(which, i), beside)));
    }
    const auto isKnown = [&](std::size_t i) {
      return stddev[i] < kSmall * std::max(slopes_[which] * rms_[which], std::abs(law.values[i]));
    };
    std::size_t first = law.zero(), last = first;
    while (first > 0 && isKnown(first - 1)) --first;
    while (last + 1 < stddev.size() && isKnown(last + 1)) ++last;
    if (first == last) return {};
    const auto part = [&](const std::vector<double>& all) {
      return std::vector<double>(all.begin() + first, all.begin() + last + 1);
    };
    return {part(law.nodes), part(law.values), part(stddev)};
  }

 private:
  double alone(double travel, double rate) const {
    return sumOf(momentary_, {travel, rate, 0.0, {}}) - sumOf(momentary_, {0.0, 0.0, 0.0, {}});
  }

  // Columns: the damper's nodes, the spring's, the offset.
  Eigen::Index column(std::size_t which, std::size_t node) const {
    return static_cast<Eigen::Index>(which == kDamper ? node : laws_[kDamper].nodes.size() + node);
  }
  Eigen::Index size() const { return column(kSpring, laws_[kSpring].nodes.size()) + 1; }

  // The larger one of what white noise, and what the scores of stretches of the drives tell.
  double byNoise(std::size_t which, std::size_t node) const {
    const Eigen::Index at = column(which, node);
    return std::sqrt(std::max(inverse_(at, at), scattered_(at, at)));
  }

  // How wrong straight lines are at a node: least squares through x^2 f''/2 are so by h^2 f''/12 at nodes h apart. As
  // far as the bend is not by noise.
  double misfit(std::size_t which, std::size_t node) const {
    const NodalLaw& law = laws_[which];
    if (node == 0 || node + 1 >= law.nodes.size()) return 0.0;
    const Eigen::Vector3d weights = law.bendWeights(node);
    const Eigen::Index first = column(which, node - 1);
    const double noise = std::sqrt(weights.dot(inverse_.block<3, 3>(first, first) * weights));
    return std::max(0.0, std::abs(law.bend(node)) - noise) * (law.nodes[node + 1] - law.nodes[node - 1]) / 24.0;
  }

  // Not those that a wrong initial state or the filters' beginning is in.
  void countSamples(const std::vector<std::size_t>& begins) {
    const double period = records_.front()->period();
    const double settling = -std::log(kTransient) / slowestDecay(slopes_[kDamper], slopes_[kSpring]);  // [s]
    const auto skipped = std::max(kWhitening, static_cast<Eigen::Index>(settling / period));
    cluster_ = static_cast<Eigen::Index>(kPeriodsOfCluster * 2.0 * M_PI / std::sqrt(slopes_[kSpring]) / period);
    counts_.setOnes(begins.back());
    for (std::size_t s = 0; s + 1 < begins.size(); ++s)
      counts_.segment(begins[s], std::min<Eigen::Index>(begins[s + 1] - begins[s], skipped)).setZero();
  }

  bool run() {
    fit_.model = rest_;
    std::optional<Residuals> residuals = freeRunResiduals(rest_, segmentsOf(records_), fit_.initial);
    if (!residuals) return false;
    fit_.residuals = std::move(*residuals);
    for (std::vector<double>& segment : fit_.residuals)
      for (double& residual : segment) residual -= offset_;
    return true;
  }

  void move(const Eigen::VectorXd& by) {
    for (const std::size_t w : {kDamper, kSpring})
      for (std::size_t i = 0; i < laws_[w].nodes.size(); ++i) laws_[w].values[i] += by[column(w, i)];
    offset_ += by[size() - 1];
  }

  // What every node does to the prediction.
  Eigen::MatrixXd responses() const {
    const LinearResponse response(records_, fit_);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(response.numSamples(), size());
    for (Eigen::Index k = 0; k < columns.rows(); ++k)
      for (const std::size_t w : {kDamper, kSpring})
        laws_[w].forNodesAt(variableOf(response.motion().samples[k], w),
                            [&](std::size_t i, double weight) { columns(k, column(w, i)) = weight; });
    for (Eigen::Index j = 0; j + 1 < size(); ++j) columns.col(j) = response.respond(columns.col(j));
    columns.col(size() - 1).setOnes();
    return columns;
  }

  // Holds a node that few samples reach on the straight line through its neighbours.
  void addPrior(Eigen::MatrixXd& normal, Eigen::VectorXd& right) const {
    for (const std::size_t w : {kDamper, kSpring})
      for (std::size_t i = 1; i + 1 < laws_[w].nodes.size(); ++i) {
        const Eigen::Vector3d row = laws_[w].bendWeights(i) / (kSteepest * slopes_[w]);
        normal.block<3, 3>(column(w, i - 1), column(w, i - 1)) += row * row.transpose();
        right.segment<3>(column(w, i - 1)) -= row * (laws_[w].bend(i) / (kSteepest * slopes_[w]));
      }
  }

  /// One step.
  /// @return whether it was small against the standard deviations; nothing: the model runs away.
  std::optional<bool> step() {
    Eigen::MatrixXd columns = responses();
    const Eigen::VectorXd residual = joined(fit_.residuals), taps = whiteningOf(residual, counts_);
    for (Eigen::Index j = 0; j < size(); ++j) columns.col(j) = filtered(columns.col(j), taps);
    const Eigen::VectorXd white = filtered(residual, taps), weights = robustWeights(white, counts_, accuracy_);
    Eigen::MatrixXd normal = columns.transpose() * weights.asDiagonal() * columns;
    Eigen::VectorXd right = columns.transpose() * weights.cwiseProduct(white);
    addPrior(normal, right);
    Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
    for (const std::size_t w : {kDamper, kSpring}) scale[column(w, laws_[w].zero())] = 0.0;  // 0 at 0
    Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    scaled.diagonal().setOnes();
    inverse_ = scale.asDiagonal() * solveSymmetric(scaled, Eigen::MatrixXd(scale.asDiagonal()));
    Eigen::VectorXd moved = inverse_ * right;
    if (!moved.allFinite()) return std::nullopt;
    scattered_ = inverse_ * sumOfScores(columns, weights.cwiseProduct(white - columns * moved), cluster_) * inverse_;
    move(moved);
    for (int halved = 0; !run(); ++halved) {
      if (halved == kMostHalvings) return std::nullopt;
      moved /= 2.0;
      move(-moved);
    }
    return (moved.array().square() <= square(kSmall) * inverse_.diagonal().array()).all();
  }

  /// Adds nodes where a law bends more between two than noise hides.
  /// @return false: there is no need.
  bool refine() {
    std::array<NodalLaw, 2> finer;
    for (const std::size_t w : {kDamper, kSpring})
      finer[w] = laws_[w].refined([&](std::size_t i) {
        // 0 is known exactly
        const double stddev = i == laws_[w].zero() ? std::max(byNoise(w, i - 1), byNoise(w, i + 1)) : byNoise(w, i);
        return laws_[w].nodes.size() < kMostNodes && misfit(w, i) > kTolerated * stddev;
      });
    const Eigen::Index before = size();
    laws_ = finer;
    return size() > before;
  }

  const Records& records_;
  std::array<double, 2> slopes_;  // of the linear laws
  StrutModel rest_;               // what is not fitted, and the laws that are
  std::vector<ActiveEffect> momentary_;
  ModelFit fit_;
  std::array<NodalLaw, 2> laws_;
  std::array<double, 2> rms_{};     // rms of what they depend on
  double offset_ = 0.0, accuracy_;  // [m/s^2]
  Eigen::VectorXd counts_;          // 1 for samples that count, else 0
  Eigen::Index cluster_ = 0;
  Eigen::MatrixXd inverse_;    // covariance of the nodes and the offset by white noise
  Eigen::MatrixXd scattered_;  // the same by the scores of stretches
};

}  // namespace

StrutCurves fitCurves(const Records& records, const StrutModel& model) {
  // To the model, the curves are one more effect.
  const auto kept = std::count_if(model.effects.begin(), model.effects.end(), hasMemory);
  if (segmentsOf(records).empty() || kept == static_cast<std::ptrdiff_t>(kMostEffects)) return {};
  const FitOutcome start = withoutFit(records, model);
  if (!start) return {};
  CurveFit fit(records, *start);
  if (!fit.solve()) return {};
  return {fit.curve(kDamper), fit.curve(kSpring)};
}

ForceCurve ForceCurve::absolute() const {
  ForceCurve result = *this;
  for (std::size_t i = 0; i < stddev.size(); ++i) result.stddev[i] = std::hypot(stddev[i], model_error * force[i]);
  result.model_error = 0.0;
  return result;
}

double ForceCurve::forceAt(double x) const { return NodalLaw{at, force}.at(x); }
double ForceCurve::stddevAt(double x) const { return NodalLaw{at, stddev}.at(x); }

}  // namespace suspension_health_monitor
