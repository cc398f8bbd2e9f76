// The statistical outlier filter and PCL's on the same frames in one run: the same kept set,
// nanoseconds a point and their ratio. Real frames are used when the data sets are there
// (TURNSCAN_TEST_DATA).

#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <bench/pcl_outliers.hpp>
#include <tests/reconstruction/outliers/depth_frames.hpp>

#include <map>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/outliers/outliers.hpp>

namespace {

using turnscan::FramePoints;
using turnscan::OutlierOptions;
using turnscan::testing::NamedFrame;

std::vector<NamedFrame> frames() {
  std::vector<NamedFrame> list = {{"object (synthetic Kinect v2, cropped)",
                                   turnscan::testing::object_frame(turnscan::testing::kinect_v2())},
                                  {"room (synthetic Kinect v2, 512x424)",
                                   turnscan::testing::room_frame(turnscan::testing::kinect_v2())}};
  for (NamedFrame& real : turnscan::testing::real_depth_frames(50))
    if (real.name.find("bear/depth_") == std::string::npos || real.name.ends_with("_0.png"))
      list.push_back(std::move(real));
  return list;
}

void per_point(benchmark::State& state, std::size_t points) {
  state.counters["ns/point"] =
      benchmark::Counter(double(state.iterations()) * double(points) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void pcl(benchmark::State& state, const FramePoints& frame) {
  turnscan::testing::PclOutlierFilter filter(frame.cloud.points, 10, 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(filter.run());
  if (filter.mask() !=
      turnscan::outliers::statistical_outlier_mask(frame.cloud.points, OutlierOptions()).value())
    state.SkipWithError("kept sets differ");
  per_point(state, frame.cloud.size());
}

void ours(benchmark::State& state, const FramePoints& frame, int threads) {
  turnscan::set_thread_count(threads);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        turnscan::outliers::statistical_outlier_mask(frame.cloud.points, OutlierOptions()));
  turnscan::set_thread_count(0);
  per_point(state, frame.cloud.size());
}

void one_thread(benchmark::State& state, const FramePoints& frame) { ours(state, frame, 1); }
void all_cores(benchmark::State& state, const FramePoints& frame) { ours(state, frame, 0); }

/// Prints as usual, and remembers ns/point of "way | frame".
class Ratios : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (!run.error_occurred && run.counters.count("ns/point"))
        found_[run.run_name.function_name] = run.counters.at("ns/point").value;
  }
  void print(const std::vector<NamedFrame>& frames) const {
    fmt::print("\n{:<40} {:>8} {:>9} {:>9} {:>9} {:>7} {:>7}\n", "ns/point (ratio to PCL)",
               "points", "PCL,", "1 thread", "all cores", "ratio,", "ratio,");
    fmt::print("{:<40} {:>8} {:>9} {:>9} {:>9} {:>7} {:>7}\n", "", "", "1 thread", "", "", "1 thr.",
               "cores");
    for (const NamedFrame& f : frames) {
      const double pcl_ns = at("pcl", f), one = at("one thread", f), all = at("all cores", f);
      fmt::print("{:<40} {:>8} {:>9.1f} {:>9.1f} {:>9.1f} {:>7.1f} {:>7.1f}\n", f.name,
                 f.points.cloud.size(), pcl_ns, one, all, pcl_ns / one, pcl_ns / all);
    }
  }

 private:
  double at(const char* way, const NamedFrame& frame) const {
    const auto it = found_.find(fmt::format("{} | {}", way, frame.name));
    return it == found_.end() ? 0.0 : it->second;
  }
  std::map<std::string, double> found_;
};

using Body = void (*)(benchmark::State&, const FramePoints&);

void add(const char* way, const NamedFrame& frame, Body body) {
  benchmark::RegisterBenchmark(
      fmt::format("{} | {}", way, frame.name).c_str(),
      [body, &frame](benchmark::State& state) { body(state, frame.points); })
      ->UseRealTime()
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const std::vector<NamedFrame> list = frames();
  for (const NamedFrame& frame : list) {
    add("pcl", frame, pcl);
    add("one thread", frame, one_thread);
    add("all cores", frame, all_cores);
  }
  Ratios ratios;
  benchmark::RunSpecifiedBenchmarks(&ratios);
  ratios.print(list);
  return 0;
}
