#include "suspension_health_monitor/internal/monitor/model_tracker.h"

#include <algorithm>

#include "suspension_health_monitor/internal/monitor/validity_gate.h"

namespace suspension_health_monitor {
namespace {

// Samples: a new model costs the free run as much as a step of it, and rmse and fit are means over seconds.
constexpr int kSlowlyEvery = 8;

std::vector<ColumnOrigin> origins(const std::vector<ActiveEffect>& before, const std::vector<ActiveEffect>& after) {
  std::vector<ColumnOrigin> columns{{kDampingToMass, 0.0}, {kStiffnessToMass, 0.0}};
  for (const ActiveEffect& active : after) {
    const auto same = std::find_if(before.begin(), before.end(), [&](const ActiveEffect& other) {
      return other.effect.name == active.effect.name && other.shapes == active.shapes;
    });
    ColumnOrigin column{std::nullopt, active.coefficient};
    if (same != before.end()) column.before = kNumStrutParameters + static_cast<int>(same - before.begin());
    columns.push_back(column);
  }
  return columns;
}

// The free run follows estimates that are worth something, though it may fail by them for now.
bool isModel(const StrutEstimate& estimate) {
  return estimate.tellsChanges() || estimate.doubt == EstimateDoubt::kFreeRunFails ||
         estimate.doubt == EstimateDoubt::kOldData;
}

void write(const TopEstimate& blocks, std::size_t num_effects, StrutEstimate& estimate) {
  const auto stddev = [&](int i) { return std::sqrt(blocks.covariance(i, i)); };
  estimate.damping_to_mass = blocks.theta[kBlockDamping];
  estimate.stiffness_to_mass = blocks.theta[kBlockStiffness];
  estimate.damping_to_mass_stddev = stddev(kBlockDamping);
  estimate.stiffness_to_mass_stddev = stddev(kBlockStiffness);
  estimate.correlation =
      blocks.covariance(0, 1) / (estimate.damping_to_mass_stddev * estimate.stiffness_to_mass_stddev);
  estimate.delay = blocks.theta[kBlockDelay];
  estimate.delay_stddev = stddev(kBlockDelay);
  estimate.gain = blocks.theta[kBlockGain];
  estimate.gain_stddev = stddev(kBlockGain);
  estimate.num_effects = num_effects;
  for (std::size_t j = 0; j < num_effects; ++j) {
    const int i = kNumBlockParameters + static_cast<int>(j);
    estimate.coefficients[j] = blocks.theta[i];
    estimate.coefficient_stddevs[j] = stddev(i);
  }
  if (num_effects == 0) {
    estimate.friction = blocks.dryFriction();
    estimate.damping_to_mass_stddev = std::hypot(estimate.damping_to_mass_stddev, estimate.friction->lawStddev());
    estimate.stiffness_to_mass_stddev =
        std::hypot(estimate.stiffness_to_mass_stddev, estimate.friction->stiffnessLawStddev());
  }
  estimate.effective_rows = blocks.blocks;
  estimate.explained = blocks.explained;
  estimate.window = (blocks.blocks + 1) * blocks.length / 2.0;
  estimate.roughest = blocks.roughest;
  estimate.change = blocks.change;
}

}  // namespace

ModelTracker::ModelTracker(const MonitorSettings& options, bool has_own_blocks)
    : is_paper_(options.preset == "paper"),
      block_length_(options.presentBlockLength()),
      period_(*options.sample_period),
      oldest_data_(options.oldest_data),
      identifier_(options),
      free_run_(*options.sample_period),
      comparison_(1.0 - std::min(1.0, *options.sample_period / options.comparison_window)) {
  if (has_own_blocks) blocks_.emplace(VehicleChannels::ofAccelerometers(), period_, block_length_);
}

void ModelTracker::setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut,
                              ModelReport& report) {
  const std::vector<ColumnOrigin> columns = origins(this->effects(), effects);
  free_run_.setEffects(effects);  // may throw: first
  identifier_.changeModel(columns);
  blocks_.emplace(VehicleChannels::ofAccelerometers(), period_, block_length_, effects.size());
  newest_.reset();
  has_own_model_ = is_given_ = strut && free_run_.trySetModel(strut->damping_to_mass, strut->stiffness_to_mass);
  starts_.clear();
  for (std::size_t j = 0; j < effects.size(); ++j) {
    starts_.push_back(identifier_.coefficient(j));
    free_run_.setCoefficient(j, starts_[j]);
  }
  if (report.la.effective_rows > 0.0) identifier_.write(report.ls, report.la);
  judge(report);
}

