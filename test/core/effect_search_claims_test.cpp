// What the search promises on drives of other kinds than a car on its road.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "hidden_effect.h"
#include "recorded_drive.h"
#include "suspension_health_monitor/internal/search/effect_search.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

SearchResult search(const DriveRecord& record, const StrutModel& start, const DiagnoseOptions& options = {}) {
  SearchResult result = searchEffects({&record}, start, options);
  EXPECT_TRUE(result);
  result.suggested_drive = suggestionOf(result);
  return result;
}

SearchResult searchInPaperDrive(const std::string& name, bool ramp, int seed) {
  SimulationOptions options = scenario(name, 120.0);
  if (!ramp) options.damping_end_fraction = 1.0;
  options.seed = seed;
  return search(recorded(options), {2.7, 14.5, {}, {}});
}

TEST(EffectSearchOnPaperDrives, TheRampOfTheDampingIsNamedWithAndWithoutDataLoss) {
  for (const char* name : {"paper_clean", "paper_outliers"}) {
    const SearchResult result = searchInPaperDrive(name, true, 2);
    EXPECT_EQ(result.verdict, Verdict::kEffectFound) << name;
    EXPECT_EQ(result.selected, std::vector<std::string>{"damping_drift"}) << name;
    ASSERT_TRUE(result.final_fit);
    EXPECT_LT(result.final_fit->model.effects.at(0).coefficient, 0.0);  // it falls
  }
}

TEST(EffectSearchOnPaperDrives, DataLossAndEndStopsGiveNoFalseName) {
  for (int seed = 1; seed <= 2; ++seed) {
    EXPECT_EQ(searchInPaperDrive("paper_clean", false, seed).verdict, Verdict::kNothingMissing);
    EXPECT_EQ(searchInPaperDrive("paper_outliers", false, seed).verdict, Verdict::kNothingMissing);
    for (const bool ramp : {false, true}) {  // the stops are there: their names, and the ramp's, are true ones
      const std::set<std::string> true_names{"bump_stop", "rebound_stop", "damping_drift"};
      for (const std::string& selected : searchInPaperDrive("paper_saturation", ramp, seed).selected)
        EXPECT_EQ(true_names.count(selected), 1u) << selected;
    }
  }
}

// An electronic oscillator: 68 Hz, travel of order 0.1, accelerations of order 10^4, a cubic spring with 15 % of the
// linear force. Integrated here, by the classical Runge-Kutta method in steps of 1/40 sample.
class Oscillator {
 public:
  static constexpr double kPeriod = 1.0 / 610.0, kB0 = 4.0 * M_PI * M_PI * 68.0 * 68.0, kB1 = 85.0, kCubic = 8e5;

  DriveRecord drive(double noise) {
    RandomStream random(4, RandomPurpose::kSprungNoise);
    Drive record_drive;
    for (int k = 0; k < 6000; ++k) {
      record_drive.samples.push_back({fromSeconds(k * kPeriod), force(travel_, rate_) + noise * random.gaussian(),
                                      wheel(k * kPeriod) + noise * random.gaussian()});
      for (int i = 0; i < kSteps; ++i) step(k * kPeriod + i * kStep);
    }
    const DriveRecord record(record_drive, kPeriod, 2);
    return record;
  }

 private:
  static constexpr int kSteps = 40;
  static constexpr double kStep = kPeriod / kSteps;

  static double force(double d, double v) { return kB1 * v + kB0 * d + kCubic * d * d * d; }

  static double wheel(double t) {  // 5 to 180 Hz
    double sum = 0.0;
    for (int i = 0; i < 80; ++i) sum += std::sin(2.0 * M_PI * (5.0 + 2.19 * i) * t + 1.7 * i * i);
    return 2000.0 * sum;
  }

  void step(double t) {
    const double start = wheel(t), middle = wheel(t + kStep / 2), end = wheel(t + kStep);
    const double v1 = rate_, a1 = start - force(travel_, v1);
    const double v2 = rate_ + kStep / 2 * a1, a2 = middle - force(travel_ + kStep / 2 * v1, v2);
    const double v3 = rate_ + kStep / 2 * a2, a3 = middle - force(travel_ + kStep / 2 * v2, v3);
    const double v4 = rate_ + kStep * a3, a4 = end - force(travel_ + kStep * v3, v4);
    travel_ += kStep / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    rate_ += kStep / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }

  double travel_ = 0.0, rate_ = 0.0;
};

