#include "suspension_health_monitor/internal/monitor/model_tracker.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/monitor/validity_gate.h"

namespace suspension_health_monitor {
namespace {

constexpr int kModelEvery = 8;     // samples: a new model costs the free run as much as a step of it
constexpr int kFiguresEvery = 16;  // samples: rmse and fit are means over seconds

std::vector<ColumnOrigin> origins(const std::vector<ActiveEffect>& before, const std::vector<ActiveEffect>& after) {
  std::vector<ColumnOrigin> columns;
  for (const ActiveEffect& active : after) {
    const auto same = std::find_if(before.begin(), before.end(), [&](const ActiveEffect& other) {
      return other.effect.name == active.effect.name && other.shapes == active.shapes;
    });
    ColumnOrigin column{std::nullopt, active.coefficient};
    if (same != before.end()) column.before = static_cast<int>(same - before.begin());
    columns.push_back(column);
  }
  return columns;
}

// The free run follows estimates that are worth something, though it may fail by them for now.
bool isModel(const StrutEstimate& la) { return la.valid() || la.doubt == EstimateDoubt::kFreeRunFails; }

}  // namespace

ModelTracker::ModelTracker(const MonitorSettings& options)
    : identifier_(options),
      free_run_(*options.sample_period),
      model_due_(kModelEvery),
      figures_due_(kFiguresEvery),
      comparison_(1.0 - std::min(1.0, *options.sample_period / options.comparison_window)) {}

void ModelTracker::setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut,
                              ModelReport& report) {
  const std::vector<ColumnOrigin> columns = origins(this->effects(), effects);
  free_run_.setEffects(effects);  // may throw: first
  identifier_.changeEffects(columns);
  has_own_model_ = strut && free_run_.trySetModel(strut->damping_to_mass, strut->stiffness_to_mass);
  starts_.clear();
  for (std::size_t j = 0; j < effects.size(); ++j) {
    starts_.push_back(identifier_.coefficient(j));
    free_run_.setCoefficient(j, starts_[j]);
  }
  if (report.la.effective_rows > 0.0) identifier_.describe(report.ls, report.la);
  judge(report);
}

void ModelTracker::add(const CornerSample& newest, double time, const CornerSample* compared, ModelReport& report) {
  const std::optional<double> predicted = free_run_.push(newest.unsprung_acceleration, time);
  const bool plain = effects().empty();
  if (!plain && free_run_.runaways() != runaways_) fallBack();
  // Without a model of the travel there are no columns.
  if (const CornerSample* of_row = plain ? &newest : predicted ? compared : nullptr)
    identifier_.add(*of_row, free_run_.effectForces());
  else
    identifier_.skip();
  report.has_row = identifier_.hasRow();
  if (report.has_row) identifier_.describe(report.ls, report.la);
  report.comparison.has_sample = compared != nullptr;
  if (compared != nullptr) compare(*compared, predicted, report);
  judge(report);
  if (isModel(report.la) && (model_due_() || !has_own_model_)) takeModel(report.la);
}

void ModelTracker::judge(ModelReport& report) {
  for (StrutEstimate* estimate : {&report.ls, &report.la}) {
    EstimateFacts facts = identifier_.facts(*estimate);
    facts.period_fits = period_fits_;
    facts.free_run_fails = estimate == &report.la && free_run_fails_;
    estimate->doubt = doubtOf(facts);
  }
  identifier_.noteValidity(report.ls, report.la);
}

void ModelTracker::takeModel(const StrutEstimate& la) {
  if (!free_run_.trySetModel(la.damping_to_mass, la.stiffness_to_mass)) return;
  has_own_model_ = true;
  for (std::size_t j = 0; j < la.num_effects; ++j) free_run_.setCoefficient(j, la.coefficients[j]);
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
  has_own_model_ = false;
  for (std::size_t j = 0; j < starts_.size(); ++j) free_run_.setCoefficient(j, starts_[j] = 0.0);
}

void ModelTracker::compare(const CornerSample& sample, const std::optional<double>& predicted, ModelReport& report) {
  ComparisonReport& comparison = report.comparison;
  comparison.stamp = sample.stamp;
  comparison.measured = sample.sprung_acceleration;
  comparison.predicted = free_run_.settled() ? predicted : std::nullopt;
  if (!comparison.predicted) return;
  comparison_.add(comparison.measured, *comparison.predicted);
  if (!figures_due_()) return;
  comparison.rmse = comparison.base_rmse = comparison_.rmse();
  comparison.fit_percent = comparison.base_fit_percent = comparison_.fitPercent(comparison.rmse);
  free_run_fails_ = comparison_.isWorseThanConstant();
}

void ModelTracker::setInput(const InputStatus& input, ModelReport& report) {
  period_fits_ = input.period_fits;
  identifier_.setWheelSpectrum(input.folded[1], input.wheel_at_limit);
  judge(report);
}

void ModelTracker::startNewSeries(ModelReport& report) {
  identifier_.startNewSeries();
  free_run_.reset();
  free_run_fails_ = false;  // until it has settled again
  report.comparison.predicted.reset();
  judge(report);
}

void ModelTracker::startNewDrive(ModelReport& report) {
  identifier_.startNewDrive();
  startNewSeries(report);
}

}  // namespace suspension_health_monitor
