#pragma once
// A mesh of the virtual doll from frames, however they came here.

#include <gtest/gtest.h>

#include <memory>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <vector>

namespace turnscan::testing {

/// The largest object of frames as seen by `camera`, before the table that `rig` describes, by the
/// time of each.
inline TriangleMesh mesh_of(const std::vector<Frame>& frames, const SensorInfo& camera,
                            const SequenceHeader& rig, double speed_rad_s) {
  SequenceHeader header = rig;
  header.sensors = {camera};
  header.sensors[0].T_table_sensor = rig.sensors[0].T_table_sensor;
  std::vector<std::shared_ptr<const Frame>> kept;
  for (const Frame& from : frames) {
    Frame frame = from;
    frame.info.index = static_cast<std::uint32_t>(kept.size());
    frame.info.angle_rad = speed_rad_s * (frame.info.time_s - frames.front().info.time_s);
    kept.push_back(std::make_shared<const Frame>(std::move(frame)));
  }
  ReconstructOptions options;
  options.surface.method = SurfaceMethod::kVolumetric;
  options.voxels.size_m = 0.006;
  auto made = reconstruct(MemoryFrames(std::move(header), std::move(kept)), options, {}, {});
  EXPECT_TRUE(made) << (made ? "" : made.error().text());
  if (!made || made->objects.empty()) return {};
  EXPECT_TRUE(made->objects[0].check.watertight()) << made->objects[0].check.text();
  return std::move(made->objects[0].mesh);
}

}  // namespace turnscan::testing
