#include "suspension_health_monitor/internal/vehicle/body_over_wheel.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

// Blocks that resolve 0.25 Hz, the slowest bounce there is, and reach to 20 Hz, beyond the wheel's hop.
constexpr double kLength = 8.0, kHighest = 20.0;  // [s], [Hz]
constexpr double kShake = 5.0;                    // [Hz]: above the bounce, below the hop

// Delays of the body's clock that are tried: the farthest that drivers make, in steps whose phase at the hop is small.
constexpr double kFarthestDelay = 0.04, kDelayStep = 0.004;  // [s]

using Index = Eigen::Index;

BlockBand bandOfCheck() {
  BlockBand band(kLength, kLength);
  band.last = static_cast<int>(kHighest * kLength);
  return band;
}

/// A regressor: a signal times a function of s.
struct Term {
  std::size_t imu;
  Eigen::ArrayXcd weight;
};

struct LinearFit {
  Eigen::VectorXd parameters;
  double left = 1.0;  ///< share of the output that is not explained
};

/// Least squares of one IMU's signal by terms with real parameters, in the frequency domain.
class SpectralFit {
 public:
  SpectralFit(const std::vector<Eigen::MatrixXcd>& spectra, const BlockBand& band) : spectra_(spectra) {
    s_.resize(static_cast<Index>(spectra.size()));
    for (Index k = 0; k < s_.size(); ++k) s_[k] = {0.0, band.omega(band.first + static_cast<int>(k))};
  }

  const Eigen::ArrayXcd& s() const { return s_; }

  /// @param bins  the first ones, that are used.
  LinearFit operator()(const Term& output, const std::vector<Term>& terms, Index bins) const {
    const auto n = static_cast<Index>(terms.size());
    const auto y = static_cast<Index>(output.imu);
    Eigen::ArrayXd power(bins);
    for (Index k = 0; k < bins; ++k) power[k] = at(k)(y, y).real();
    // Every bin counts by its share of the motion, those that are nearly silent by less.
    const Eigen::ArrayXd weight = (power + power.mean()).inverse();
    const auto product = [&](const Term& a, const Term& b) {
      double sum = 0.0;
      for (Index k = 0; k < bins; ++k)
        sum +=
            weight[k] *
            (std::conj(a.weight[k]) * b.weight[k] * at(k)(static_cast<Index>(b.imu), static_cast<Index>(a.imu))).real();
      return sum;
    };
    Eigen::MatrixXd normal(n, n);
    Eigen::VectorXd right(n);
    for (Index p = 0; p < n; ++p) {
      right[p] = product(terms[static_cast<std::size_t>(p)], output);
      for (Index q = 0; q <= p; ++q)
        normal(p, q) = normal(q, p) = product(terms[static_cast<std::size_t>(p)], terms[static_cast<std::size_t>(q)]);
    }
    const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    LinearFit fit;
    fit.parameters = scale.asDiagonal() * solveSymmetric(scale.asDiagonal() * normal * scale.asDiagonal(),
                                                         Eigen::MatrixXd(scale.cwiseProduct(right)));
    fit.left = 1.0 - fit.parameters.dot(right) / product(output, output);
    return fit;
  }

 private:
  const Eigen::MatrixXcd& at(Index k) const { return spectra_[static_cast<std::size_t>(k)]; }

  const std::vector<Eigen::MatrixXcd>& spectra_;
  Eigen::ArrayXcd s_;
};

/// What the wheels make of one IMU.
struct Response {
  std::vector<std::size_t> wheels;
  std::vector<double> damping;  // b1 of each wheel [1/s]
  std::vector<double> worth;    // share of the motion that is unexplained without it
  double explained = 0.0, delay = 0.0;
};

class Pairing {
 public:
  Pairing(const std::vector<Eigen::MatrixXcd>& spectra, const BlockBand& band, const std::vector<double>& rates)
      : fit_(spectra, band), band_(band), rates_(rates), shake_(rates.size(), 0.0) {
    for (std::size_t k = 0; k < spectra.size(); ++k)
      if (band.omega(band.first + static_cast<int>(k)) >= 2.0 * M_PI * kShake)
        for (std::size_t i = 0; i < shake_.size(); ++i)
          shake_[i] += spectra[k](static_cast<Index>(i), static_cast<Index>(i)).real();
  }

