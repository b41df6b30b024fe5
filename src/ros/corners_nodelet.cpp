#include <nodelet/nodelet.h>

#include <pluginlib/class_list_macros.hpp>

namespace suspension_health_monitor {

/// Keeps launch files that load it running until the next version; VehicleNodelet does its work.
class CornersNodelet : public nodelet::Nodelet {
  void onInit() override {
    NODELET_WARN("CornersNodelet does nothing any more: VehicleNodelet compares the corners; do not load it");
  }
};

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::CornersNodelet, nodelet::Nodelet)