bool ModelTracker::addReading(Side side, Stamp stamp, double acceleration, ModelReport& report) {
  now_ = stamp;
  if (!blocks_) return false;
  const TopEstimate* estimate = blocks_->push(readingOf(side, stamp, acceleration));
  hold(blocks_->estimate() != nullptr && blocks_->estimator().newestSayNothing());
  return take(estimate, report);
}

bool ModelTracker::take(const TopEstimate* estimate, ModelReport& report) {
  if (estimate == nullptr) return false;
  write(*estimate, effects().size(), report.estimate);
  newest_ = {estimate->stamp, estimate->age};
  return true;
}

void ModelTracker::takeEstimate(const TopEstimate& estimate, const Eigen::Vector2d& model_stddev, ModelReport& report) {
  take(&estimate, report);
  report.estimate.damping_model_stddev = model_stddev[0];
  report.estimate.stiffness_model_stddev = model_stddev[1];
}

bool ModelTracker::add(const CornerSample& newest, double time, const CornerSample* compared, ModelReport& report) {
  const std::optional<double> predicted = free_run_.push(newest.unsprung_acceleration, time);
  const bool plain = effects().empty();
  if (!plain && free_run_.runaways() != runaways_) fallBack();
  // Without a model of the travel there are no columns.
  bool is_new = false;
  if (const CornerSample* of_row = plain ? &newest : predicted ? compared : nullptr)
    is_new = addRow(*of_row, report);
  else
    identifier_.skip();
  report.has_row = identifier_.hasRow();
  if (report.has_row) identifier_.write(report.ls, report.la);
  report.comparison.has_sample = compared != nullptr;
  if (compared != nullptr) compare(*compared, predicted, report);
  judge(report);
  if (samples_++ % kSlowlyEvery == 0 || !has_own_model_) takeModel(report);
  return is_new;
}

bool ModelTracker::addRow(const CornerSample& sample, ModelReport& report) {
  identifier_.add(sample, free_run_.effectForces());
  // The blocks wait until the free run has forgotten where it started: what they find leads it.
  return !effects().empty() && free_run_.settled() &&
         take(blocks_->pushEffects(sample.stamp, free_run_.effectForces()), report);
}

void ModelTracker::judge(ModelReport& report) {
  EstimateFacts of_blocks = factsOf(report.estimate, newest_.has_value());
  if (newest_) {
    // Samples of a vehicle's strut are late, and may be older than its blocks.
    report.estimate.age = of_blocks.age = newest_->age + std::max(0.0, toSeconds(now_ - newest_->stamp));
    of_blocks.oldest = oldest_data_;
  }
  report.estimate.doubt = doubtOf(of_blocks);
  for (StrutEstimate* estimate : {&report.ls, &report.la}) {
    EstimateFacts facts = identifier_.facts(*estimate, of_input_);
    facts.free_run_fails = estimate == &report.la && is_paper_ && free_run_fails_;
    if (!is_paper_) facts.agrees = report.estimate.valid() && agree(*estimate, report.estimate);
    estimate->doubt = doubtOf(facts);
  }
}

// Of the blocks.  @param has_estimate  this one is theirs.
EstimateFacts ModelTracker::factsOf(const StrutEstimate& estimate, bool has_estimate) const {
  EstimateFacts facts = of_input_;
  facts.period_fits = true;  // blocks need no grid
  const double damping = leastDamping(estimate.damping_to_mass, estimate.stiffness_to_mass);
  facts.has_row = has_estimate || (blocks_ && blocks_->estimator().hasBlocks());
  facts.damping_stddev = estimate.damping_to_mass_stddev / damping;
  facts.stiffness_stddev = estimate.stiffness_to_mass_stddev / estimate.stiffness_to_mass;
  facts.absolute_stddev = std::max(estimate.dampingAbsoluteStddev() / damping,
                                   estimate.stiffnessAbsoluteStddev() / estimate.stiffness_to_mass);
  facts.explained = estimate.explained;
  return facts;
}