  std::size_t size() const { return rates_.size(); }
  /// An IMU that was silent shakes nothing, and is shaken by nothing.
  bool shakesMore(std::size_t wheel, std::size_t body) const {
    return shake_[body] > 0.0 && shake_[wheel] > kClearlyMore * shake_[body];
  }

  /// @return how an IMU moves over wheels.
  Response respond(std::size_t imu, const std::vector<std::size_t>& wheels) const {
    Response best{wheels, std::vector<double>(wheels.size()), std::vector<double>(wheels.size())};
    if (wheels.empty()) return best;
    double delay = 0.0;
    LinearFit nearest;
    for (double tried = -kFarthestDelay; tried < kFarthestDelay + kDelayStep / 2.0; tried += kDelayStep) {
      const LinearFit found = fit(imu, wheels, tried);
      if (found.left < nearest.left) nearest = found, delay = tried;
    }
    const double alone = fit(imu, {}, delay).left;
    best.explained = 1.0 - nearest.left / alone;
    best.delay = delay;
    for (std::size_t j = 0; j < wheels.size(); ++j) {
      best.damping[j] = nearest.parameters[static_cast<Index>(2 + 2 * j)];
      std::vector<std::size_t> others = wheels;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(j));
      best.worth[j] = (fit(imu, others, delay).left - nearest.left) / alone;
    }
    return best;
  }

  /// The slowest IMU ends the band.
  Index bins(std::size_t imu, const std::vector<std::size_t>& wheels) const {
    double rate = rates_[imu];
    for (const std::size_t wheel : wheels) rate = std::min(rate, rates_[wheel]);
    const int last = std::min(band_.last, static_cast<int>(kBlockTuning.usable * band_.length * rate));
    return std::max(1, last - band_.first + 1);
  }

 private:
  LinearFit fit(std::size_t imu, const std::vector<std::size_t>& wheels, double delay) const {
    const Eigen::ArrayXcd &s = fit_.s(), late = (s * delay).exp();
    std::vector<Term> terms{{imu, -late / s}, {imu, -late / s.square()}};
    for (const std::size_t wheel : wheels) {
      terms.push_back({wheel, s.inverse()});
      terms.push_back({wheel, s.square().inverse()});
    }
    return fit_({imu, late}, terms, bins(imu, wheels));
  }

  SpectralFit fit_;
  BlockBand band_;
  std::vector<double> rates_;
  std::vector<double> shake_;  // power above kShake
};

/// @return the responses of bodies; nothing of the other IMUs.
std::vector<std::optional<Response>> findBodies(const Pairing& pairing) {
  std::vector<std::optional<Response>> found(pairing.size());
  const auto respond = [&](std::size_t imu, bool to_wheels_alone) {
    std::vector<std::size_t> wheels;
    for (std::size_t j = 0; j < pairing.size(); ++j)
      if (pairing.shakesMore(j, imu) && !(to_wheels_alone && found[j])) wheels.push_back(j);
    std::optional<Response> response = pairing.respond(imu, wheels);
    if (!(response->explained > kMajority)) response.reset();
    return response;
  };
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = respond(i, false);
  auto bodies = found;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i]) bodies[i] = respond(i, true);
  return bodies;
}

/// @return b1 of each wheel (columns) on each body (rows), where it is worth having, else 0 [1/s].
Eigen::MatrixXd pushOf(const std::vector<std::optional<Response>>& bodies) {
  const auto imus = static_cast<Index>(bodies.size());
  Eigen::MatrixXd push = Eigen::MatrixXd::Zero(imus, imus);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i]) continue;
    for (std::size_t j = 0; j < bodies[i]->wheels.size(); ++j)
      if (bodies[i]->worth[j] > kWorthHaving)
        push(static_cast<Index>(i), static_cast<Index>(bodies[i]->wheels[j])) = bodies[i]->damping[j];
  }
  return push;
}

