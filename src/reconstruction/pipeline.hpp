#pragma once
// The stages strung together: frames in, one closed mesh per object out.

#include <functional>
#include <map>
#include <turnscan/geometry/mesh_check.hpp>
#include <turnscan/reconstruction/base.hpp>
#include <turnscan/reconstruction/candidates.hpp>
#include <turnscan/reconstruction/components.hpp>
#include <turnscan/reconstruction/merge.hpp>
#include <turnscan/reconstruction/normals.hpp>
#include <turnscan/reconstruction/refine.hpp>
#include <turnscan/reconstruction/surface.hpp>
#include <turnscan/reconstruction/volumetric_options.hpp>
#include <turnscan/reconstruction/voxel_grid.hpp>

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
  bool color = false;
  /// For the sink's stage merged: all points stay in memory, and the sink gets them. Otherwise the
  /// methods from points keep sums only, and the sink gets the later stages.
  bool keep_points = false;
};

/// The options of one stage, for the command line, a TOML table and a page of the manual.
struct StageOptions {
  std::string stage;  ///< e.g. "voxels"
  OptionTable table;
};
std::vector<StageOptions> describe_stages(ReconstructOptions& options);
OptionTable describe(ReconstructOptions& options);

/// A parameter as it was used.
struct Choice {
  std::string option;  ///< field name, e.g. "voxel-size"
  std::string value;   ///< with unit
  std::string reason;  ///< "given", or what in the data led to it
  int object = -1;     ///< -1: for all objects
};

struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

struct ObjectResult {
  TriangleMesh mesh;
  MeshReport check;
  std::size_t points = 0;          ///< merged points in its voxels
  std::size_t candidates = 0;      ///< of the voxel stage
  std::size_t surface_points = 0;  ///< oriented points given to the surface stage
  double invented_area_m2 = 0.0;   ///< surface far from any candidate
  /// Per vertex, volumetric only: what its measurements weigh, over the median of the mesh, at most
  /// 1. 0 where nothing was measured.
  std::vector<float> confidence;
  std::vector<std::string> notes;  ///< what was repaired, for people
};

struct Reconstruction {
  std::vector<ObjectResult> objects;  ///< largest first
  std::vector<Choice> choices;
  std::vector<StageTime> stages;
  std::vector<std::string> notes;
  std::size_t frames = 0, dropped_frames = 0;
  std::uint64_t returns = 0, cropped = 0, points = 0;
  double sensor_noise_m = 0.0, merged_noise_m = 0.0, frame_spacing_m = 0.0;
};

/// Stages whose cloud can be saved: merged, voxels, candidates, refined, oriented;
/// fitted (volumetric only: vertices, weighted by their support).
const std::vector<std::string>& saveable_stages();
/// Those that a method has.
std::vector<std::string> saveable_stages(SurfaceMethod method);
/// Called with a stage's cloud (all objects together), table frame.
using StageSink = std::function<Result<>(const std::string& stage, const PointCloud& cloud)>;

/// Runs the stages. sink may be empty. Fails with kTooFewPoints when nothing survives (and says at
/// which stage), kMissingData, kInvalidOption, kCancelled, and what the sequence fails with.
/// With surface.repair every mesh is watertight, or the error says which is not and why not.
Result<Reconstruction> reconstruct(const FrameSequence& sequence, const ReconstructOptions& options,
                                   const StageSink& sink, const RunContext& context);

/// JSON of what was done: counts, choices, times, mesh checks, peak memory, version.
std::string report_json(const Reconstruction& reconstruction, const ReconstructOptions& options);

}  // namespace turnscan
