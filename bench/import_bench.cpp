// How fast a file of another program is read, and in how much memory.
//   import_bench FILE                                    frames a second, peak memory
//   import_bench --write RECORDING COPIES none|lz4|bz2 FILE.bag
// writes a recording of a RealSense to read: the frames of a recording so often, with a picture of
// the same size each.

#include <fmt/format.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/io/import/importers.hpp>
#include <turnscan/recording/recording.hpp>

#ifdef TURNSCAN_REFERENCE_BAG
#include "tests/support/rosbag/reference_bag.hpp"
#endif

namespace turnscan {
namespace {

int failed(const std::string& text) {
  fmt::print(stderr, "import_bench: {}\n", text);
  return 1;
}

int read_all(const char* path) {
  const auto begin = std::chrono::steady_clock::now();
  const auto frames = open_foreign(path, {});
  if (!frames) return failed(frames.error().text());
  const double open_s = seconds_since(begin);
  std::atomic<std::size_t> good = 0, colored = 0;
  parallel_for((*frames)->frames().size(), 4, [&](std::size_t i) {
    const auto frame = (*frames)->read(i);
    if (!frame) return;
    ++good;
    colored += frame->color.empty() ? 0 : 1;
  });
  const double all_s = seconds_since(begin);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print(
      "{} frames, {} with colour: opened in {:.2f} s, all in {:.2f} s, {:.0f} frames a "
      "second, peak {:.0f} MB\n",
      good.load(), colored.load(), open_s, all_s, double(good) / all_s,
      double(usage.ru_maxrss) / 1024.0);
  return 0;
}

#ifdef TURNSCAN_REFERENCE_BAG
/// The frames of a recording several times, one after another.
class Copies : public FrameSequence {
 public:
  Copies(const Recording& recording, std::size_t copies) : recording_(recording) {
    header_ = recording.header();
    SensorInfo& sensor = header_.sensors.front();
    sensor.color_intrinsics = sensor.intrinsics;
    const auto& frames = recording.frames();
    for (std::size_t i = 0; i < copies * frames.size(); ++i) {
      FrameInfo info;
      info.index = std::uint32_t(i);
      info.time_s = double(i) / 30.0;
      infos_.push_back(info);
    }
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }
  Result<Frame> read(std::size_t position) const override {
    TURNSCAN_ASSIGN(Frame frame, recording_.read(position % recording_.frames().size()));
    frame.color = ColorImage(frame.depth.width, frame.depth.height);
    for (std::size_t i = 0; i < frame.color.pixels.size(); ++i) {
      const auto value = std::uint8_t(frame.depth.pixels[i] / 8 + i % 7);
      frame.color.pixels[i] = {value, std::uint8_t(value / 2), std::uint8_t(i % 251)};
    }
    return frame;
  }

 private:
  const Recording& recording_;
  SequenceHeader header_;
  std::vector<FrameInfo> infos_;
};

int write_bag(char** arguments) {
  using testing::BagPacking;
  const auto recording = Recording::open(arguments[0]);
  if (!recording) return failed(recording.error().text());
  const std::string packing = arguments[2];
  testing::ReferenceBag bag(arguments[3], packing == "lz4"   ? BagPacking::kLz4
                                          : packing == "bz2" ? BagPacking::kBz2
                                                             : BagPacking::kNone);
  testing::put_realsense(bag, Copies(*recording, std::strtoul(arguments[1], nullptr, 10)),
                         "Intel RealSense D405", 100.0);
  return 0;
}
#endif

}  // namespace
}  // namespace turnscan

int main(int count, char** arguments) {
  if (count == 2) return turnscan::read_all(arguments[1]);
#ifdef TURNSCAN_REFERENCE_BAG
  if (count == 6) return turnscan::write_bag(arguments + 2);
#endif
  return turnscan::failed("give a FILE, or --write RECORDING COPIES PACKING FILE.bag");
}
