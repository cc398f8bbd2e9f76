#include <gtest/gtest.h>

#include <turnscan/reconstruction/views/view_store.hpp>

namespace turnscan::views {
namespace {

TEST(ViewStore, KeepsBoundedlyManyViewsEvenlySpreadOverEverySensor) {
  ViewStore store;
  DepthView view;
  view.pixels.assign(4, 0);
  for (std::uint32_t v = 0; v < 5000; ++v) {
    view.translation.x() = float(v);
    store.add(view, v % 2);
  }
  EXPECT_LE(store.views().size(), ViewStore::kMaxViews);
  EXPECT_GE(store.views().size(), ViewStore::kMaxViews / 2);
  EXPECT_EQ(store.stride(), 8u);
  int odd = 0;
  for (const DepthView& kept : store.views()) odd += int(kept.translation.x()) % 2;
  EXPECT_NEAR(odd, double(store.views().size()) / 2, 2);
  for (std::size_t v = 2; v < store.views().size(); ++v)
    EXPECT_FLOAT_EQ(store.views()[v].translation.x() - store.views()[v - 2].translation.x(), 16);
}

TEST(ViewStore, KeepsFewerViewsWhenTheyAreLarge) {
  ViewStore store;
  DepthView view;
  view.pixels.assign(std::size_t(1) << 18, 0);  // 1 MB
  for (int v = 0; v < 600; ++v) store.add(view, 0);
  EXPECT_LE(store.views().size(), 256u);
}

}  // namespace
}  // namespace turnscan::views
