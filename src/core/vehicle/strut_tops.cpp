#include "suspension_health_monitor/internal/vehicle/strut_tops.h"

#include <cmath>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

using Strut = VehicleChannels::Strut;

// Of the body: its acceleration upward and the products of angular rates, then the rates to differentiate.
constexpr std::size_t kBodySignals = 4, kBodyRates = 2;

}  // namespace

StrutTops::StrutTops(Stamp period, const VehicleChannels& channels) : channels_(channels) {
  const std::size_t struts = channels_.struts.size(), own = struts - channels_.numTopsOfBody();
  const bool needs_body = own < struts;
  if (needs_body && !channels_.body_imu)
    throw std::invalid_argument("a strut without a sprung stream of its own needs the body's IMU");
  for (const Strut& strut : channels_.struts)
    if (!strut.sprung && !strut.position)
      throw std::invalid_argument("a strut without a sprung stream of its own needs a position");
  requireNumStruts(struts);
  requireNumKnownForces(channels_.known_forces.size());
  const std::size_t measured = struts + own + channels_.known_forces.size();
  signals_.reserve(measured + kBodySignals + kBodyRates);
  if (needs_body) filter_.emplace(period, measured + kBodySignals, kBodyRates);
  const StrutVector none = StrutVector::Zero(struts);
  sample_ = {{}, none, none, ForceVector::Zero(channels_.known_forces.size()), filter_ ? none : StrutVector()};
}

const VehicleSample* StrutTops::push(const GridInstant& instant) {
  collect(instant);
  if (!filter_) {
    sample_.stamp = instant.stamp;
    if (channels_.road)
      sample_.road = instant.measured[*channels_.road] ? instant.values[*channels_.road] : std::nan("");
    spread(signals_, {});
    return &sample_;
  }
  const MotionFilter::Instant* filtered = filter_->push(instant.stamp, signals_);
  if (filtered == nullptr) return nullptr;
  sample_.stamp = filtered->stamp;
  spread(filtered->values, filtered->rates);
  auto wheel = filtered->unfiltered.begin();
  for (std::size_t i = 0; i < channels_.struts.size(); ++i) {
    sample_.unfiltered[i] = *wheel;
    wheel += channels_.struts[i].sprung ? 2 : 1;
  }
  return &sample_;
}

void StrutTops::collect(const GridInstant& instant) {
  signals_.clear();
  for (const Strut& strut : channels_.struts) {
    signals_.push_back(instant.values[strut.unsprung]);
    if (strut.sprung) signals_.push_back(instant.values[*strut.sprung]);
  }
  for (const std::size_t force : channels_.known_forces) signals_.push_back(instant.values[force]);
  if (!filter_) return;
  const double* imu = &instant.values[*channels_.body_imu];
  const Eigen::Vector3d acceleration = channels_.body_mount * Eigen::Map<const Eigen::Vector3d>(imu);
  const Eigen::Vector3d rate = channels_.body_mount * Eigen::Map<const Eigen::Vector3d>(imu + 3);
  for (const double signal : {acceleration.z(), rate.z() * rate.x(), rate.z() * rate.y(),
                              -rate.x() * rate.x() - rate.y() * rate.y(), rate.x(), rate.y()})
    signals_.push_back(signal);
}

void StrutTops::spread(const std::vector<double>& values, const std::vector<double>& rates) {
  auto next = values.begin();
  for (std::size_t i = 0; i < channels_.struts.size(); ++i) {
    sample_.unsprung[i] = *next++;
    if (channels_.struts[i].sprung) sample_.sprung[i] = *next++;
  }
  for (Eigen::Index k = 0; k < sample_.forces.size(); ++k) sample_.forces[k] = *next++;
  if (!filter_) return;
  const double upward = *next++;
  const Eigen::Vector3d products(next[0], next[1], next[2]);
  for (std::size_t i = 0; i < channels_.struts.size(); ++i) {
    if (channels_.struts[i].sprung) continue;
    const Eigen::Vector3d& r = *channels_.struts[i].position;
    sample_.sprung[i] = upward + rates[0] * r.y() - rates[1] * r.x() + products.dot(r);
  }
}

}  // namespace suspension_health_monitor
