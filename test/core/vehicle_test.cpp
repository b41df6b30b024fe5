#include "suspension_health_monitor/vehicle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "suspension_health_monitor/effects.h"
#include "vehicle_drive.h"

namespace suspension_health_monitor {
namespace {

Vehicle quiet(const char* name) {
  Vehicle vehicle = namedVehicle(name);
  vehicle.iso_class = "B";
  return vehicle;
}

TEST(SeparatedVehicle, KnowsTheRatiosOfTheBodyAndTheOwnStrutOfEveryCorner) {
  for (const char* name : {"half_sedan", "sedan", "ugv", "truck"}) {
    const Vehicle vehicle = namedVehicle(name);
    const StrutDrives drive = strutDrives(vehicle, vehicleDrive(120.0));
    const SeparatedVehicle separated = separateVehicle({drive}, strutNames(vehicle));
    ASSERT_TRUE(separated.coupling) << name << ": " << separated.coupling.reason;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      const VehicleStrut& strut = vehicle.struts[i];
      const double own = vehicle.mobility(strut, strut);
      EXPECT_NEAR(separated.models[i].damping_to_mass, own * strut.damping, 0.02 * own * strut.damping) << name << i;
      EXPECT_NEAR(separated.models[i].stiffness_to_mass, own * strut.stiffness, 0.02 * own * strut.stiffness)
          << name << i;
      for (const double error : separated.coupling.modelErrorOf(i)) EXPECT_LT(error, 0.02) << "of linear struts";
      for (std::size_t j = 0; j < drive.size(); ++j) {
        // Twelve ratios of each of four vehicles: one in 1e6 of them is five standard deviations off.
        const double spread = std::fmax(separated.coupling.stddevs[i][j], 1e-9);
        EXPECT_NEAR(separated.coupling.ratios[i][j], ratioOf(vehicle, i, j), 5.0 * spread) << name << i << j;
      }
    }
  }
}

TEST(SeparatedVehicle, SaysWhichStrutsARoadThatIsTheSameOnBothSidesCannotTellApart) {
  const Vehicle vehicle = namedVehicle("sedan");
  VehicleDriveOptions options = vehicleDrive(60.0);
  options.tracks = "identical";
  const SeparatedVehicle separated = separateVehicle({strutDrives(vehicle, options)}, strutNames(vehicle));
  EXPECT_FALSE(separated.coupling);
  EXPECT_TRUE(separated.struts.empty());
  const std::string& reason = separated.coupling.reason;
  const bool names_an_axle =
      (reason.find("front_left") != std::string::npos && reason.find("front_right") != std::string::npos) ||
      (reason.find("rear_left") != std::string::npos && reason.find("rear_right") != std::string::npos);
  EXPECT_TRUE(names_an_axle) << reason;
}

TEST(SeparatedVehicle, RefusesStrutsWithoutTheSameStamps) {
  const Vehicle vehicle = namedVehicle("half_sedan");
  StrutDrives drive = strutDrives(vehicle, vehicleDrive(5.0));
  drive[1].samples[7].stamp += Stamp(1);
  EXPECT_THROW(separateVehicle({drive}, strutNames(vehicle)), std::invalid_argument);
  EXPECT_THROW(separateVehicle({}, strutNames(vehicle)), std::invalid_argument);
  EXPECT_THROW(separateVehicle({drive}, {"front"}), std::invalid_argument);
}

TEST(SeparatedVehicle, RefusesPositionsOfAnotherNumberOfStruts) {
  const Vehicle vehicle = namedVehicle("half_sedan");
  VehicleDrive drive{strutDrives(vehicle, vehicleDrive(5.0))};
  drive.places = {{1.2, 0.0}};
  EXPECT_THROW(separateVehicle({drive}, strutNames(vehicle)), std::invalid_argument);
}

TEST(SeparatedVehicle, TakesTheModelsThatAreKnown) {
  const Vehicle vehicle = namedVehicle("half_sedan");
  const std::vector<VehicleDrive> drives{strutDrives(vehicle, vehicleDrive(60.0))};
  const KnownModels models{std::nullopt, StrutModel{3.0, 70.0, {}, {}}};
  const SeparatedVehicle separated = separateVehicle(drives, strutNames(vehicle), {}, models);
  ASSERT_TRUE(separated.coupling) << separated.coupling.reason;
  EXPECT_EQ(separated.models[1].damping_to_mass, 3.0);
  EXPECT_EQ(separated.models[1].stiffness_to_mass, 70.0);
  EXPECT_EQ(separated.models[0].damping_to_mass,
            separateVehicle(drives, strutNames(vehicle)).models[0].damping_to_mass);
  EXPECT_THROW(separateVehicle(drives, strutNames(vehicle), {}, {std::nullopt}), std::invalid_argument);
}

TEST(DiagnosedVehicle, LacksNothingWhereNothingIsHidden) {
  const Vehicle vehicle = quiet("sedan");
  const VehicleDiagnosis found = diagnoseVehicle({strutDrives(vehicle, vehicleDrive(120.0))}, strutNames(vehicle));
  ASSERT_TRUE(found) << found.coupling.reason;
  EXPECT_EQ(found.verdict, Verdict::kNothingMissing) << found.summary;
  for (const Diagnosis& strut : found.struts) {
    EXPECT_TRUE(strut.selected.empty());
    EXPECT_LT(strut.base.held_out_rmse, 1.1 * strut.noise_floor);
  }
}

TEST(DiagnosedVehicle, NamesAnEffectInTheStrutThatHasItAndInNoOther) {
  Vehicle vehicle = namedVehicle("sedan");
  const EffectLibrary library = builtInEffects();
  vehicle.struts[2].hidden = {{findEffect(library.forces, "quadratic_damping"), 12.0, {}}};
  const VehicleDiagnosis found = diagnoseVehicle({strutDrives(vehicle, vehicleDrive(120.0))}, strutNames(vehicle));
  ASSERT_TRUE(found) << found.coupling.reason;
  EXPECT_EQ(found.verdict, Verdict::kEffectFound) << found.summary;
  for (std::size_t i = 0; i < found.struts.size(); ++i) {
    const std::vector<std::string> expected =
        i == 2 ? std::vector<std::string>{"quadratic_damping"} : std::vector<std::string>{};
    EXPECT_EQ(found.struts[i].selected, expected) << found.summary;
  }
  EXPECT_NE(found.summary.find("quadratic_damping in " + vehicle.struts[2].name), std::string::npos) << found.summary;
}

// A sedan's gyro hides it where the struts are judged one by one: what it reads wrong is ten times as large.
TEST(DiagnosedVehicle, NamesAnEffectThatOneBodyImuTells) {
  Vehicle vehicle = namedVehicle("sedan");
  const EffectLibrary library = builtInEffects();
  vehicle.struts[2].hidden = {{findEffect(library.forces, "quadratic_damping"), 12.0, {}}};
  const VehicleDrive drive = bodyImuDrive(vehicle, vehicleDrive(120.0));
  const VehicleDiagnosis found = diagnoseVehicle({drive}, strutNames(vehicle));
  ASSERT_TRUE(found) << found.coupling.reason;
  for (std::size_t i = 0; i < found.struts.size(); ++i) {
    const std::vector<std::string> expected =
        i == 2 ? std::vector<std::string>{"quadratic_damping"} : std::vector<std::string>{};
    EXPECT_EQ(found.struts[i].selected, expected) << found.summary;
  }
  ASSERT_TRUE(found.struts[2].final_fit);
  const FittedModel& fit = *found.struts[2].final_fit;
  EXPECT_NEAR(fit.model.effects.front().coefficient, 12.0, 3.0 * fit.stddev[2]) << fit.stddev[2];
  EXPECT_LT(fit.stddev[2], 0.1 * 12.0);
}

// A model of another day, of a damper that has lost a third since: its strut's neighbours lack nothing.
TEST(DiagnosedVehicle, TakesNothingFromAGivenModelThatIsNoLongerTrue) {
  const Vehicle vehicle = namedVehicle("half_sedan");
  const VehicleDrive drive = bodyImuDrive(vehicle, vehicleDrive(120.0));
  const double own = vehicle.mobility(vehicle.struts[0], vehicle.struts[0]);
  const StrutModel stale{1.5 * own * vehicle.struts[0].damping, own * vehicle.struts[0].stiffness, {}, {}};
  const VehicleDiagnosis found = diagnoseVehicle({drive}, strutNames(vehicle), {}, {stale, std::nullopt});
  ASSERT_TRUE(found) << found.coupling.reason;
  EXPECT_EQ(found.verdict, Verdict::kNothingMissing) << found.summary;
  for (const Diagnosis& strut : found.struts) EXPECT_LT(strut.base.held_out_rmse, 1.1 * strut.noise_floor);
}

TEST(DiagnosedVehicle, IsSearchedFromTheModelsThatAreKnown) {
  Vehicle vehicle = namedVehicle("half_sedan");
  const ForceEffect law = findEffect(builtInEffects().forces, "quadratic_damping");
  vehicle.struts[0].hidden = {{law, 2.0, {}}};
  const std::vector<VehicleDrive> drives{strutDrives(vehicle, vehicleDrive(120.0))};
  DiagnoseOptions options;
  options.candidates = {{law, findEffect(builtInEffects().forces, "asymmetric_damping")}, {}};
  const VehicleDiagnosis first = diagnoseVehicle(drives, strutNames(vehicle), {options});
  ASSERT_TRUE(first) << first.coupling.reason;
  ASSERT_EQ(first.struts[0].selected, std::vector<std::string>{"quadratic_damping"}) << first.summary;
  const VehicleDiagnosis again =
      diagnoseVehicle(drives, strutNames(vehicle), {options}, {first.struts[0].model(), std::nullopt});
  EXPECT_TRUE(again.struts[0].selected.empty()) << again.summary;
  EXPECT_EQ(again.struts[0].base.model.effects.size(), 1U);
  EXPECT_TRUE(again.struts[1].base.model.effects.empty());
  EXPECT_THROW(diagnoseVehicle(drives, strutNames(vehicle), {}, {std::nullopt}), std::invalid_argument);
}

TEST(DiagnosedVehicle, HasTheDrivesThatItsStrutsWereJudgedBy) {
  const Vehicle vehicle = namedVehicle("half_sedan");
  const std::vector<VehicleDrive> drives{strutDrives(vehicle, vehicleDrive(60.0)),
                                         strutDrives(vehicle, vehicleDrive(30.0))};
  DiagnoseOptions options;
  options.candidates = {{findEffect(builtInEffects().forces, "quadratic_damping")}, {}};  // what is judged is the base
  const VehicleDiagnosis found = diagnoseVehicle(drives, strutNames(vehicle), {options});
  ASSERT_TRUE(found) << found.coupling.reason;
  ASSERT_EQ(found.drives.size(), 2U);
  for (std::size_t i = 0; i < found.drives.size(); ++i) {
    ASSERT_EQ(found.drives[i].size(), drives.size());
    const Diagnosis alone = diagnose(found.drives[i], options);
    EXPECT_DOUBLE_EQ(alone.base.held_out_rmse, found.struts[i].base.held_out_rmse) << i;
  }
}

// On a smooth road the gyro of a sedan reads more noise than motion, and no strut explains half of that.
TEST(IdentifiedVehicle, IsValidBehindAGyroThatIsAsLoudAsTheMotion) {
  const Vehicle vehicle = quiet("sedan");
  VehicleDriveOptions options = vehicleDrive(240.0);
  options.gyro_noise = 0.006;
  const VehicleDrive drive = bodyImuDrive(vehicle, options);
  double reports = 0.0, valid = 0.0, inside = 0.0, least_explained = 1.0;
  const VehicleIdentification found =
      identifyVehicle({drive}, strutNames(vehicle), {}, [&](std::size_t i, const MonitorReport& report) {
        if (toSeconds(report.stamp) < 60.0) return;
        const double own = vehicle.mobility(vehicle.struts[i], vehicle.struts[i]) * vehicle.struts[i].damping;
        reports += 1.0;
        least_explained = std::min(least_explained, report.la.explained);
        const StrutEstimate& estimate = report.estimate;
        if (!estimate.valid()) return;
        valid += 1.0;
        inside += std::abs(estimate.damping_to_mass - own) < 3.0 * estimate.damping_to_mass_stddev ? 1.0 : 0.0;
      });
  ASSERT_TRUE(found) << found.coupling.reason;
  EXPECT_LT(least_explained, 0.5);
  EXPECT_GT(valid, 0.9 * reports);
  EXPECT_GT(inside, 0.99 * valid);
}

TEST(IdentifiedVehicle, ReportsEveryRowOfEveryStrut) {
  const Vehicle vehicle = namedVehicle("half_sedan");
  const StrutDrives drive = strutDrives(vehicle, vehicleDrive(60.0));
  std::vector<std::uint64_t> rows(2);
  const VehicleIdentification found =
      identifyVehicle({drive}, strutNames(vehicle), {}, [&](std::size_t strut, const MonitorReport& report) {
        if (!report.has_row) return;
        ++rows[strut];
        EXPECT_GE(report.stamp, drive[strut].samples.front().stamp);
        EXPECT_EQ((report.stamp - drive[strut].samples.front().stamp) % fromSeconds(0.01), Stamp::zero());
      });
  ASSERT_TRUE(found) << found.coupling.reason;
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i], found.struts[i].rows) << i;
}

TEST(IdentifiedVehicle, IsEveryStrutsOwn) {
  const Vehicle vehicle = namedVehicle("ugv");
  const VehicleIdentification found = identifyVehicle({strutDrives(vehicle, vehicleDrive(120.0))}, strutNames(vehicle));
  ASSERT_TRUE(found) << found.coupling.reason;
  for (std::size_t i = 0; i < found.struts.size(); ++i) {
    const VehicleStrut& strut = vehicle.struts[i];
    const double own = vehicle.mobility(strut, strut);
    const StrutEstimate& la = found.struts[i].la;
    EXPECT_TRUE(la.valid()) << describe(la.doubt);
    EXPECT_NEAR(la.damping_to_mass, own * strut.damping, 4.0 * la.damping_to_mass_stddev) << i;
    EXPECT_NEAR(la.stiffness_to_mass, own * strut.stiffness, 4.0 * la.stiffness_to_mass_stddev) << i;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
