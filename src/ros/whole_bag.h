#pragma once

#include <rosbag/bag.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "whole_file.h"

namespace suspension_health_monitor {

/// A bag that appears under its name whole or not at all, as WholeFile.
class WholeBag {
 public:
  /// @throws std::runtime_error  naming the file, if it cannot be written.
  explicit WholeBag(const std::string& path);
  ~WholeBag();

  /// @param time  under which the bag holds the message; a bag cannot hold time 0 and takes the next one.
  /// @throws std::runtime_error  naming the file, if the message cannot be written: then the bag is lost.
  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message) {
    orFail([&] { bag_->write(topic, std::max(time, ros::TIME_MIN), message); });
  }

  /// Puts the bag in place; nothing can be written after it.
  /// @throws std::runtime_error  naming the file, if it cannot be written to its end.
  void commit();

 private:
  template <class Work>
  void orFail(const Work& work) {
    if (!bag_) throw std::runtime_error(path_ + ": cannot be written: it is closed");
    try {
      work();
    } catch (const rosbag::BagException& error) {
      abandon();
      throw std::runtime_error(path_ + ": cannot be written: " + error.what());
    }
  }
  void abandon();

  std::string path_;
  WholeFile file_;
  std::unique_ptr<rosbag::Bag> bag_;
};

}  // namespace suspension_health_monitor
