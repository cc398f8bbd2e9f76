#pragma once
// Merges frames into one cloud in the table frame (thesis 3.4.1).

#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/object_partition.hpp>
#include <turnscan/reconstruction/outliers/outliers.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan::voxels {

/// All points of a scan in the table frame, with their viewpoints.
struct MergedCloud {
  PointCloud cloud;                   ///< cloud.frame is set: position of the frame
  std::vector<Viewpoint> viewpoints;  ///< per frame, table frame, with the rotation compensated
  std::uint64_t returns = 0;          ///< valid returns of all frames before the crop
  std::uint64_t inside_crop = 0;      ///< of these
  std::uint64_t kept = 0;             ///< of these, kept by the filter of each frame
  std::size_t frames = 0;             ///< frames used

  /// Unit vector from point i towards the sensor that saw it.
  Vec3f towards_sensor(std::size_t i) const;
};

/// The per-frame part, a pure function of one frame: crop (if any), filter, then transform to the
/// table.
struct FrameRecipe {
  const SequenceHeader* header = nullptr;
  std::vector<RayTable> rays;  ///< per sensor
  std::optional<Cylinder> cylinder;
  OutlierOptions outliers;
  std::optional<Pose> T_object_table;      ///< if set, points are in the object's frame
  const ObjectPartition* share = nullptr;  ///< of its table; nullptr: all of it
};
struct FramePart {
  PointCloud cloud;  ///< table or object's frame
  std::uint64_t returns = 0;
  std::uint64_t inside_crop = 0;  ///< of these
};
Result<FramePart> process_frame(const Frame& frame, const FrameRecipe& recipe,
                                const Pose& T_table_sensor);

/// Appends the points of a frame; its viewpoint is in the table frame. Colours are kept for all
/// points or for none.
void append(const FramePart& part, const Viewpoint& viewpoint, MergedCloud& merged);

}  // namespace turnscan::voxels
