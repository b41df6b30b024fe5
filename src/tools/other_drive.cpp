#include "other_drive.h"

#include <cmath>

#include "command.h"
#include "curve_output.h"
#include "recorded_monitor.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/drive_sentences.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;
using nlohmann::json;

/// @return what read() returns; what it throws has the bag's name in front.
template <class Read>
auto naming(const std::string& name, const Read& read) {
  const std::string prefix = std::string("--") + kAgainst + ' ' + name + ": ";
  try {
    return prefixed(prefix, read);
  } catch (const InputError& error) {
    throw InputError(prefix + error.what());
  } catch (const TooLittleError& error) {
    throw TooLittleError(prefix + error.what());
  }
}

json toJson(const std::optional<double>& change, double stddev) {
  if (!change) return nullptr;
  const double half = kNinetyPercent * stddev, log = std::log1p(*change);
  return {{"change", *change}, {"interval", {std::expm1(log - half), std::expm1(log + half)}}};
}

json toJson(const CurveChange& curve) {
  json ranges = json::array();
  for (const CurveChange::Range& range : curve.ranges)
    ranges.push_back({{"from", range.from}, {"to", range.to}, {"softer", range.softer}});
  return ranges;
}

struct OtherDrive {
  std::string name;
  VehicleOptions settings;
  std::vector<IdentifyResult> struts;
  std::vector<StrutCurves> curves;  // by strut
};

OtherDrive readOther(const po::variables_map& values, const std::string& name) {
  const BagOptions options = readBagOptions(values);
  RecordedMonitor recorded(options, HealthyStruts(options.vehicle.names.size()), {});
  recorded.read();
  const std::vector<IdentifyResult> struts = recorded.identified().struts;
  return {name, options.settings, struts, curvesOfBags(options, struts)};
}

json against(const OtherDrive& other, std::size_t place, const IdentifyResult& now, const StrutCurves& curves) {
  json result{{"bag", other.name}};
  addCurves(other.curves[place], result);
  const std::optional<StrutOfDrive> today = strutOf(now), then = strutOf(other.struts[place]);
  if (!today || !then) {
    result["change"] =
        "cannot be compared with " + other.name + ": no valid estimate of " + (then ? "this drive" : "that drive");
    return result;
  }
  const DriveChange change = changeOf(today->strut, curves, then->strut, other.curves[place],
                                      other.settings.struts[place].monitor.payload_range);
  const StrutChange& strut = change.strut;
  result.update({{"change", describe(change, other.name)},
                 {"damping", toJson(strut.damping, strut.damping_stddev)},
                 {"stiffness", toJson(strut.stiffness, strut.stiffness_stddev)},
                 {"payload_change", strut.payload ? json(*strut.payload) : json()},
                 {"damper_differences", toJson(change.damper)},
                 {"spring_differences", toJson(change.spring)}});
  return result;
}

}  // namespace

std::vector<json> againstOther(po::variables_map values, const std::vector<IdentifyResult>& now,
                               const std::vector<StrutCurves>& curves) {
  std::vector<json> changes;
  if (values.count(kAgainst) == 0) return changes;
  const auto path = values[kAgainst].as<std::string>();
  values.at("bag").value() = std::vector<std::string>{path};
  const std::string name = fileNames({path}).front();
  const OtherDrive other = naming(name, [&] { return readOther(values, name); });
  for (std::size_t i = 0; i < now.size(); ++i) changes.push_back(against(other, i, now[i], curves[i]));
  return changes;
}

}  // namespace suspension_health_monitor
