#include <gtest/gtest.h>

#include <limits>
#include <turnscan/reconstruction/surface/detached_components.hpp>

namespace turnscan::tsdf {
namespace {

constexpr double kAnyWay = std::numeric_limits<double>::infinity();
using Attachments = std::vector<std::size_t>;

/// Points every millimetre from `low` to `high` along x.
PlacedComponent bar(int low, int high, bool stands) {
  PlacedComponent out;
  for (int x = low; x <= high; ++x) out.points.emplace_back(0.001f * float(x), 0.0f, 0.0f);
  out.stands = stands;
  return out;
}

TEST(AttachDetached, ADetachedOneBelongsToTheNearestThatStands) {
  EXPECT_EQ(attach_detached({bar(0, 10, true), bar(30, 40, true), bar(14, 18, false)}, kAnyWay),
            (Attachments{0, 1, 0}));
  EXPECT_EQ(attach_detached({bar(0, 10, true), bar(30, 40, true), bar(24, 28, false)}, kAnyWay),
            (Attachments{0, 1, 1}));
}

TEST(AttachDetached, AChainHangsTogether) {
  // The last is nearest to what the second holds, which the first holds.
  EXPECT_EQ(
      attach_detached({bar(0, 10, true), bar(60, 70, true), bar(12, 30, false), bar(32, 36, false)},
                      kAnyWay),
      (Attachments{0, 1, 0, 0}));
}

TEST(AttachDetached, NotAcrossMoreThanAShareOfItsSize) {
  const std::vector<PlacedComponent> pieces{bar(0, 10, true), bar(14, 18, false),
                                            bar(-40, -8, false)};
  // The nearer one is too small for its gap of 4 mm; the farther one, behind 8 mm, is not.
  EXPECT_EQ(attach_detached(pieces, 0.5), (Attachments{0, 1, 0}));
  EXPECT_EQ(attach_detached(pieces, 1.0), (Attachments{0, 0, 0}));
}

TEST(AttachDetached, WithoutOneThatStandsNoneIsAttached) {
  EXPECT_EQ(attach_detached({bar(0, 10, false), bar(12, 20, false)}, kAnyWay), (Attachments{0, 1}));
  EXPECT_EQ(attach_detached({}, kAnyWay), Attachments());
}

}  // namespace
}  // namespace turnscan::tsdf
