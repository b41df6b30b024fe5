#include "suspension_health_monitor/internal/vehicle/body_over_wheel.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

// What leaks into the lowest bins would count most, since it is integrated twice: fits begin at 0.5 Hz.
constexpr Eigen::Index kSkipped = 2;  // bins
constexpr double kShake = 5.0;        // [Hz]: above the bounce, below the hop

// Delays of the body's clock that are tried: the farthest that drivers make, in steps whose phase at the hop is small.
constexpr double kFarthestDelay = 0.04, kDelayStep = 0.004;  // [s]

using Index = Eigen::Index;

constexpr double kTiny = 1e-300;  // instead of dividing by 0

/// A regressor: a signal times a function of s.
struct Term {
  std::size_t signal;
  Eigen::ArrayXcd weight;
};

struct LinearFit {
  Eigen::VectorXd parameters;
  double unexplained = 1.0;  ///< share of the output that is not explained
};

/// Least squares of one IMU's signal by terms with real parameters, in the frequency domain.
/// @param spectra  by bin.  @param bins  the first ones, that are used.
LinearFit fitSignal(const std::vector<Eigen::MatrixXcd>& spectra, const Term& output, const std::vector<Term>& terms,
                    Index bins) {
  const std::size_t n = terms.size();
  Eigen::ArrayXd power(bins);
  for (Index k = 0; k < bins; ++k) power[k] = spectra[k](output.signal, output.signal).real();
  // Every bin counts by its share of the motion, those that are nearly silent by less.
  const Eigen::ArrayXd weight = (power + power.mean()).inverse();
  const auto product = [&](const Term& a, const Term& b) {
    double sum = 0.0;
    for (Index k = kSkipped; k < bins; ++k)
      sum += weight[k] * (std::conj(a.weight[k]) * b.weight[k] * spectra[k](b.signal, a.signal)).real();
    return sum;
  };
  Eigen::MatrixXd normal(n, n);
  Eigen::VectorXd right(n);
  for (std::size_t p = 0; p < n; ++p) {
    right[p] = product(terms[p], output);
    for (std::size_t q = 0; q <= p; ++q) normal(p, q) = normal(q, p) = product(terms[p], terms[q]);
  }
  const Eigen::VectorXd scale = normal.diagonal().cwiseMax(kTiny).cwiseSqrt().cwiseInverse();
  LinearFit fit;
  fit.parameters = scale.asDiagonal() * solveSymmetric(scale.asDiagonal() * normal * scale.asDiagonal(),
                                                       Eigen::MatrixXd(scale.cwiseProduct(right)));
  fit.unexplained = 1.0 - fit.parameters.dot(right) / product(output, output);
  return fit;
}

/// What the wheels make of one signal.
struct Response {
  // By IMU, 0 if it is no wheel:
  Eigen::ArrayXd damping;  // b1 [1/s]
  Eigen::ArrayXd worth;    // share of the motion that is unexplained without it
  double explained = 0.0, delay = 0.0;
};

/// The slowest IMU ends the band.
Index binsOf(const ImuSignals& signals, std::size_t signal, const std::vector<std::size_t>& wheels) {
  double rate = signals.rates[signals.owners[signal]];
  for (const std::size_t wheel : wheels) rate = std::min(rate, signals.rates[wheel]);
  const int last = std::min(signals.band.last, static_cast<int>(kBlockTuning.usable * signals.band.length * rate));
  return std::max(1, last - signals.band.first + 1);
}

LinearFit fitWheels(const ImuSignals& signals, std::size_t signal, const std::vector<std::size_t>& wheels,
                    double delay) {
  const Eigen::ArrayXcd &s = signals.s, late = (s * delay).exp();
  std::vector<Term> terms{{signal, -late / s}, {signal, -late / s.square()}};
  for (const std::size_t wheel : wheels) {
    terms.push_back({wheel, s.inverse()});
    terms.push_back({wheel, s.square().inverse()});
  }
  return fitSignal(signals.spectra, {signal, late}, terms, binsOf(signals, signal, wheels));
}

/// @return how a signal moves over wheels.
Response respond(const ImuSignals& signals, std::size_t signal, const std::vector<std::size_t>& wheels) {
  Response best{Eigen::ArrayXd::Zero(signals.imus()), Eigen::ArrayXd::Zero(signals.imus())};
  if (wheels.empty()) return best;
  LinearFit nearest;
  for (double tried = -kFarthestDelay; tried < kFarthestDelay + kDelayStep / 2.0; tried += kDelayStep) {
    const LinearFit found = fitWheels(signals, signal, wheels, tried);
    if (!(found.unexplained < nearest.unexplained)) continue;
    nearest = found;
    best.delay = tried;
  }
  if (nearest.parameters.size() == 0) return best;  // a signal that is 0
  const double alone = fitWheels(signals, signal, {}, best.delay).unexplained;
  best.explained = 1.0 - nearest.unexplained / alone;
  for (std::size_t j = 0; j < wheels.size(); ++j) {
    best.damping[wheels[j]] = nearest.parameters[2 + 2 * j];
    std::vector<std::size_t> others = wheels;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(j));
    best.worth[wheels[j]] = (fitWheels(signals, signal, others, best.delay).unexplained - nearest.unexplained) / alone;
  }
  return best;
}