TEST(EffectSearch, NamesTheCubicSpringOfAnOscillatorThatIsNoVehicle) {
  const DriveRecord record = Oscillator().drive(100.0);
  const SearchResult result = search(record, {1.2 * Oscillator::kB1, 1.1 * Oscillator::kB0, {}, {}});
  EXPECT_EQ(result.verdict, Verdict::kEffectFound);
  EXPECT_EQ(result.selected, std::vector<std::string>{"progressive_spring"});
  ASSERT_TRUE(result.extended && result.final_fit);
  EXPECT_LT(4.0 * result.extended->held_out_rmse, result.base.held_out_rmse);
  const ActiveEffect& spring = result.final_fit->model.effects.at(0);
  EXPECT_NEAR(spring.shapes.at(0), 3.0, 0.1);
  const double size = 0.1;  // where forces are compared: c and p alone trade for one another
  EXPECT_NEAR(spring.coefficient * std::pow(size, spring.shapes[0]) / (Oscillator::kCubic * std::pow(size, 3)), 1.0,
              0.1);
}

TEST(EffectSearch, ReconsidersTheFirstEffectWhenTheSecondIsKnown) {
  SimulationOptions options = scenario("iso_road", 120.0);
  options.vehicle = "rover";
  options.rate = 100.0;
  options.seed = 2;
  std::vector<ActiveEffect> hidden{hiddenEffect(options, "asymmetric_spring", {}, 0.15)};
  hidden.push_back({findEffect(forceEffects(), "coulomb_friction"), 0.25, {0.01}});
  options.hidden = hidden;
  const SearchResult result = search(recorded(options), {5.5, 115.0, {}, {}});
  std::set<std::string> names(result.selected.begin(), result.selected.end());
  EXPECT_EQ(names, (std::set<std::string>{"asymmetric_spring", "coulomb_friction"}));
}

struct ShakenState {
  double d = 0.0, v = 0.0, s = 0.0, r = 0.0;  // travel, its rate, two numbers of a law
};

// A car's strut under a wheel that is shaken by many sines, and rests from 100 to 190 s; integrated here.
// @param law  gives z'' in the place of d, s' and r' in theirs.  @param x  the start.
template <class Law>
DriveRecord shaken(double seconds, const Law& law, ShakenState x = {}) {
  constexpr double period = 0.01, h = period / 10.0;
  const auto wheel = [](double t) {
    double sum = 0.0;
    for (int i = 0; i < 40; ++i) sum += std::sin(2.0 * M_PI * (0.6 + 0.31 * i) * t + 1.3 * i * i);
    return t > 100.0 && t < 190.0 ? 0.0 : 0.7 * sum;
  };
  RandomStream random(7, RandomPurpose::kSprungNoise);
  Drive record_drive;
  for (int k = 0; k < static_cast<int>(seconds / period); ++k) {
    const double t = k * period;
    record_drive.samples.push_back(
        {fromSeconds(t), law(x).d + 0.02 * random.gaussian(), wheel(t) + 0.02 * random.gaussian()});
    for (int i = 0; i < 10; ++i) {
      const auto rate = [&](const ShakenState& at, double time) {
        const ShakenState told = law(at);  // z'' in its d
        return ShakenState{at.v, wheel(time) - told.d, told.s, told.r};
      };
      const auto moved = [&](const ShakenState& by, double share) {
        return ShakenState{x.d + share * by.d, x.v + share * by.v, x.s + share * by.s, x.r + share * by.r};
      };
      const double now = t + i * h;  // the explicit midpoint rule
      x = moved(rate(moved(rate(x, now), h / 2), now + h / 2), h);
    }
  }
  const DriveRecord record(record_drive, period, 1);
  return record;
}

TEST(EffectSearch, NamesAPassengerOnASeat) {
  constexpr double mu = 0.25, w = 2.0 * M_PI * 4.0, zeta = 0.25;
  const SearchResult result = search(shaken(100.0,
                                            [](const ShakenState& x) {
                                              const double pull = w * w * x.s + 2.0 * zeta * w * x.r,
                                                           body = 6.0 * x.v + 63.0 * x.d + mu * pull;
                                              return ShakenState{body, 0.0, x.r, -body - pull};
                                            }),
                                     {6.6, 60.0, {}, {}});
  EXPECT_EQ(result.selected, std::vector<std::string>{"load_on_spring"});
  ASSERT_TRUE(result.final_fit);
  const ActiveEffect& load = result.final_fit->model.effects.at(0);
  EXPECT_NEAR(load.coefficient, mu, 0.02 * mu);
  EXPECT_NEAR(load.shapes.at(0), 4.0, 0.1);
  EXPECT_NEAR(load.shapes.at(1), zeta, 0.05 * zeta);
}

// All that changes with time. What else the library has takes two thirds of a search, and is tried in one of them.
DiagnoseOptions changes() {
  DiagnoseOptions options;
  options.candidates = {};
  for (const char* name : {"warming", "damping_drift", "stiffness_drift", "body_drag"})
    options.candidates.forces.push_back(findEffect(forceEffects(), name));
  return options;
}

