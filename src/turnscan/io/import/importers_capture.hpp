#pragma once
// Common parts of importers for phones and hand-held sensors: device poses, confidence maps, depth
// in metres, gaps in the times.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <turnscan/io/import/importers_common.hpp>
#include <vector>

namespace turnscan::importers {

/// Decides by options.device_poses whether to use the device's poses (T_world_sensor, nullopt where
/// tracking was lost), and adds a note about it. Ignored ones are removed.
/// On auto they are ignored if the device stood still: 19 of 20 positions are within 5 mm, and 19
/// of 20 rotations within 0.5 degrees, of their median (of coordinates). The pose of a sensor on a
/// tripod is determined much better by the turntable's motion than by its own tracking.
/// Fails with kMissingData if poses are to be used and there are none, and as placed_pose() does.
Result<> settle_device_poses(const ImportOptions& options, std::vector<std::optional<Pose>>& poses,
                             SequenceHeader& header);

/// Converts from the camera frame of OpenGL and ARKit (x right, y up, z backward) to ours.
Pose from_gl_camera(const Pose& T_world_gl);

/// Clears depth values whose confidence is below `least`. sizes must be equal.
void mask_unsure(std::span<const std::uint8_t> confidence, std::uint8_t least, DepthImage& depth);

/// The minimum value of Apple's confidence maps (0 low, 1 medium, 2 high) that is kept.
std::uint8_t least_confidence(const ImportOptions& options);

/// Converts depth from floats in metres to steps of 0.1 mm; values that are not finite, not
/// positive or beyond 6.55 m become no return. bytes: width * height little-endian floats.
DepthImage depth_of_floats(std::string_view bytes, int width, int height);

/// Note for every recording of Apple's LiDAR (by the author of Record3D, its issue 43).
inline constexpr const char* kLidarNote =
    "the device computes the depth of its LiDAR from a few hundred measured points and the colour "
    "image: small shapes are soft, and gaps are filled";

/// The pinhole camera scaled to an image of another size of the same view. Image coordinates of
/// `camera` are measured from the corner of the image, as in Apple's convention.
CameraIntrinsics from_corner_coordinates(const CameraIntrinsics& camera, int width, int height);

/// Makes times relative to the first; does nothing unless they increase.
bool times_from_first(std::vector<double>& times_s);

/// The number of frames missing before each frame: gaps of more than 1.6 times the median interval.
/// Zeros if the total would exceed the number of frames.
std::vector<std::uint32_t> missing_before(std::span<const double> times_s);

/// Numbers the frames consecutively, inserting frames marked dropped into gaps of their times.
/// Frame has a member info and is empty when default-constructed.
template <class Frame>
std::vector<Frame> with_dropped(std::vector<Frame> frames, SequenceHeader& header) {
  std::vector<double> times;
  for (const Frame& frame : frames) times.push_back(frame.info.time_s);
  const std::vector<std::uint32_t> missing = missing_before(times);
  std::vector<Frame> out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::uint32_t k = 0; k < missing[i]; ++k) {
      Frame& gap = out.emplace_back();
      gap.info.status = FrameStatus::kDropped;
      gap.info.time_s =
          times[i - 1] + (times[i] - times[i - 1]) * double(k + 1) / double(missing[i] + 1);
    }
    out.push_back(std::move(frames[i]));
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i].info.index = std::uint32_t(i);
  if (out.size() > frames.size())
    add_note(header, fmt::format("{} frames are missing by their times; they are marked dropped",
                                 out.size() - frames.size()));
  return out;
}

/// If some frames have poses, marks those without as dropped and adds a note.
template <class Frame>
void drop_without_pose(std::vector<Frame>& frames, SequenceHeader& header) {
  std::size_t placed = 0, lost = 0;
  for (const Frame& frame : frames) placed += frame.info.T_table_sensor ? 1 : 0;
  if (placed == 0) return;
  for (Frame& frame : frames) {
    if (frame.info.T_table_sensor || frame.info.status == FrameStatus::kDropped) continue;
    frame.info.status = FrameStatus::kDropped;
    ++lost;
  }
  if (lost != 0)
    add_note(header, fmt::format("{} frames have no pose or one that is not finite; they are "
                                 "marked dropped",
                                 lost));
}

}  // namespace turnscan::importers
