#include "rivals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model_evaluator.h"
#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/fit/free_form.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kWindow = 4.0;  // natural periods

/// A function by points (x, y), in straight lines between them and on along the outermost ones.
using Polyline = std::vector<std::pair<double, double>>;

double at(const Polyline& points, double x) {
  if (points.empty()) return 0.0;
  const auto after = std::lower_bound(points.begin() + 1, points.end() - 1, x,
                                      [](const auto& point, double value) { return point.first < value; });
  const auto& [x0, y0] = *(after - 1);
  return y0 + (x - x0) / (after->first - x0) * (after->second - y0);
}

/// @return of every window ln of rms velocity over rms position of the wheel, and the time in its middle [s].
Polyline windowsOf(const Records& records, double stiffness_to_mass) {
  const double length_in_time = kWindow * 2.0 * M_PI / std::sqrt(stiffness_to_mass);
  Polyline windows;
  for (const DriveSegment* segment : segmentsOf(records)) {
    const MotionError wheel = motionError(segment->unsprung, 0.0, segment->period, stiffness_to_mass);
    const auto length = static_cast<std::size_t>(std::ceil(length_in_time / segment->period));
    for (std::size_t first = 0; first + length <= segment->size(); first += length) {
      double position = 0.0, velocity = 0.0;
      for (std::size_t k = first; k < first + length; ++k) {
        position += square(wheel.travel[k]);
        velocity += square(wheel.travel_rate[k]);
      }
      if (!(position > 0.0 && velocity > 0.0)) continue;
      windows.emplace_back(0.5 * std::log(velocity / position), segment->timeDriven(first + length / 2));
    }
  }
  return windows;
}

/// The time that a window's frequency tells, by its own time: by the windows whose frequencies are next to its own, one
/// below and one above, not by its own time. At the ends by the two next ones.
Polyline toldByFrequency(Polyline windows) {
  Polyline result;
  if (windows.size() < 3) return result;
  std::sort(windows.begin(), windows.end());
  const auto time = [&](std::size_t i) { return windows[i].second; };
  const auto last = windows.size() - 1;
  result.emplace_back(time(0), 2.0 * time(1) - time(2));
  for (std::size_t i = 1; i < last; ++i) result.emplace_back(time(i), (time(i - 1) + time(i + 1)) / 2.0);
  result.emplace_back(time(last), 2.0 * time(last - 1) - time(last - 2));
  std::sort(result.begin(), result.end());
  return result;
}

/// s of the last effect over time.
Polyline lastMemories(const ModelFit& fit, const Records& records) {
  Polyline points;
  std::vector<double> predicted;
  std::vector<StrutState> motion;
  const std::vector<const DriveSegment*> segments = segmentsOf(records);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!runFree(fit.model, *segments[s], fit.initial[s], predicted, &motion)) continue;
    for (std::size_t k = 0; k < motion.size(); ++k)
      points.emplace_back(segments[s]->timeDriven(k), motion[k].memory[fit.model.effects.size() - 1].s);
  }
  return points;
}

}  // namespace

bool mayBeTilt(const StrutModel& model, const std::string& fault, const Records& records) {
  const bool is_read = std::all_of(records.begin(), records.end(), [](const DriveRecord* record) {
    return record->gravity() > 0.5 * kStandardGravity;
  });
  const double lost_by_30_degrees = 1.0 - std::cos(M_PI / 6.0);
  const double unit = fault == "accelerometer_bias" ? kStandardGravity : fault == "scale_error" ? 1.0 : 0.0;
  return is_read && std::any_of(model.reading.begin(), model.reading.end(), [&](const ActiveMeasurementEffect& active) {
           return active.effect.name == fault && std::abs(active.coefficients.front()) < lost_by_30_degrees * unit;
         });
}

bool changesSlowly(const ActiveEffect& active) {
  if (active.effect.lasts) return true;
  const auto force = [&](double time) { return active.effect.force({1.0, 1.0, time, 0.5}, active.shapes.data()); };
  return force(0.0) != force(1.0) || force(1.0) != force(std::sqrt(2.0));
}

ForceEffect frequencyRival(const ModelFit& fit, const Records& records, double stiffness_to_mass) {
  const ActiveEffect& last = fit.model.effects.back();
  const ForceEffect& effect = last.effect;
  const Polyline told = toldByFrequency(windowsOf(records, stiffness_to_mass));
  ForceEffect rival = effect;
  if (effect.lasts) {
    rival.memory_rate = {};
    rival.lasts = false;
    rival.shapes.clear();
    rival.force = [told, law = effect.force, memory = lastMemories(fit, records), known = last.shapes](
                      const StrutMotion& motion, const double*) {
      StrutMotion there = motion;
      there.memory = at(memory, at(told, motion.time));
      return law(there, known.data());
    };
    return rival;
  }
  const auto instead = [told](const auto& law) {
    return [told, law](const StrutMotion& motion, const double* shapes) {
      StrutMotion there = motion;
      there.time = at(told, motion.time);
      return law(there, shapes);
    };
  };
  rival.force = instead(effect.force);
  if (effect.memory_rate) rival.memory_rate = instead(effect.memory_rate);
  return rival;
}

double wandering(const Residuals& residuals, double natural_period) {
  const auto length = static_cast<std::size_t>(std::max(1.0, std::ceil(natural_period)));
  const double mean = meanOf(residuals);
  double products = 0.0, count = 0.0;
  for (const std::vector<double>& segment : residuals) {
    double last = 0.0;
    for (std::size_t first = 0; first + length <= segment.size(); first += length) {
      double sum = 0.0;
      for (std::size_t k = first; k < first + length; ++k) sum += segment[k] - mean;
      if (first > 0) {
        products += last * sum;
        count += square(static_cast<double>(length));
      }
      last = sum;
    }
  }
  return products > 0.0 ? std::sqrt(products / count) : 0.0;
}

