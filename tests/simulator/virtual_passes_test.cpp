#include <stdexcept>
#include <turnscan/simulator/virtual_passes.hpp>

#include "tests/simulator/scans.hpp"
#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

VirtualPasses two_passes() {
  VirtualScanOptions options = test::plain_scan();
  options.motion.frames = 3;
  const std::vector<TriangleMesh> standing{test::box_mesh({-.05, 0, -.02}, {.05, .15, .02})};
  const std::vector<TriangleMesh> lying{test::box_mesh({-.05, 0, -.075}, {.05, .04, .075})};
  std::vector<VirtualScan> scans;
  scans.push_back(test::scan_of(standing, options));
  options.record.pass = 1;
  options.first_instant = 3;
  scans.push_back(test::scan_of(lying, options));
  return VirtualPasses(std::move(scans));
}

TEST(VirtualPasses, FollowEachOtherInOneSequence) {
  const VirtualPasses passes = two_passes();
  ASSERT_EQ(passes.frames().size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const FrameInfo& frame = passes.frames()[i];
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.pass, i / 3);
    EXPECT_EQ(passes.place_of(i), std::pair(i / 3, i % 3));
    if (i > 0) {
      EXPECT_GT(frame.time_s, passes.frames()[i - 1].time_s);
    }
    EXPECT_EQ(frame.angle_rad, passes.pass(i / 3).frames()[i % 3].angle_rad);
    const auto read = passes.read(i), there = passes.pass(i / 3).read(i % 3);
    ASSERT_TRUE(read && there);
    EXPECT_EQ(read->info.index, i);
    EXPECT_EQ(read->depth.pixels, there->depth.pixels);
  }
  EXPECT_EQ(passes.read(6).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(passes.tally(0)[0], passes.pass(0).tally(0)[0] + passes.pass(1).tally(0)[0]);
}

TEST(VirtualPasses, HaveNoiseOfTheirOwn) {
  VirtualScanOptions options = test::plain_scan();
  options.motion.frames = 2;
  const std::vector<TriangleMesh> box{test::box_mesh({-.05, 0, -.02}, {.05, .15, .02})};
  const VirtualScan first = test::scan_of(box, options);
  options.first_instant = 2;
  const VirtualScan second = test::scan_of(box, options);
  EXPECT_NE(first.read(0)->depth.pixels, second.read(0)->depth.pixels);
}

TEST(VirtualPasses, NeedAScan) { EXPECT_THROW(VirtualPasses({}), std::invalid_argument); }

}  // namespace
}  // namespace turnscan