StrutEstimate ModelTracker::judged(const std::optional<TopEstimate>& blocks,
                                   const Eigen::Vector2d& model_stddev) const {
  StrutEstimate estimate;
  if (blocks) write(*blocks, effects().size(), estimate);
  estimate.damping_model_stddev = model_stddev[0];
  estimate.stiffness_model_stddev = model_stddev[1];
  estimate.doubt = doubtOf(factsOf(estimate, blocks.has_value()));
  return estimate;
}

void ModelTracker::takeModel(const ModelReport& report) {
  const bool by_blocks = !is_paper_ && isModel(report.estimate);
  const StrutEstimate& estimate = by_blocks ? report.estimate : report.la;
  // Until the blocks know the strut LA leads, which needs no more than its own rows for that, unless it was given.
  const auto leads = [&] { return doubtOf(identifier_.facts(report.la, {})) == EstimateDoubt::kNone; };
  if (!by_blocks && !(is_paper_ ? isModel(report.la) : !newest_ && !is_given_ && leads())) return;
  if (!free_run_.trySetModel(estimate.damping_to_mass, estimate.stiffness_to_mass)) return;
  has_own_model_ = true;
  for (std::size_t j = 0; j < estimate.num_effects; ++j) free_run_.setCoefficient(j, estimate.coefficients[j]);
}

void ModelTracker::lead(const StrutEstimate& plain) {
  if (has_own_model_ || !plain.valid() || !free_run_.trySetModel(plain.damping_to_mass, plain.stiffness_to_mass))
    return;
  for (std::size_t j = 0; j < starts_.size(); ++j) free_run_.setCoefficient(j, starts_[j]);
}

// The coefficients made the free run leave all bounds: on without them until the estimates have seen enough rows anew.
void ModelTracker::fallBack() {
  runaways_ = free_run_.runaways();
  identifier_.restartValidity();
  has_own_model_ = is_given_ = false;
  for (std::size_t j = 0; j < starts_.size(); ++j) free_run_.setCoefficient(j, starts_[j] = 0.0);
}

void ModelTracker::compare(const CornerSample& sample, const std::optional<double>& predicted, ModelReport& report) {
  ComparisonReport& comparison = report.comparison;
  comparison.stamp = sample.stamp;
  comparison.measured = sample.sprung_acceleration;
  comparison.predicted = free_run_.settled() ? predicted : std::nullopt;
  if (!comparison.predicted) return;
  comparison_.add(comparison.measured, *comparison.predicted);
  if (compared_++ % kSlowlyEvery != 0) return;
  comparison.rmse = comparison.base_rmse = comparison_.rmse();
  comparison.fit_percent = comparison.base_fit_percent = comparison_.fitPercent();
  free_run_fails_ = comparison_.isWorseThanConstant();
}

void ModelTracker::setInput(const InputStatus& input, Stamp now, ModelReport& report) {
  of_input_.period_fits = input.period_fits;
  of_input_.unit_fits = input.unit_fits;
  now_ = now;
  judge(report);
}

void ModelTracker::setOptions(const MonitorSettings& options) {
  identifier_.setForgetting(options);
  oldest_data_ = options.oldest_data;
}

void ModelTracker::startNewSeries(ModelReport& report) {
  identifier_.startNewSeries();
  free_run_.reset();
  free_run_fails_ = false;  // until it has settled again
  report.comparison.predicted.reset();
  judge(report);
}

void ModelTracker::startNewDrive(ModelReport& report) {
  if (blocks_) blocks_->restart();
  newest_.reset();
  now_ = {};
  startNewSeries(report);
}

}  // namespace suspension_health_monitor
