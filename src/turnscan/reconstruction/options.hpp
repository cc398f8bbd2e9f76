#pragma once
// Everything that a person may choose about a reconstruction.

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
  /// For the sink's stage merged: all points stay in memory, and the sink gets them. Otherwise the
  /// methods from points keep sums only, and the sink gets the later stages.
  bool keep_points = false;
  /// Only what another pass is laid against: the result gets its SeenSpace, and neither a quality
  /// nor a smooth surface where no frame measured one; volumetric method only.
  bool for_placing = false;
};

/// A group for each stage, e.g. "voxels": for the command line, a TOML file and the manual.
std::vector<OptionGroup> describe_stages(ReconstructOptions& options);
OptionTable describe(ReconstructOptions& options);

/// Names of the options that the method does not use.
std::vector<std::string> options_of_others(SurfaceMethod method);
/// Those of them that are not at their defaults.
std::vector<std::string> unused_options(const ReconstructOptions& options);

/// Stages whose cloud can be saved: merged, voxels, candidates, refined, oriented;
/// fitted (volumetric only: vertices, weighted by their support).
const std::vector<std::string>& saveable_stages();
/// Those that a method has.
std::vector<std::string> saveable_stages(SurfaceMethod method);

}  // namespace turnscan