/// Fits b1 and b0 of a strut to the motion of its own top by the travel of all struts.
/// @return false: it is no damped spring.
bool describeStrut(const std::vector<Eigen::MatrixXcd>& spectra, const BlockBand& band,
                   const std::vector<BodyOverWheel>& pairs, const Pairing& pairing, BodyOverWheel& pair) {
  const Index imus = spectra.front().rows(), struts = static_cast<Index>(pairs.size());
  Eigen::MatrixXd signals = Eigen::MatrixXd::Identity(imus + struts, imus);  // the IMUs, then w'' - z'' of every strut
  for (Index j = 0; j < struts; ++j) {
    const BodyOverWheel& each = pairs[static_cast<std::size_t>(j)];
    signals(imus + j, static_cast<Index>(each.wheel)) = each.is_reversed ? -1.0 : 1.0;
    signals(imus + j, static_cast<Index>(each.body)) = -1.0;
  }
  std::vector<Eigen::MatrixXcd> all;
  for (const Eigen::MatrixXcd& each : spectra) all.emplace_back(signals * each * signals.transpose());
  const SpectralFit fit(all, band);
  const Eigen::ArrayXcd &s = fit.s(), late = (s * pair.delay).exp();
  std::vector<Term> terms{{pair.body, -s * late}};
  Index own = 0;
  std::vector<std::size_t> wheels;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j].wheel == pair.wheel) own = static_cast<Index>(terms.size());
    wheels.push_back(pairs[j].wheel);
    terms.push_back({static_cast<std::size_t>(imus) + j, s.inverse()});
    terms.push_back({static_cast<std::size_t>(imus) + j, s.square().inverse()});
  }
  const LinearFit found = fit({pair.body, late}, terms, pairing.bins(pair.body, wheels));
  pair.delay += found.parameters[0];
  pair.damping_to_mass = found.parameters[own];
  pair.stiffness_to_mass = found.parameters[own + 1];
  pair.explained = 1.0 - found.left;
  return pair.damping_to_mass > 0.0 && pair.stiffness_to_mass > 0.0;
}

}  // namespace

ImuSpectra::ImuSpectra(std::size_t imus)
    : band_(bandOfCheck()),
      modulation_(band_),
      streams_(imus, {FourierIntegrals(band_, 3)}),
      sums_(static_cast<std::size_t>(band_.size()),
            Eigen::MatrixXcd::Zero(static_cast<Index>(3 * imus), static_cast<Index>(3 * imus))),
      counts_(Eigen::MatrixXd::Zero(static_cast<Index>(imus), static_cast<Index>(imus))) {}

void ImuSpectra::push(std::size_t imu, Stamp stamp, const Eigen::Vector3d& acceleration) {
  Stream& stream = streams_[imu];
  if (!origin_) origin_ = stamp;
  if ((stream.last && stamp <= *stream.last) || stamp < *origin_ || !acceleration.allFinite()) return;
  stream.last = stamp;
  stream.integrals.push(toSeconds(stamp - *origin_), acceleration.data());
  long slowest = stream.integrals.openHalf(), fastest = 0;
  for (const Stream& each : streams_) {
    slowest = std::min(slowest, each.integrals.openHalf());
    fastest = std::max(fastest, each.integrals.openHalf());
  }
  // An IMU that is silent holds the others up only as long as their half blocks are kept.
  takeBlocks(std::max(slowest, fastest - FourierIntegrals::kHalves + 2));
}

void ImuSpectra::restart() {
  long end = 0;
  for (const Stream& each : streams_) end = std::max(end, each.integrals.openHalf());
  takeBlocks(end);
  for (Stream& each : streams_) {
    each.integrals.restart();
    each.last.reset();
  }
  origin_.reset();
  next_half_ = 1;
}

