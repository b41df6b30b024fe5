#include "vehicle_search.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "strut_search.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

/// diagnoseVehicle() of one drive.
/// @throws std::runtime_error  in words for people, if the samples do not tell the struts apart.
VehicleDiagnosis searchEffects(const VehicleSearchTask& task) {
  VehicleDiagnosis found = diagnoseVehicle({task.drive}, task.struts, {task.options});
  if (found) return found;
  const std::vector<CornerSample>& samples = task.drive.struts.front().samples;
  throw std::runtime_error(formatted("the last %.3g s ", toSeconds(samples.back().stamp - samples.front().stamp)) +
                           found.coupling.reason);
}

DiagnoseVehicleResponse toResponse(const VehicleDiagnosis& found, const std::vector<std::string>& struts) {
  DiagnoseVehicleResponse response;
  response.success = true;
  response.message = found.summary;
  response.verdict = nameOf(found.verdict);
  response.strut = struts;
  for (std::size_t i = 0; i < found.struts.size(); ++i) {
    const Diagnosis& strut = found.struts[i];
    response.verdicts.emplace_back(strut ? nameOf(found.verdictOn(i)) : "");
    response.selected.push_back(join(found.selected(i), ", "));
    response.summaries.push_back(strut ? strut.summary : "The drives " + strut.reason + ".");
  }
  return response;
}

/// @throws std::runtime_error  in words for people, if there is nothing to be said of this strut.
DiagnoseResponse answerFor(const VehicleDiagnosis& found, std::size_t strut) {
  const Diagnosis& its = found.struts[strut];
  if (!its) throw std::runtime_error("the drives " + its.reason + ": drive on");
  DiagnoseResponse response = toResponse(its);
  response.verdict = nameOf(found.verdictOn(strut));
  response.selected = found.selected(strut);
  return response;
}

}  // namespace

DiagnoseService<DiagnoseVehicle>::Search searchOf(VehicleSearchTask task,
                                                  std::function<void(const VehicleDiagnosis&)> take) {
  return [task = std::move(task), take = std::move(take)](const SearchProgress& progress) mutable {
    task.options.progress = progress;
    const auto found = std::make_shared<const VehicleDiagnosis>(searchEffects(task));
    return DiagnoseService<DiagnoseVehicle>::Outcome{toResponse(*found, task.struts), [take, found] { take(*found); }};
  };
}

DiagnoseService<Diagnose>::Search searchOf(VehicleSearchTask task, std::size_t strut,
                                           std::function<void(const VehicleDiagnosis&)> take) {
  return [task = std::move(task), strut, take = std::move(take)](const SearchProgress& progress) mutable {
    task.options.progress = progress;
    const auto found = std::make_shared<const VehicleDiagnosis>(searchEffects(task));
    return DiagnoseService<Diagnose>::Outcome{answerFor(*found, strut), [take, found] { take(*found); }};
  };
}

}  // namespace suspension_health_monitor
