#include "diagnose_service.h"

#include <sys/resource.h>

#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <utility>

#include "monitor_thread.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

constexpr std::chrono::milliseconds kPoll{20};
constexpr std::uint32_t kThreads = 2;  // one for the search, one to refuse another call meanwhile
constexpr int kNiceness = 10;

/// Ends a search from within its progress report.
struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("the monitor is shutting down") {}
};

/// Sets a flag for as long as it lives.
class Running {
 public:
  explicit Running(std::atomic<bool>& flag) : flag_(flag), first_(!flag.exchange(true)) {}
  ~Running() {
    if (first_) flag_ = false;
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  /// false: somebody else holds the flag.
  bool first() const { return first_; }

 private:
  std::atomic<bool>& flag_;
  const bool first_;
};

void addExtended(const Diagnosis& found, DiagnoseResponse& response) {
  const FittedModel& fit = *found.final_fit;
  response.extended_held_out_rmse = found.extended->held_out_rmse;
  response.extended_fit_percent = found.extended_fit_percent;
  response.damping_to_mass = fit.model.damping_to_mass;
  response.stiffness_to_mass = fit.model.stiffness_to_mass;
  auto stddev = fit.stddev.begin();
  for (const ModelNumber& number : numbersOf(fit.model)) {
    const double uncertainty = *stddev++;
    if (number.kind == ModelNumber::Kind::kCoefficient) {
      response.coefficient_names.push_back(number.name);
      response.coefficients.push_back(number.value);
      response.coefficient_stddevs.push_back(uncertainty);
    } else if (number.kind == ModelNumber::Kind::kShape) {
      response.shape_names.push_back(number.name);
      response.shapes.push_back(number.value);
    }
  }
}

/// diagnose() of one drive.
/// @throws std::runtime_error  in words for people, if the samples are too short or too poor.
Diagnosis searchEffects(const SearchTask& task) {
  Diagnosis found = diagnose({task.drive}, task.options);
  if (found) return found;
  const std::vector<CornerSample>& samples = task.drive.samples;
  const double span = samples.empty() ? 0.0 : toSeconds(samples.back().stamp - samples.front().stamp);
  throw std::runtime_error(formatted("the last %.3g s ", span) + found.reason + ": drive on");
}

/// The answer of ~diagnose: the whole result as plain fields.
DiagnoseResponse toResponse(const Diagnosis& found) {
  DiagnoseResponse response;
  response.success = true;
  response.message = found.remainder.empty() ? found.summary : found.summary + ' ' + found.remainder;
  response.verdict = nameOf(found.verdict);
  response.base_held_out_rmse = found.base.held_out_rmse;
  response.base_fit_percent = found.base_fit_percent;
  response.noise_floor = found.noise_floor;
  response.structured_share = found.structured_share;
  response.surface_share = found.surface_share;
  for (const RankedModel& ranked : found.ranking) {
    response.ranked_effects.push_back(join(ranked.effects, " + "));
    response.ranked_held_out_rmse.push_back(ranked.held_out_rmse);
    response.ranked_error_removed_percent.push_back(ranked.error_removed_percent);
    response.ranked_significant.push_back(ranked.significant);
  }
  response.selected = found.selected;
  for (const std::vector<std::string>& group : found.indistinguishable)
    response.indistinguishable.push_back(join(group));
  response.suggested_drive = found.suggested_drive;
  if (found.extended) addExtended(found, response);
  return response;
}

}  // namespace

DiagnoseService::DiagnoseService(const ros::NodeHandle& private_node, ros::CallbackQueueInterface& nodelet_queue,
                                 Nodelet nodelet)
    : nodelet_queue_(nodelet_queue), nodelet_(std::move(nodelet)), spinner_(kThreads, &queue_) {
  ros::NodeHandle node(private_node);
  node.setCallbackQueue(&queue_);
  server_ = node.advertiseService("diagnose", &DiagnoseService::onDiagnose, this);
  spinner_.start();
}

DiagnoseService::~DiagnoseService() {
  stopping_ = true;
  server_.shutdown();  // waits for calls that run, and they see stopping_
  spinner_.stop();
  nodelet_queue_.removeByID(owner());
}

bool DiagnoseService::onDiagnose(DiagnoseRequest& request, DiagnoseResponse& response) {
  const Running running(running_);
  if (!running.first()) {
    response.message = "a search is running already: call again when it has ended";
    return true;
  }
  try {
    response = answer(request.window);
  } catch (const Stopped&) {
    return false;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

DiagnoseResponse DiagnoseService::answer(double window) {
  // A low priority for this thread and those that it starts, so that on a busy machine the samples go first. If it
  // cannot be had, the search works all the same.
  setpriority(PRIO_PROCESS, 0, kNiceness);
  auto task = inNodelet<SearchTask>([give = nodelet_.give, window] { return give(window); });
  task.options.progress = [this](double) { stopIfAsked(); };
  const auto diagnosis = std::make_shared<const Diagnosis>(searchEffects(task));
  inNodelet<void>([take = nodelet_.take, diagnosis] { take(*diagnosis); });
  return toResponse(*diagnosis);
}

// The work owns all that it touches, as nobody may wait for it any more when it is done.
template <class Result>
Result DiagnoseService::inNodelet(std::function<Result()> work) {
  std::future<Result> result = addWork<Result>(nodelet_queue_, std::move(work), owner());
  while (result.wait_for(kPoll) != std::future_status::ready) stopIfAsked();
  return result.get();
}

void DiagnoseService::stopIfAsked() const {
  if (stopping_ || !ros::ok() || ros::isShuttingDown()) throw Stopped();
}

}  // namespace suspension_health_monitor