void ImuSpectra::takeBlocks(long end) {
  // After a pause the half blocks of the time before are gone.
  next_half_ = std::max(next_half_, end - FourierIntegrals::kHalves);
  for (; next_half_ < end; ++next_half_) {
    const auto imus = static_cast<Index>(streams_.size());
    Eigen::MatrixXcd values = Eigen::MatrixXcd::Zero(band_.size(), 3 * imus);
    Eigen::VectorXd is_there = Eigen::VectorXd::Zero(imus);
    Eigen::ArrayXcd integrals(band_.spectrumSize()), bins(band_.size());
    for (Index i = 0; i < imus; ++i) {
      const FourierIntegrals& stream = streams_[static_cast<std::size_t>(i)].integrals;
      if (stream.half(next_half_) == nullptr || stream.half(next_half_ - 1) == nullptr) continue;
      is_there[i] = 1.0;
      for (Index axis = 0; axis < 3; ++axis) {
        stream.sumHalves(next_half_, axis, integrals);
        modulation_.apply(0, integrals, bins);
        values.col(3 * i + axis) = bins.matrix();
      }
    }
    counts_ += is_there * is_there.transpose();
    for (Index k = 0; k < values.rows(); ++k)
      sums_[static_cast<std::size_t>(k)] += values.row(k).transpose() * values.row(k).conjugate();
  }
}

double ImuSpectra::rms(std::size_t imu, const Eigen::Vector3d& direction, double from_hz, double to_hz) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const double frequency = (band_.first + static_cast<int>(k)) / band_.length;
    if (frequency < from_hz || frequency >= to_hz) continue;
    const auto own = sums_[k].block<3, 3>(static_cast<Index>(3 * imu), static_cast<Index>(3 * imu));
    sum += direction.dot(own.real() * direction);
  }
  // By Parseval under Hann's window, as WindowEstimate::setMotion().
  return std::sqrt(2.0 * sum / std::max(1.0, blocks(imu)) / 0.375) / band_.length;
}

std::vector<Eigen::MatrixXcd> ImuSpectra::along(const std::vector<Eigen::Vector3d>& up) const {
  const auto imus = static_cast<Index>(streams_.size());
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(imus, 3 * imus);
  for (Index i = 0; i < imus; ++i) directions.block<1, 3>(i, 3 * i) = up[static_cast<std::size_t>(i)].transpose();
  std::vector<Eigen::MatrixXcd> result;
  for (const Eigen::MatrixXcd& sum : sums_) {
    result.emplace_back(directions * sum * directions.transpose());
    result.back().array() /= counts_.cwiseMax(1.0).array();
  }
  return result;
}

std::vector<BodyOverWheel> findBodiesOverWheels(const std::vector<Eigen::MatrixXcd>& spectra, const BlockBand& band,
                                                const std::vector<double>& rates,
                                                const std::vector<bool>& may_serve_several) {
  const Pairing pairing(spectra, band, rates);
  const std::vector<std::optional<Response>> bodies = findBodies(pairing);
  const Eigen::MatrixXd push = pushOf(bodies);
  const Eigen::RowVectorXd hardest = push.cwiseAbs().colwise().maxCoeff();
  std::vector<BodyOverWheel> pairs;
  std::vector<std::size_t> served(rates.size(), 0);
  for (Index wheel = 0; wheel < push.cols(); ++wheel) {
    std::optional<BodyOverWheel> best;
    for (Index body = 0; body < push.rows(); ++body) {
      const double here = push(body, wheel);
      if (here == 0.0 || (best && std::abs(here) <= std::abs(push(static_cast<Index>(best->body), wheel)))) continue;
      // An IMU that serves one wheel alone is pushed by it as no other is.
      const Eigen::RowVectorXd share = push.row(body).cwiseAbs().array() / hardest.array().max(1e-300);
      const auto place = static_cast<std::size_t>(body);
      if (!may_serve_several[place] && share[wheel] < share.maxCoeff()) continue;
      best = BodyOverWheel{place,
                           static_cast<std::size_t>(wheel),
                           here < 0.0,
                           true,
                           bodies[place]->explained,
                           0.0,
                           0.0,
                           bodies[place]->delay};
    }
    if (!best) continue;
    pairs.push_back(*best);
    ++served[best->body];
  }
  const std::vector<BodyOverWheel> all = pairs;
  pairs.clear();
  for (BodyOverWheel pair : all) {
    pair.is_own = served[pair.body] == 1;
    if (!pair.is_own || describeStrut(spectra, band, all, pairing, pair)) pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace suspension_health_monitor
