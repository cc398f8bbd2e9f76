#pragma once
// Small sequences in memory.

#include <atomic>
#include <functional>
#include <numbers>
#include <turnscan/core/sequence_views.hpp>
#include <vector>

namespace turnscan::testing {

inline CameraIntrinsics small_camera() {
  CameraIntrinsics camera;
  camera.width = 8;
  camera.height = 6;
  camera.fx = 9.5;
  camera.fy = 9.25;
  camera.cx = 3.5;
  camera.cy = 2.5;
  return camera;
}

inline SequenceHeader small_header() {
  SequenceHeader header;
  header.sensors.resize(1);
  header.sensors[0].intrinsics = small_camera();
  header.sensors[0].model = "test camera";
  return header;
}

inline SequenceHeader scanner_header() {
  SequenceHeader header;
  header.sensors.resize(1);
  header.sensors[0].kind = SensorKind::kPointScanner;
  header.sensors[0].viewpoint = {Vec3d(0.1, 0.2, 0.3), false};
  return header;
}

inline Frame depth_frame(std::uint32_t index) {
  Frame frame;
  frame.info.index = index;
  frame.info.time_s = index / 30.0;
  frame.info.angle_rad = index * 0.1;
  frame.depth = DepthImage(8, 6);
  for (std::size_t i = 0; i < frame.depth.pixels.size(); ++i)
    frame.depth.pixels[i] = static_cast<std::uint16_t>(5000 + 7 * i + 11 * index);
  frame.depth.pixels[0] = kNoReturn;
  frame.depth.pixels[1] = kOutsideCrop;
  return frame;
}

inline ColorImage color_image(std::uint32_t index) {
  ColorImage image(8, 6);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(index), 200};
  return image;
}

/// 3 points in a grid of 2 x 2.
inline Frame scan_frame(std::uint32_t index) {
  Frame frame;
  frame.info.index = index;
  frame.points.points = {Vec3f(0.1f, 0.2f, 0.3f), Vec3f(-0.1f, 0.25f, 0.35f),
                         Vec3f(0.01f * static_cast<float>(index), 0.0f, 0.4f)};
  frame.grid_width = 2;
  frame.grid_height = 2;
  frame.grid = {0, -1, 1, 2};
  return frame;
}

/// Counts the reads; reading position `broken` fails.
class CountingFrames : public MemoryFrames {
 public:
  CountingFrames(SequenceHeader header, std::vector<Frame> frames)
      : MemoryFrames(std::move(header), std::move(frames)) {}
  Result<Frame> read(std::size_t position) const override {
    ++reads;
    if (on_read) on_read(position);
    if (position == broken) return fail(ErrorCode::kFormat, "frame {} is broken", position);
    return MemoryFrames::read(position);
  }

  std::size_t broken = ~std::size_t(0);
  std::function<void(std::size_t)> on_read;
  mutable std::atomic<int> reads{0};
};

}  // namespace turnscan::testing