/// @return the responses of the signals of bodies; nothing of the others.
std::vector<std::optional<Response>> findBodies(const ImuSignals& signals) {
  std::vector<double> shake(signals.imus(), 0.0);  // power above kShake
  for (std::size_t k = 0; k < signals.spectra.size(); ++k)
    if (signals.s[k].imag() >= 2.0 * M_PI * kShake)
      for (std::size_t i = 0; i < shake.size(); ++i) shake[i] += signals.spectra[k](i, i).real();
  std::vector<std::optional<Response>> found(signals.owners.size());
  const auto respond_to = [&](std::size_t signal, bool to_wheels_alone) {
    // An IMU that was silent shakes nothing, and is shaken by nothing.
    const double own = shake[signals.owners[signal]];
    std::vector<std::size_t> wheels;
    for (std::size_t j = 0; j < shake.size(); ++j)
      if (own > 0.0 && shake[j] > kClearlyMore * own && !(to_wheels_alone && found[j])) wheels.push_back(j);
    std::optional<Response> response = respond(signals, signal, wheels);
    if (!(response->explained > kMajority)) response.reset();
    return response;
  };
  for (std::size_t i = 0; i < signals.imus(); ++i) found[i] = respond_to(i, false);
  auto bodies = found;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (found[signals.owners[i]]) bodies[i] = respond_to(i, true);
  return bodies;
}

/// @return the signal of the body over a wheel: of the IMUs the one that it pushes hardest, as far as wheels explain
/// what that reads; else one that it turns.
std::optional<std::size_t> bodyOver(std::size_t wheel, const Eigen::MatrixXd& push, const ImuSignals& signals,
                                    const std::vector<std::optional<Response>>& bodies) {
  const auto may_serve_several = [&](std::size_t body) {
    return std::count(signals.owners.begin(), signals.owners.end(), body) > 1;
  };
  const Eigen::ArrayXXd size = push.topRows(signals.imus()).cwiseAbs();
  const Eigen::ArrayXXd share = size.rowwise() / size.colwise().maxCoeff().max(kTiny);
  std::optional<std::size_t> best;
  double hardest = 0.0;
  for (std::size_t body = 0; body < signals.imus(); ++body) {
    if (size(body, wheel) == 0.0) continue;
    // An IMU that serves one wheel alone is that wheel's more than any other's.
    std::size_t its_own = 0;
    share.row(body).maxCoeff(&its_own);
    const double here = bodies[body]->explained * size(body, wheel);
    if (!(here > hardest && (its_own == wheel || may_serve_several(body)))) continue;
    best = body;
    hardest = here;
  }
  for (std::size_t turn = signals.imus(); turn < bodies.size() && !best; ++turn)
    if (push(turn, wheel) != 0.0) best = turn;
  return best;
}

/// Fits b1 and b0 of a strut to the motion of its own top by the travel of all struts.
/// @return false: it is no damped spring.
bool describeStrut(const std::vector<BodyOverWheel>& pairs, const ImuSignals& given, BodyOverWheel& pair) {
  const std::size_t imus = given.owners.size();
  // The IMUs, then w'' - z'' of every strut.
  Eigen::MatrixXcd signals = Eigen::MatrixXcd::Identity(imus + pairs.size(), imus);
  std::vector<Eigen::MatrixXcd> all;
  for (const Eigen::MatrixXcd& each : given.spectra) {
    const std::complex<double> s = given.s[all.size()];
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      signals(imus + j, pairs[j].wheel) = pairs[j].is_reversed ? -1.0 : 1.0;
      signals(imus + j, pairs[j].body) = -std::exp(s * pairs[j].delay);
    }
    all.emplace_back(signals * each * signals.adjoint());
  }
  const Eigen::ArrayXcd &s = given.s, late = (s * pair.delay).exp();
  std::vector<Term> terms{{pair.body, -s * late}};
  std::size_t own = 0;
  std::vector<std::size_t> wheels;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j].wheel == pair.wheel) own = terms.size();
    wheels.push_back(pairs[j].wheel);
    terms.push_back({imus + j, s.inverse()});
    terms.push_back({imus + j, s.square().inverse()});
  }
  const LinearFit found = fitSignal(all, {pair.body, late}, terms, binsOf(given, pair.body, wheels));
  pair.delay += found.parameters[0];
  pair.damping_to_mass = found.parameters[own];
  pair.stiffness_to_mass = found.parameters[own + 1];
  pair.explained = 1.0 - found.unexplained;
  return pair.damping_to_mass > 0.0 && pair.stiffness_to_mass > 0.0;
}

}  // namespace

std::vector<BodyOverWheel> findBodiesOverWheels(const ImuSignals& signals) {
  const std::vector<std::optional<Response>> bodies = findBodies(signals);
  // b1 of each wheel (columns) in each signal (rows), where it is worth having, else 0 [1/s].
  Eigen::MatrixXd push = Eigen::MatrixXd::Zero(bodies.size(), signals.imus());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i]) push.row(i) = (bodies[i]->worth > kWorthHaving).select(bodies[i]->damping, 0.0).matrix().transpose();
  std::vector<BodyOverWheel> all, pairs;
  std::vector<std::size_t> served(signals.imus(), 0);
  for (std::size_t wheel = 0; wheel < signals.imus(); ++wheel) {
    const std::optional<std::size_t> signal = bodyOver(wheel, push, signals, bodies);
    if (!signal) continue;
    const std::size_t body = signals.owners[*signal];
    if (!bodies[body]) continue;  // a wheel that turns a body whose motion up no wheel explains
    // Of a wheel that was found by how it turns the body, too: which way it pushes is known better than how hard.
    const bool is_reversed = bodies[body]->damping[wheel] < 0.0;
    all.push_back({body, wheel, is_reversed, true, bodies[body]->explained, 0.0, 0.0, bodies[body]->delay});
    ++served[body];
  }
  for (BodyOverWheel pair : all) {
    pair.is_own = served[pair.body] == 1;
    if (!pair.is_own || describeStrut(all, signals, pair)) pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace suspension_health_monitor
