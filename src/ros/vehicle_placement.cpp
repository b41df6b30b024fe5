#include "vehicle_placement.h"

#include <stdexcept>

#include "vehicle_sensors.h"

namespace suspension_health_monitor {
namespace {

VehicleStreams streamsAnywhere(VehicleLayout layout) {
  for (VehicleLayout::Strut& strut : layout.struts)
    if (strut.frame) strut.position.emplace();
  return VehicleStreams(layout);
}

}  // namespace

VehiclePlacement::VehiclePlacement(const VehicleLayout& layout) : layout_(layout), streams_(streamsAnywhere(layout)) {}

std::optional<VehicleStreams> VehiclePlacement::find(const ShellOptions& options, const tf2::BufferCore& transforms) {
  if (!streams_.channels.body_imu || !layout_.hasFrames()) return streams_;
  if (!body_message_) return std::nullopt;
  VehicleLayout placed = layout_;
  try {
    placeFrames(placed, *body_message_, options, transforms);
  } catch (const std::invalid_argument& error) {
    missing_ = error.what();
    return std::nullopt;
  }
  for (VehicleLayout::Strut& strut : placed.struts) strut.frame.reset();
  return VehicleStreams(placed);
}

}  // namespace suspension_health_monitor
