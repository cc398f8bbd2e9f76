#pragma once
// Small foreign data sets in folders.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/importers.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::testing {

/// 4 x 3 pixels; `value` everywhere but for the corners, which are 0 and 65535.
inline void put_depth(const TempFolder& folder, std::string_view name, std::uint16_t value) {
  DepthImage image(4, 3, value);
  image.at(0, 0) = 0;
  image.at(3, 2) = 65535;
  ASSERT_TRUE(write_depth_png(folder / name, image));
}

inline void put_color(const TempFolder& folder, std::string_view name, int width = 4) {
  ASSERT_TRUE(write_color_png(folder / name, ColorImage(width, 3, Rgb{1, 2, 3})));
}

/// Two points, organised as 2 x 1.
inline void put_scan(const TempFolder& folder, std::string_view name, float x = 1.0f) {
  CloudFile file;
  file.cloud.points = {Vec3f(x, 2.0f, 3.0f), Vec3f(x, 4.0f, 5.0f)};
  file.cloud.colors = {Rgb{9, 8, 7}, Rgb{6, 5, 4}};
  file.grid_width = 2;
  file.grid_height = 1;
  file.grid = {1, 0};
  ASSERT_TRUE(write_cloud(folder / name, file));
}

/// Opens a data set of any layout, and checks that opening it can be cancelled.
inline std::unique_ptr<FrameSequence> open(const std::filesystem::path& path,
                                           const ImportOptions& options = {}) {
  RunContext cancelled;
  cancelled.cancel();
  const auto none = open_foreign(path, options, cancelled);
  EXPECT_FALSE(none);
  if (!none) {
    EXPECT_EQ(none.error().code, ErrorCode::kCancelled) << none.error().text();
  }
  auto sequence = open_foreign(path, options);
  EXPECT_TRUE(sequence) << sequence.error().text();
  return sequence ? std::move(*sequence) : throw std::runtime_error("not opened");
}

inline Error refusal(const std::filesystem::path& path, const ImportOptions& options = {}) {
  const auto sequence = open_foreign(path, options);
  EXPECT_FALSE(sequence);
  return sequence ? Error{} : sequence.error();
}

inline Frame frame_of(const FrameSequence& sequence, std::size_t position) {
  auto frame = sequence.read(position);
  EXPECT_TRUE(frame) << frame.error().text();
  return frame.value_or(Frame{});
}

}  // namespace turnscan::testing
