#include "suspension_health_monitor/internal/vehicle/vehicle_streams.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kSixAxes = 6;

}  // namespace

VehicleStreams::VehicleStreams(const VehicleLayout& layout) {
  std::size_t sensors = 0;
  const auto add = [&](std::size_t count) {
    options.insert(options.end(), count, StreamOptions{sensors++, true});
    return options.size() - count;
  };
  const bool needs_body = std::any_of(layout.struts.begin(), layout.struts.end(),
                                      [](const VehicleLayout::Strut& strut) { return !strut.sprung_imu; });
  if (needs_body) {
    if (!layout.body_imu) throw std::invalid_argument("body_imu is missing: a strut has no sprung_imu");
    channels.body_imu = add(kSixAxes);
    imus.push_back({*layout.body_imu, Place::kBody, *channels.body_imu, "body_imu"});
  }
  for (const VehicleLayout::Strut& strut : layout.struts) {
    const std::string where = "struts/" + strut.name;
    VehicleChannels::Strut its;
    if (strut.position) its.position = {(*strut.position)[0], (*strut.position)[1], (*strut.position)[2]};
    if (strut.sprung_imu) {
      its.sprung = add(1);
      imus.push_back({*strut.sprung_imu, Place::kSprung, *its.sprung, where + "/sprung_imu"});
    } else if (!strut.position) {
      throw std::invalid_argument(where + " has no position, and no sprung_imu");
    }
    its.unsprung = add(1);
    imus.push_back({strut.unsprung_imu, Place::kUnsprung, its.unsprung, where + "/unsprung_imu"});
    channels.struts.push_back(its);
  }
  for (std::size_t i = 0; i < layout.known_forces.size(); ++i) channels.known_forces.push_back(add(1));
}

}  // namespace suspension_health_monitor
