#include "live_search.h"

#include <sys/resource.h>

#include <stdexcept>

#include "conversions.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr std::uint32_t kThreads = 2;  // one for the search, one to refuse another call meanwhile
constexpr int kNiceness = 10;

/// Ends a search from within its progress report.
struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("the monitor is shutting down") {}
};

/// Every figure is NaN until there is one.
void takeFiguresOff(DiagnoseResponse& response) {
  response.base_held_out_rmse = response.base_fit_percent = response.noise_floor = kUnknown;
  response.structured_share = response.surface_share = kUnknown;
  response.extended_held_out_rmse = response.extended_fit_percent = kUnknown;
  response.damping_to_mass = response.stiffness_to_mass = kUnknown;
}
void takeFiguresOff(DiagnoseVehicleResponse&) {}  // it has none

/// @param lacks  what the samples lack.
/// @throws std::runtime_error  in words for people.
[[noreturn]] void tellLack(const VehicleDrive& drive, const std::string& lacks) {
  const std::vector<CornerSample>& samples = drive.struts.front().samples;
  throw std::runtime_error(formatted("the last %.3g s ", toSeconds(samples.back().stamp - samples.front().stamp)) +
                           lacks);
}

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

/// The answer about one strut: the whole result as plain fields.
/// @throws std::runtime_error  in words for people, if there is nothing to be said of it.
void setAnswer(const VehicleDiagnosis& all, const SearchTask& task, std::size_t strut, DiagnoseResponse& response) {
  const Diagnosis& found = all.struts[strut];
  if (!found) tellLack(task.drive, found.reason + ": drive on");
  takeFiguresOff(response);
  response.success = true;
  response.message = found.remainder.empty() ? found.summary : found.summary + ' ' + found.remainder;
  response.verdict = nameOf(all.verdictOn(strut));
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
  response.selected = all.selected(strut);
  for (const std::vector<std::string>& group : found.indistinguishable)
    response.indistinguishable.push_back(join(group));
  response.suggested_drive = found.suggested_drive;
  if (found.extended) addExtended(found, response);
}

/// The answer about all.
void setAnswer(const VehicleDiagnosis& found, const SearchTask& task, std::size_t, DiagnoseVehicleResponse& response) {
  response.success = true;
  response.message = found.summary;
  response.verdict = nameOf(found.verdict);
  response.strut = task.struts;
  for (std::size_t i = 0; i < found.struts.size(); ++i) {
    const Diagnosis& strut = found.struts[i];
    response.verdicts.emplace_back(strut ? nameOf(found.verdictOn(i)) : "");
    response.selected.push_back(join(found.selected(i), ", "));
    response.summaries.push_back(strut ? strut.summary : "The drives " + strut.reason + ".");
  }
}

}  // namespace

template <class Service>
DiagnoseService<Service>::DiagnoseService(const ros::NodeHandle& private_node, MonitorHost& host, std::size_t strut)
    : host_(host), thread_(host.thread()), strut_(strut), spinner_(kThreads, &queue_) {
  ros::NodeHandle node(private_node);
  node.setCallbackQueue(&queue_);
  server_ = node.advertiseService("diagnose", &DiagnoseService<Service>::onDiagnose, this);
  spinner_.start();
}

template <class Service>
bool DiagnoseService<Service>::onDiagnose(Request& request, Response& response) {
  const std::unique_lock<std::mutex> only_one(searching_, std::try_to_lock);
  takeFiguresOff(response);
  if (!only_one) {
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

template <class Service>
typename Service::Response DiagnoseService<Service>::answer(double window) {
  beNice();
  SearchTask task = thread_.run([&] { return host_.samplesFor(window); });
  task.options.progress = [this](double) { stopIfAsked(); };
  const VehicleDiagnosis found = diagnoseVehicle({task.drive}, task.struts, {task.options});
  if (!found) tellLack(task.drive, found.coupling.reason);
  Response response;
  setAnswer(found, task, strut_, response);
  stopIfAsked();
  thread_.run([&] { host_.takeDiagnosis(found); });
  return response;
}

template <class Service>
void DiagnoseService<Service>::stopIfAsked() const {
  if (stopping_ || !ros::ok() || ros::isShuttingDown()) throw Stopped();
}

template class DiagnoseService<Diagnose>;
template class DiagnoseService<DiagnoseVehicle>;

void beNice() { setpriority(PRIO_PROCESS, 0, kNiceness); }

}  // namespace suspension_health_monitor
