#pragma once
// All user options of a reconstruction.

#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/reconstruction/options/finish_options.hpp>
#include <turnscan/reconstruction/options/outlier_options.hpp>
#include <turnscan/reconstruction/options/point_options.hpp>
#include <turnscan/reconstruction/options/surface_options.hpp>
#include <turnscan/reconstruction/options/texture_options.hpp>
#include <turnscan/reconstruction/options/volumetric_options.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <vector>

namespace turnscan {

struct ReconstructOptions {
  CropOptions crop;
  OutlierOptions outliers;
  MergeOptions merge;
  VoxelOptions voxels;
  CandidateOptions candidates;
  ComponentOptions components;
  NormalOptions normals;
  RefineOptions refine;
  BaseOptions base;
  SurfaceOptions surface;
  VolumetricOptions volumetric;
  FinishOptions finish;
  TextureOptions texture;
  bool color = false;
  /// Keeps all points in memory and passes them to the sink as the stage merged. Otherwise the
  /// methods from points keep only sums, and the sink gets the later stages.
  bool keep_points = false;
  /// Reconstruct only for aligning another pass: the result gets its SeenSpace, but no quality, and
  /// no smooth surface where no frame measured one; volumetric method only.
  bool for_placing = false;
};

/// One group per stage, e.g. "voxels": for the command line, a TOML file and the manual.
std::vector<OptionGroup> describe_stages(ReconstructOptions& options);
OptionTable describe(ReconstructOptions& options);

/// Names of the options that the method does not use.
std::vector<std::string> options_of_others(SurfaceMethod method);
/// The unused options that differ from their defaults.
std::vector<std::string> unused_options(const ReconstructOptions& options);

/// Stages whose cloud can be saved: merged, sub-voxels (with sub-voxel counting), voxels,
/// candidates, refined, oriented; fitted (volumetric only: vertices, weighted by their support).
const std::vector<std::string>& saveable_stages();
/// The saveable stages of a method.
std::vector<std::string> saveable_stages(SurfaceMethod method);

}  // namespace turnscan
