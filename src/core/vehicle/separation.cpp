#include "suspension_health_monitor/internal/vehicle/separation.h"

#include <stdexcept>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/vehicle/decoupler.h"

namespace suspension_health_monitor {
namespace {

void requireOneGrid(const VehicleDrive& drive) {
  const auto& first = drive.struts.front().samples;
  for (const Drive& strut : drive.struts) {
    const auto same = [](const CornerSample& a, const CornerSample& b) { return a.stamp == b.stamp; };
    if (!std::equal(first.begin(), first.end(), strut.samples.begin(), strut.samples.end(), same))
      throw std::invalid_argument("the struts of a drive must have samples of the same stamps");
    strut.low_pass.validate(first.size());
    if (strut.low_pass.taps != drive.struts.front().low_pass.taps)
      throw std::invalid_argument("the struts of a drive must have passed the same filter");
  }
  for (const KnownForceRecord& force : drive.forces)
    if (force.values.size() != first.size())
      throw std::invalid_argument("force " + force.name + " has " + std::to_string(force.values.size()) +
                                  " values, must have one for each of " + std::to_string(first.size()) + " samples");
}

std::vector<double> columnOf(const Eigen::MatrixXd& matrix, std::size_t column) {
  const double* values = matrix.col(column).data();
  return {values, values + matrix.rows()};
}

}  // namespace

VehicleSample sampleOf(const VehicleDrive& drive, std::size_t k) {
  const std::size_t n = drive.struts.size();
  VehicleSample sample{drive.struts.front().samples[k].stamp, StrutVector(n), StrutVector(n),
                       ForceVector(drive.forces.size()),
                       StrutVector(drive.struts.front().low_pass.unfiltered.empty() ? 0 : n)};
  for (std::size_t i = 0; i < n; ++i) {
    const CornerSample& strut = drive.struts[i].samples[k];
    sample.sprung[i] = strut.sprung_acceleration;
    sample.unsprung[i] = strut.unsprung_acceleration;
    if (sample.unfiltered.size() > 0) sample.unfiltered[i] = drive.struts[i].low_pass.unfiltered[k];
  }
  for (Eigen::Index i = 0; i < sample.forces.size(); ++i) sample.forces[i] = drive.forces[i].values[k];
  return sample;
}

void append(const VehicleSample& sample, VehicleDrive& drive) {
  for (std::size_t i = 0; i < drive.struts.size(); ++i) {
    drive.struts[i].samples.push_back(sample.ofStrut(i));
    if (sample.unfiltered.size() > 0) drive.struts[i].low_pass.unfiltered.push_back(sample.unfiltered[i]);
  }
  for (std::size_t k = 0; k < drive.forces.size(); ++k) drive.forces[k].values.push_back(sample.forces[k]);
}

// Calls change() with every series that has a value for each sample.
template <class Change>
static void changeSeries(VehicleDrive& drive, const Change& change) {
  for (Drive& strut : drive.struts) {
    change(strut.samples);
    change(strut.low_pass.unfiltered);
  }
  for (KnownForceRecord& force : drive.forces) change(force.values);
}

void dropNewest(VehicleDrive& drive, std::size_t count) {
  changeSeries(drive, [&](auto& series) { dropNewest(series, count); });
}

void dropBefore(Stamp begin, VehicleDrive& drive) {
  const std::vector<CornerSample>& samples = drive.struts.front().samples;
  const auto first =
      std::find_if(samples.begin(), samples.end(), [&](const CornerSample& sample) { return sample.stamp >= begin; });
  const auto count = first - samples.begin();
  if (static_cast<std::size_t>(count) > samples.size() / 4) return;
  changeSeries(drive, [&](auto& series) {
    series.erase(series.begin(), series.begin() + std::min<std::ptrdiff_t>(count, series.size()));
  });
}

double periodOf(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                const std::optional<double>& given) {
  if (drives.empty()) throw std::invalid_argument("no drive is given, must be one or more");
  requireNumStruts(names.size());
  requireNumKnownForces(drives.front().forces.size());
  for (const VehicleDrive& drive : drives) {
    if (drive.struts.size() != names.size())
      throw std::invalid_argument("a drive of " + std::to_string(drive.struts.size()) + " struts, must be " +
                                  std::to_string(names.size()));
    if (!drive.places.empty() && drive.places.size() != names.size())
      throw std::invalid_argument("positions of " + std::to_string(drive.places.size()) + " struts, must be of " +
                                  std::to_string(names.size()) + " or none");
    if (namesOf(drive.forces) != namesOf(drives.front().forces))
      throw std::invalid_argument("a drive with the known forces [" + join(namesOf(drive.forces)) + "], must be [" +
                                  join(namesOf(drives.front().forces)) + "] as in the first");
    requireOneGrid(drive);
  }
  if (given) return *given;
  return medianPeriod(mapped(drives, [](const VehicleDrive& drive) { return drive.struts.front(); }));
}

VehicleCoupling describe(const BodyRows& rows, const std::optional<BodyFitResult>& body,
                         const std::vector<std::string>& forces) {
  VehicleCoupling coupling;
  coupling.ratios.assign(rows.size(), std::vector<double>(rows.size()));
  coupling.stddevs = coupling.ratios;
  for (Eigen::Index i = 0; i < rows.size(); ++i)
    for (Eigen::Index j = 0; j < rows.size(); ++j) {
      const Measured ratio = rows.ratio(i, j);
      coupling.ratios[i][j] = ratio.value;
      coupling.stddevs[i][j] = ratio.stddev;
    }
  for (std::size_t k = 0; k < forces.size(); ++k)
    coupling.forces.push_back({forces[k], columnOf(rows.force, k), columnOf(rows.force_stddev, k)});
  if (!body) return coupling;
  coupling.model_error = body->phi;
  const auto relative = [](const Measured& value) { return value.stddev / value.value; };
  for (std::size_t i = 0; i < body->b1.size(); ++i)
    coupling.strut_model_errors.push_back({relative(body->b1[i]), relative(body->b0[i])});
  for (const BodyFitResult::Bar& bar : body->found)
    coupling.bars.push_back({bar.struts.first, bar.struts.second, bar.stiffness[0].value, bar.stiffness[1].value});
  return coupling;
}

StrutDrives separateStruts(const VehicleDrive& drive, double period, const BodyRows& rows,
                           const std::vector<StrutModel>& models) {
  Decoupler decoupler(period, rows, models, drive.struts.front().low_pass.taps);
  VehicleDrive separated{StrutDrives(drive.struts.size())};
  for (std::size_t i = 0; i < drive.struts.size(); ++i)
    separated.struts[i].low_pass.taps = drive.struts[i].low_pass.taps;
  const auto& samples = drive.struts.front().samples;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k > 0 && continuity(samples[k].stamp - samples[k - 1].stamp, fromSeconds(period)) != Continuity::kContinues)
      decoupler.startNewSeries();
    if (const VehicleSample* own = decoupler.push(sampleOf(drive, k))) append(*own, separated);
  }
  return separated.struts;
}

// Known forces have none.
StrutDrives separateNoise(const SensorNoise& noise, double period, const BodyRows& rows) {
  VehicleDrive drive(makeNoiseDrive(noise, period));
  const std::vector<double> still(drive.struts.front().samples.size(), 0.0);
  drive.forces.assign(rows.force.cols(), {"", still});
  return separateStruts(drive, period, rows, rows.models());
}

}  // namespace suspension_health_monitor
