#pragma once
// Options of the stages from frames to candidate points (thesis 3.4).

#include <cstdint>
#include <optional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan {

struct MergeOptions {
  std::optional<double> speed_rad_s;
  bool cloud_outliers = false;  ///< a second statistical filter, on the merged cloud
  std::optional<int> pass;      ///< only the frames of this pass

  /// The pass as frames count it; nullopt: all.
  std::optional<std::uint32_t> chosen_pass() const {
    return pass ? std::optional(std::uint32_t(*pass)) : std::nullopt;
  }
};
OptionTable describe(MergeOptions& options);

struct VoxelOptions {
  std::optional<double> size_m;  ///< edge of a voxel
  std::optional<int> grid;  ///< alternatively: voxels along the longest side of the extent in the
                            ///< first frames
  std::optional<int> min_points;  ///< M: voxels with fewer points are dropped
  bool in_bounds = false;         ///< the grid fills the bounding box of all points (thesis 3.4.2)
};
OptionTable describe(VoxelOptions& options);

enum class CandidateMethod { kCentroid, kSubVoxel };
enum class SubVoxelLine { kChord, kTowardsSensor };

struct CandidateOptions {
  CandidateMethod method = CandidateMethod::kCentroid;
  int subdivisions = 4;  ///< s: a voxel is split into s^3 sub-voxels
  SubVoxelLine line = SubVoxelLine::kChord;
};
OptionTable describe(CandidateOptions& options);

struct ComponentOptions {
  std::string keep = "all";     ///< "all", "largest" or a number N: the N largest
  double min_share = 0.02;      ///< smaller pieces, relative to the largest, are dropped as crumbs
  std::optional<double> gap_m;  ///< pieces closer than this belong together
};
OptionTable describe(ComponentOptions& options);

/// Number of objects; 0 means all. Fails with kInvalidOption unless keep is all, largest or a
/// positive number.
Result<int> objects_to_keep(const ComponentOptions& options);

struct NormalOptions {
  std::optional<double> radius_m;
};
OptionTable describe(NormalOptions& options);

struct RefineOptions {
  bool enabled = true;
  std::optional<double> radius_m;  ///< tangential reach (standard deviation of the weight)
  int iterations = 3;
};
OptionTable describe(RefineOptions& options);

struct BaseOptions {
  bool enabled = true;
};
OptionTable describe(BaseOptions& options);

}  // namespace turnscan
