#pragma once
// The volumetric method: from the integrated views to closed meshes.

#include <turnscan/reconstruction/options/volumetric_options.hpp>
#include <turnscan/reconstruction/quality/touching.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/reconstruction/tsdf/integrator.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>
#include <turnscan/reconstruction/voxels/merge.hpp>

namespace turnscan::tsdf {

/// Input of the volumetric method.
struct VolumetricInput {
  std::vector<views::DepthView> views;  ///< all, or as many as are kept, evenly spread
  double noise_m = 0.0;                 ///< of a depth value along its ray
  double seen_past_m = 0.0;             ///< see estimation/free_space_violation.hpp
  double spacing_m = 0.0;               ///< of the points of one frame
  /// Distance between samples over spacing_m. A camera's many frames sample between each other's
  /// pixels; a few range scans do not.
  double cells_of_spacing = 0.42;
  /// Share of a pixel's neighbours in its depth, see sensor_filter.hpp; nullopt: from the first
  /// mesh.
  std::optional<double> filter_share = 0.0;
  bool profiles = false;             ///< from a line scanner: views are parts of one long scan
  bool colored = false;              ///< the mesh gets the views' colours
  bool measured_only = false;        ///< see ReconstructOptions::for_placing
  std::optional<double> cell_m;      ///< distance between samples; nullopt: from the spacing
  std::optional<int> grid;           ///< alternatively: samples along the longest side
  int keep = 0;                      ///< maximum number of pieces, the largest ones; 0: all
  double gap_m = 0.0;                ///< components closer than this are one piece
  std::optional<Cylinder> cylinder;  ///< the object is inside it, on the platter at y = 0
  std::vector<Platter> platters;     ///< used instead with several passes
};

/// A reconstructed object.
struct VolumetricPiece {
  TriangleMesh mesh;
  std::vector<float> support;          ///< per vertex: sum of the weights of its measurements
  std::optional<double> noise_share;   ///< MeshFit::noise_share of its first component
  std::vector<float> confidence;       ///< per vertex: support over its median, at most 1
  std::vector<VertexQuality> quality;  ///< per vertex
  std::vector<Evidence> evidence;      ///< per triangle
  double invented_area_m2 = 0.0;   ///< where vertices have a fiftieth of the usual support or less
  double base_area_m2 = 0.0;       ///< closed flat on the platter
  double no_return_area_m2 = 0.0;  ///< part of the invented area that sensors observed without a
                                   ///< return
  double too_near_area_m2 = 0.0;   ///< part of that which is nearer to them than anything measured
  double nearest_m = 0.0;          ///< smallest depth that was measured
  double unknown_volume_m3 = 0.0;  ///< behind hollows that no view saw to their floor
  std::optional<quality::Neck> neck;  ///< on a platter: section at which it may be two touching
                                      ///< objects
  std::size_t points = 0;             ///< number measured in the bounding box of the piece
  std::size_t detached = 0;  ///< number of components that no frame shows to be connected to the
                             ///< rest
};
struct VolumetricResult {
  std::vector<VolumetricPiece> pieces;  ///< largest area first
  std::size_t left_out = 0;             ///< number of pieces with hardly any measurements
  double filter_share = 0.0;            ///< as given or estimated
  std::vector<StageTime> stages;
};

/// Points inside the cylinder of up to about 64 views spread over the input, without edges, with
/// the views as frames.
voxels::MergedCloud sample_points(const VolumetricInput& input);
/// Their bounding box without the outermost ones, which may be outliers. Empty if there are no
/// points.
Box measured_box(const VolumetricInput& input);

/// Lengths that follow from the data, with their reasons.
struct VolumetricScale {
  VolumeScale volume;
  double fit_reach_m = 0.0;
  std::vector<ResolvedParameter> choices;
};
VolumetricScale choose_scale(const VolumetricInput& input, const VolumetricOptions& options,
                             const Box& box);

/// Closed, 2-manifold, outward pieces from all integrated views. Components with less than
/// min_share of the largest one's area are dropped. Fails with kTooFewPoints if no surface is
/// found, with kResourceLimit, kCancelled.
Result<VolumetricResult> reconstruct_volume(const VolumetricInput& input,
                                            const VolumetricScale& scale,
                                            const Integrator& integrator,
                                            const VolumetricOptions& options, double min_share,
                                            const RunContext& context);

}  // namespace turnscan::tsdf