// The damper heats by its own power, and its oil thins exponentially. Warm at the start, it is harder after the rest.
TEST(EffectSearch, TellsADamperThatWarmsFromOneThatWears) {
  for (const double at_start : {0.0, 0.2}) {
    const SearchResult warm =
        search(shaken(300.0,
                      [](const ShakenState& x) {
                        const double damper = 6.0 * std::exp(-x.s) * x.v;
                        return ShakenState{damper + 63.0 * x.d, 0.0, (damper * x.v * 1.5 - x.s) / 40.0, 0.0};
                      },
                      {0.0, 0.0, at_start}),
               {6.6, 60.0, {}, {}}, at_start > 0.0 ? DiagnoseOptions() : changes());
    EXPECT_EQ(warm.selected, std::vector<std::string>{"warming"}) << at_start;
  }
  const SearchResult worn =
      search(shaken(300.0,
                    [](const ShakenState& x) {  // s: the time
                      return ShakenState{6.0 * (1.0 - 0.001 * x.s) * x.v + 63.0 * x.d, 0.0, 1.0, 0.0};
                    }),
             {6.6, 60.0, {}, {}}, changes());
  EXPECT_EQ(worn.selected, std::vector<std::string>{"damping_drift"});
}

// The damper hangs on its eye by a stiff rubber with play: its force is 0 until the play is crossed.
TEST(EffectSearch, TellsThePlayOfADampersEye) {
  const SearchResult result = search(
      shaken(100.0,
             [](const ShakenState& x) {  // s: the rod's place
               const double stretched = x.d - x.s, force = 600.0 * (stretched - std::clamp(stretched, -0.004, 0.004));
               return ShakenState{63.0 * x.d + force, 0.0, force / 6.0, 0.0};
             }),
      {6.6, 60.0, {}, {}});
  EXPECT_EQ(result.selected, std::vector<std::string>{"damper_backlash"});
  ASSERT_TRUE(result.final_fit);
  EXPECT_NEAR(result.final_fit->model.effects.at(0).shapes.at(0), 0.008, 0.1 * 0.008);
}

// A spring with play, which rest leaves anywhere within it.
TEST(EffectSearch, TellsTheWidthOfAPlay) {
  const SearchResult result = search(
      shaken(
          100.0,
          [](const ShakenState& x) {
            const double off = x.d - 0.001;
            return ShakenState{6.0 * x.v + 20.0 * x.d + 43.0 * (off - std::clamp(off, -0.004, 0.004)), 0.0, 0.0, 0.0};
          }),
      {6.6, 60.0, {}, {}});
  EXPECT_EQ(result.selected, std::vector<std::string>{"backlash"});
  ASSERT_TRUE(result.final_fit);
  EXPECT_NEAR(result.final_fit->model.effects.at(0).coefficient, 43.0, 0.1 * 43.0);
  EXPECT_NEAR(result.final_fit->model.effects.at(0).shapes.at(0), 0.008, 0.1 * 0.008);
}

TEST(EffectSearch, SuggestsTheDriveThatSeparatesAGroup) {
  SimulationOptions options = scenario("paper_clean", 120.0);
  options.damping_end_fraction = 1.0;
  options.hidden = {hiddenEffect(options, "quadratic_damping", {}, 0.15)};
  DiagnoseOptions searching;
  searching.candidates = {
      {findEffect(forceEffects(), "quadratic_damping"),
       {"turbulent_damping", "c v |v|^0.75", "(s/m)^0.75 / m", "a smooth orifice", "",
        [](const StrutMotion& m, const double*) { return m.travel_rate * std::pow(std::abs(m.travel_rate), 0.75); }}},
      {}};
  const DriveRecord record = recorded(options);
  SearchResult result = searchEffects({&record}, {3.3, 13.0, {}, {}}, searching);
  result.suggested_drive = suggestionOf(result);
  ASSERT_EQ(result.indistinguishable.size(), 1u);
  for (const std::string& name : result.indistinguishable[0])
    EXPECT_NE(result.suggested_drive.find(name), std::string::npos) << result.suggested_drive;
  EXPECT_NE(result.suggested_drive.find("record"), std::string::npos) << result.suggested_drive;
}

TEST(EffectSearch, AsksForAHigherRateWhenTheWheelIsSampledTooSlowly) {
  SimulationOptions options = carDrive(120.0, 0.03);  // shakes up to 42 Hz
  options.rate = 50.0;
  options.hidden = {hiddenEffect(options, "asymmetric_spring", {}, 0.15)};
  const SearchResult result = search(recorded(options), {6.6, 60.0, {}, {}});
  EXPECT_EQ(result.verdict, Verdict::kUnexplained);
  EXPECT_NE(result.suggested_drive.find("twice the rate"), std::string::npos) << result.suggested_drive;
}

TEST(EffectSearch, EndsWithWhatItsProgressThrows) {
  const DriveRecord record = recorded(carDrive(30.0, 0.03));
  int calls = 0;
  const auto stop = [&](double) {
    if (++calls == 3) throw std::runtime_error("enough");
  };
  DiagnoseOptions options;
  options.progress = stop;
  EXPECT_THROW(searchEffects({&record}, {6.6, 60.0, {}, {}}, options), std::runtime_error);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace suspension_health_monitor
