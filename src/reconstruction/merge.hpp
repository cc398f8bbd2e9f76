#pragma once
// From frames to one cloud in the table frame (thesis 3.4.1).

#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/outliers.hpp>
#include <turnscan/turntable/crop.hpp>

namespace turnscan {

struct MergeOptions {
  std::optional<double> speed_rad_s;
  bool cloud_outliers = false;  ///< a second statistical filter, on the merged cloud
  std::optional<int> pass;      ///< only the frames in which the object lies this way
};
OptionTable describe(MergeOptions& options);

/// All points of a scan in the table frame, with where each was seen from.
struct MergedCloud {
  PointCloud cloud;                   ///< cloud.frame is set: position of the frame
  std::vector<Viewpoint> viewpoints;  ///< per frame, table frame, the turn taken out
  std::uint64_t returns = 0;          ///< valid returns of all frames before the crop
  std::uint64_t cropped = 0;          ///< of these, inside the cylinder
  std::uint64_t kept = 0;             ///< of these, kept by the filter of each frame
  std::size_t frames = 0;             ///< frames used

  /// Unit vector from point i towards the sensor that saw it.
  Vec3f towards_sensor(std::size_t i) const;

  /// Calls visit(k, i) for the points i = order[k] of [begin, end). Points that are neighbours in
  /// space come from frames that lie far apart in memory: those ahead are asked for in time.
  template <class Visit>
  void for_each_of(const std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end,
                   const Visit& visit) const {
    constexpr std::size_t kAhead = 16;
    for (std::size_t k = begin; k < end; ++k) {
      if (k + kAhead < order.size()) {
        __builtin_prefetch(&cloud.points[order[k + kAhead]]);
        __builtin_prefetch(&cloud.frame[order[k + kAhead]]);
      }
      visit(k, order[k]);
    }
  }
};

/// The per-frame part: a pure function of one frame. Crop (if any), filter, then to the table.
struct FrameRecipe {
  const SequenceHeader* header = nullptr;
  std::vector<RayTable> rays;  ///< per sensor
  std::optional<Cylinder> cylinder;
  OutlierOptions outliers;

  static FrameRecipe make(const SequenceHeader& header);
};
struct FramePart {
  PointCloud cloud;  ///< table frame
  std::uint64_t returns = 0, cropped = 0;
};
Result<FramePart> process_frame(const Frame& frame, const FrameRecipe& recipe,
                                const Pose& T_table_sensor);

/// Joins what a frame gave; its viewpoint is in the table frame. Colours are kept for all points or
/// for none.
void append(const FramePart& part, const Viewpoint& viewpoint, MergedCloud& merged);

}  // namespace turnscan
