#pragma once
// Reconstruction by signed distances of all frames, with what each ray passed through.

#include <turnscan/core/option_table.hpp>
#include <turnscan/reconstruction/depth_view.hpp>
#include <turnscan/reconstruction/mesh_fit.hpp>
#include <turnscan/reconstruction/volume.hpp>
#include <turnscan/turntable/crop.hpp>

namespace turnscan {

struct VolumetricOptions {
  std::optional<double> truncation_m;  ///< along the rays, around each sample
  int field_frames = 256;              ///< the volume takes at most so many, evenly spread
  bool fit = true;                     ///< move the vertices onto all frames' measurements
  std::optional<double> fit_reach_m;
  int fit_iterations = 3;
  std::optional<int> triangles;  ///< at most so many
};
OptionTable describe(VolumetricOptions& options);

/// What the volumetric method is told about the data.
struct VolumetricInput {
  std::vector<DepthView> views;
  double noise_m = 0.0;              ///< of a depth along its ray
  double spacing_m = 0.0;            ///< of the points of one frame
  std::optional<double> cell_m;      ///< distance between samples; nullopt: from the spacing
  std::optional<int> grid;           ///< or: samples along the longest side
  int keep = 0;                      ///< largest pieces that are kept; 0: all
  std::optional<Cylinder> cylinder;  ///< the object stands in it, on the platter at y = 0
};

struct VolumetricChoice {
  std::string option, value, reason;
};

struct VolumetricPiece {
  TriangleMesh mesh;
  std::vector<float> support;     ///< per vertex: sum of the weights of its measurements
  double invented_area_m2 = 0.0;  ///< where vertices have a fiftieth of the usual support or less
  double base_area_m2 = 0.0;      ///< closed flat on the platter
  std::size_t points = 0;         ///< measured, in the box of the piece
};
struct VolumetricResult {
  std::vector<VolumetricPiece> pieces;  ///< largest area first
  std::vector<VolumetricChoice> choices;
  std::vector<std::pair<std::string, double>> seconds;
  double cell_m = 0.0;
};

/// Points inside the cylinder of up to about 64 views spread over the input, edges left out.
std::vector<Vec3f> sample_points(const VolumetricInput& input);

/// Closed, 2-manifold, outward pieces. Fails with kTooFewPoints when no surface is found,
/// kResourceLimit, kCancelled.
Result<VolumetricResult> reconstruct_volume(const VolumetricInput& input,
                                            const VolumetricOptions& options, double min_share,
                                            const RunContext& context);

}  // namespace turnscan