bool isWanderingOffset(const Residuals& before, const Residuals& after, double natural_period) {
  const double offset = meanOf(before) - meanOf(after);
  return square(offset) > kMostOfIt * (meanSquare(before) - meanSquare(after)) &&
         std::abs(offset) < normalQuantile(kSure) * wandering(after, natural_period);
}

double shareOfTurning(const Records& records, const HoldOut& held_out, const LinearResponse& motion) {
  const Eigen::Index count = motion.numSamples();
  Eigen::MatrixXd strut(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const StrutMotion& m = motion.motion()[static_cast<std::size_t>(k)];
    strut.row(k) << m.travel / motion.travel(), m.travel_rate / motion.travelRate(), m.body_acceleration;
  }
  const Eigen::VectorXd trained = joined(held_out.training);
  const Eigen::VectorXd judged = Eigen::VectorXd::Ones(count) - trained;
  const Eigen::MatrixXd weighted = trained.asDiagonal() * strut;
  double most = 0.0;
  for (const BodyChannel channel : {BodyChannel::kAngularAccelerationX, BodyChannel::kAngularAccelerationY}) {
    std::vector<std::vector<double>> measured;
    for (const DriveSegment* segment : segmentsOf(records))
      measured.push_back(segment->body[static_cast<std::size_t>(channel)]);
    const Eigen::VectorXd turning = joined(measured);
    if (turning.size() < count) continue;  // not measured in one of the drives
    const Eigen::Vector3d told = (strut.transpose() * weighted).ldlt().solve(weighted.transpose() * turning);
    const double whole = judged.dot(turning.cwiseAbs2());
    if (whole > 0.0) most = std::max(most, 1.0 - judged.dot((turning - strut * told).cwiseAbs2()) / whole);
  }
  return most;
}

namespace {

constexpr double kStraight = 0.005;  // of a reading: the nonlinearity of accelerometers

/// How the motion of a kind of drive compares with that of the present one.
struct MotionChange {
  DriveKind kind;
  double travel, travel_rate, time;
};

constexpr MotionChange kChanges[] = {
    {DriveKind::kMoreTravel, 2.0, 2.0, 1.0},   {DriveKind::kLessTravel, 1.0 / 3.0, 1.0 / 3.0, 1.0},
    {DriveKind::kSlower, 1.0, 1.0 / 3.0, 1.0}, {DriveKind::kQuicker, 1.0, 3.0, 1.0},
    {DriveKind::kLonger, 1.0, 1.0, 3.0},
};
constexpr double kHelps = 2.0;  // times as different as in the drives at hand

std::vector<StrutMotion> scaled(const std::vector<StrutMotion>& motion, const MotionChange& change) {
  std::vector<StrutMotion> result = motion;
  for (StrutMotion& m : result) {
    m.travel *= change.travel;
    m.travel_rate *= change.travel_rate;
    m.time *= change.time;
  }
  return result;
}

Eigen::VectorXd totalForce(const StrutModel& model, const std::vector<StrutMotion>& motion,
                           const LinearResponse& present) {
  const Eigen::MatrixXd forces = forcesAlong(model, motion, present.ends(), present.rests());
  Eigen::VectorXd total = model.damping_to_mass * forces.col(0) + model.stiffness_to_mass * forces.col(1);
  for (std::size_t j = 0; j < model.effects.size(); ++j)
    total += model.effects[j].coefficient * forces.col(2 + static_cast<Eigen::Index>(j));
  return total;
}

/// rms difference of the least different model from the first, as a share of the first one's force.
double difference(const LinearResponse& present, const std::vector<StrutModel>& models, const MotionChange& change) {
  const std::vector<StrutMotion> motion = scaled(present.motion(), change);
  const Eigen::VectorXd first = totalForce(models.front(), motion, present);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < models.size(); ++i)
    least = std::min(least, (totalForce(models[i], motion, present) - first).norm() / first.norm());
  return least;
}

}  // namespace

Selection select(const std::vector<EvaluatedModel>& ranking, const HoldOut& held_out) {
  const EvaluatedModel& best = ranking.front();
  Selection selection{best, {}, {}};
  for (const EvaluatedModel& rival : ranking) {
    if (!rival.ranked.fitted) continue;
    const bool simpler = complexity(rival.ranked.model) < complexity(best.ranked.model);
    const double chance = simpler ? kFalseAlarm / static_cast<double>(ranking.size()) : kSure;
    const PairedTest gain = rival.gainOf(best);
    const bool is_resolved = rival.loss - best.loss > square(kStraight) * held_out.measuredSquares();
    const bool is_worse = gain.removed_share > kWorthHaving || isSignificant(gain, chance);
    if (is_worse && is_resolved) continue;
    selection.group.push_back(rival.added);
    selection.models.push_back(rival.ranked.model);
    if (!is_worse && complexity(rival.ranked.model) < complexity(selection.chosen.ranked.model))
      selection.chosen = rival;
  }
  return selection;
}

SeparatingDrive separatingDrive(const LinearResponse& present, const Selection& selection) {
  const double here = difference(present, selection.models, {DriveKind::kNoneHelps, 1.0, 1.0, 1.0});
  SeparatingDrive best{selection.group, DriveKind::kNoneHelps, kHelps * here, here};
  for (const MotionChange& change : kChanges) {
    const double there = difference(present, selection.models, change);
    if (!(there > best.difference_there)) continue;
    best.kind = change.kind;
    best.difference_there = there;
  }
  return best;
}

}  // namespace suspension_health_monitor
