// Cost of SuspensionMonitor::addSample with LS, LA, free run and health.
//   add_sample                        Google Benchmark, ns per sample at L = 30, 300, 3000
//   add_sample --loop HORIZON COUNT [EFFECT]   feeds COUNT samples and ends, for counting instructions
//                                              (scripts/benchmark), with an effect that has no shapes in the model
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string_view>
#include <vector>

#include "../test/core/paper_drive.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {
namespace {

std::vector<CornerSample> drive() {
  SimulationOptions options;
  options.scenario = "iso_road";
  options.rate = 100.0;
  return simulate(options);
}

/// Feeds the drive again and again, the clock going on.
class Feeder {
 public:
  explicit Feeder(int horizon_samples) : samples_(drive()), monitor_(options(horizon_samples)) {}

  void addEffect(std::string_view name) { monitor_.setEffects({{findEffect(forceEffects(), name), 0.0, {}}}); }

  void feed() {
    CornerSample sample = samples_[next_];
    sample.stamp = stamp_;
    stamp_ += std::chrono::milliseconds(10);
    next_ = next_ + 1 == samples_.size() ? 0 : next_ + 1;
    benchmark::DoNotOptimize(monitor_.addSample(sample));
  }

 private:
  static MonitorSettings options(int horizon_samples) {
    MonitorSettings options;
    options.sample_period = 0.01;
    options.integration_horizon = horizon_samples * *options.sample_period;
    return options;
  }

  std::vector<CornerSample> samples_;
  SuspensionMonitor monitor_;
  std::size_t next_ = 0;
  Stamp stamp_{};
};

void addSample(benchmark::State& state) {
  Feeder feeder(static_cast<int>(state.range(0)));
  for (long i = 0; i < 3 * state.range(0); ++i) feeder.feed();  // filter full, estimates valid
  for (auto _ : state) feeder.feed();
}
BENCHMARK(addSample)->Arg(30)->Arg(300)->Arg(3000);

void addSampleWithEffect(benchmark::State& state) {
  Feeder feeder(30);
  feeder.addEffect("quadratic_damping");
  for (int i = 0; i < 1000; ++i) feeder.feed();
  for (auto _ : state) feeder.feed();
}
BENCHMARK(addSampleWithEffect);

int loop(int horizon_samples, long count, const char* effect) {
  Feeder feeder(horizon_samples);
  if (effect != nullptr) feeder.addEffect(effect);
  for (long i = 0; i < count; ++i) feeder.feed();
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  if (argc >= 4 && std::string_view(argv[1]) == "--loop")
    return suspension_health_monitor::loop(std::atoi(argv[2]), std::atol(argv[3]), argc > 4 ? argv[4] : nullptr);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
