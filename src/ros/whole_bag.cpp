#include "whole_bag.h"

#include <vector>

namespace suspension_health_monitor {

WholeBag::WholeBag(const std::string& path) : path_(path), file_(path), bag_(std::make_unique<rosbag::Bag>()) {
  orFail([&] {
    bag_->open(file_.temporaryPath(), rosbag::bagmode::Write);
    bag_->setCompression(rosbag::compression::LZ4);
  });
}

WholeBag::~WholeBag() {
  try {
    if (bag_) bag_->close();
  } catch (const rosbag::BagException&) {
    abandon();
  }
}

void WholeBag::commit() {
  orFail([&] { bag_->close(); });
  bag_.reset();
  file_.commit();
}

// The destructor of a bag that could not be written would try once more, throw, and so end the program: it is never
// called. The list keeps the memory reachable, so that it is no leak to the sanitizers.
void WholeBag::abandon() {
  static auto* const abandoned = new std::vector<const rosbag::Bag*>;
  abandoned->push_back(bag_.release());
}

}  // namespace suspension_health_monitor
