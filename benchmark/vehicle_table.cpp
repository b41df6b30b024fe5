// Whole vehicles through the coupling: what doc/vehicle.md tells.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/vehicle.h"
#include "vehicle_drive.h"

namespace {

using namespace suspension_health_monitor;
using vehicle_drive::Record;
using vehicle_drive::Tracks;

/// Laws that are hidden, each as strong as `share` of the rms of the strut's force.
struct Hidden {
  const char* name;
  std::function<double(double, double)> shape;  // of travel and travel rate over their rms
};

const std::vector<Hidden> kHidden{
    {"cubic_stiffness", [](double d, double) { return d * d * d; }},
    {"coulomb_friction", [](double, double v) { return std::tanh(v / 0.005); }},
    {"quadratic_damping", [](double, double v) { return v * std::abs(v); }},
    {"asymmetric_damping", [](double, double v) { return std::max(v, 0.0); }},
    {"asymmetric_spring", [](double d, double) { return std::max(d, 0.0); }},
};

const char* wordOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kEffectFound: return "found";
    case Verdict::kSuspect: return "suspect";
    case Verdict::kNothingMissing: return "nothing";
    case Verdict::kUnexplained: return "unexplained";
  }
  return "";
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "linear";
  const unsigned seeds = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const std::vector<std::string> kinds =
      argc > 3 ? std::vector<std::string>{argv[3]} : std::vector<std::string>{"half", "sedan", "robot", "truck"};
  const unsigned first = argc > 4 ? static_cast<unsigned>(std::atoi(argv[4])) : 1;
  const double period = 0.01;
  for (const std::string& kind : kinds)
    for (unsigned seed = first; seed < first + seeds; ++seed) {
      const vehicle_drive::Vehicle vehicle = vehicle_drive::made(kind, seed);
      const std::size_t n = vehicle.struts.size();
      vehicle_drive::Drive options;
      options.seed = seed;
      options.tracks = seed % 2 ? Tracks::kCoherent : Tracks::kIndependent;
      if (what == "bar") options.anti_roll = 0.4 * vehicle.struts[0].stiffness;
      Record record = vehicle_drive::drive(vehicle, options);
      std::string hidden = "nothing";
      if (what == "effect") {
        const Hidden& law = kHidden[seed % kHidden.size()];
        const std::size_t at = seed % n;
        const double d = record.travel[at], v = record.travel_rate[at];
        // rms of the law's shape over a normal variable, by which it is scaled
        double square = 0.0;
        std::mt19937 random(7);
        std::normal_distribution<double> normal;
        for (int i = 0; i < 20000; ++i) {
          const double x = normal(random);
          square +=
              std::pow(std::string(law.name) == "coulomb_friction" ? std::tanh(x * v / 0.005) : law.shape(x, x), 2) /
              20000;
        }
        const double size = 0.15 * record.force[at] / std::sqrt(square);
        const bool friction = std::string(law.name) == "coulomb_friction";
        options.hidden.resize(n);
        options.hidden[at] = [=](double travel, double rate, double) {
          return size * (friction ? law.shape(travel, rate) : law.shape(travel / d, rate / v));
        };
        record = vehicle_drive::drive(vehicle, options);
        hidden = std::string(law.name) + " in strut " + std::to_string(at);
      }
      StrutDrives drive;
      std::vector<std::string> names;
      for (std::size_t i = 0; i < n; ++i) {
        drive.push_back(makeDrive(period, record.body[i], record.wheel[i]));
        names.push_back(std::to_string(i));
      }
      const SeparatedVehicle separated = separateVehicle({drive}, names);
      const auto begin = std::chrono::steady_clock::now();
      const VehicleDiagnosis diagnosis = diagnoseVehicle({drive}, names);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      std::printf("%s %u, hidden: %s. %s (%.1f s)\n", kind.c_str(), seed, hidden.c_str(), diagnosis.summary.c_str(),
                  seconds);
      for (const AntiRollBarFound& bar : diagnosis.coupling.bars)
        std::printf("   bar %zu-%zu: %+.1f %%, %+.1f %%\n", bar.first, bar.second,
                    100 * (bar.first_stiffness_to_mass / (vehicle.mobility(bar.first, bar.first) * options.anti_roll) - 1),
                    100 * (bar.second_stiffness_to_mass / (vehicle.mobility(bar.second, bar.second) * options.anti_roll) - 1));
      for (std::size_t i = 0; i < diagnosis.struts.size(); ++i) {
        const Diagnosis& found = diagnosis.struts[i];
        std::string selected;
        for (const std::string& name : found.selected) selected += " " + name;
        for (const auto& group : found.indistinguishable) {
          selected += " (or";
          for (const std::string& name : group) selected += " " + name;
          selected += ")";
        }
        IdentifyOptions how;
        const IdentifyResult result = identify(separated.struts[i], how);
        const auto percent = [](double value, double truth) { return 100 * (value / truth - 1); };
        std::printf(
            "   strut %zu: b1 %+.1f b0 %+.1f %%, iv %+.1f %+.1f, la %+.1f (%.1f) %+.1f (%.1f) %s%s, structured %.2f "
            "explained %.2f, rmse %.4f floor %.4f\n",
            i, percent(separated.models[i].damping_to_mass, vehicle.b1(i)),
            percent(separated.models[i].stiffness_to_mass, vehicle.b0(i)),
            percent(result.iv.damping_to_mass, vehicle.b1(i)), percent(result.iv.stiffness_to_mass, vehicle.b0(i)),
            percent(result.la.damping_to_mass, vehicle.b1(i)), 100 * result.la.damping_to_mass_stddev / vehicle.b1(i),
            percent(result.la.stiffness_to_mass, vehicle.b0(i)),
            100 * result.la.stiffness_to_mass_stddev / vehicle.b0(i), wordOf(found.verdict), selected.c_str(),
            found.structured_share, found.explained_share, found.base.held_out_rmse, found.noise_floor);
      }
      std::fflush(stdout);
    }
}
