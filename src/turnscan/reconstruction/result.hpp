#pragma once
// Result of a reconstruction: meshes, and what was chosen, measured and repaired on the way.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <turnscan/core/image.hpp>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/reconstruction/verdict.hpp>
#include <vector>

namespace turnscan {

/// A parameter with the value that was used.
struct ResolvedParameter {
  std::string option;  ///< field name, e.g. "voxel-size"
  std::string value;   ///< with unit
  std::string reason;  ///< "given", or how it follows from the data
  int object = -1;     ///< -1: for all objects
};

struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// Origin of a triangle.
enum class Evidence : std::uint8_t {
  kMeasured,
  kInvented,  ///< not measured
  kBase,      ///< closed flat on the platter
  kCut        ///< the face of a requested cut
};

/// Accuracy of a mesh vertex.
struct VertexQuality {
  /// Standard deviation of its distance from the true surface, due to noise, resolution and missing
  /// measurements; the frames' poses are assumed to be exact.
  float expected_error_m = 0.0f;
  std::uint16_t frames = 0;     ///< number that measured its neighbourhood
  std::uint8_t directions = 0;  ///< number of sectors of 30 degrees from which they did
};

/// Report on a mesh's texture and the colour images used for it.
struct TextureReport {
  int size_px = 0;            ///< side of the texture image
  double texel_m = 0.0;       ///< approximate side of a texel on the surface
  std::size_t charts = 0;     ///< connected parts of the surface in the texture image
  double stretch = 1.0;       ///< largest stretch of a triangle in any direction, as a factor
  double filled_share = 0.0;  ///< share of the surface that no image showed, filled from around it
  double one_view_share = 0.0;  ///< share of it where images did not match and a single one was
                                ///< used
  std::size_t views = 0;        ///< number of images used
  /// Per view, the factors of its red, green and blue (linear light); their mean is 1.
  std::vector<Vec3f> gains;
  /// Per view, rotation of the object between its depth image and its colour image; empty: no view
  /// was corrected for it.
  std::vector<double> turned_rad;
  /// Per sensor whose colours are not registered to depth: correction of its camera in pixels (root
  /// mean square over the surface), and its standard deviation.
  struct Camera {
    std::uint32_t sensor = 0;
    double misplaced_px = 0.0, moved_m = 0.0, turned_rad = 0.0;
    double deviation_px = 0.0;
    bool refined = false;  ///< false: left unchanged
  };
  std::vector<Camera> cameras;
  double disagreement_px = 0.0;  ///< median shift between an image and the best one
  bool albedo = false;           ///< shading was removed
  /// A lamp's highlight that was removed: direction of the lamp, and the maximum that the surface
  /// reflects of it, relative to white.
  struct Highlight {
    double azimuth_rad = 0.0;    ///< about the rig's +Y, from -Z, as in a virtual scanner
    double elevation_rad = 0.0;  ///< above the horizontal
    double strength = 0.0;       ///< linear light
  };
  std::optional<Highlight> highlight;

  /// A view that was used: its frame, by position in the sequence.
  struct View {
    std::size_t frame = 0;
    std::uint32_t sensor = 0;
    Vec3f eye = Vec3f::Zero();  ///< position of its camera; frame of the mesh
  };
  static constexpr std::uint16_t kNoView = 0xffff;
  std::vector<View> used;  ///< all `views` of them
  /// Index of the view that contributed most of the colour, per square of square_px texels of the
  /// texture image. kNoView: no view showed it (it was filled), or there is no surface.
  Image<std::uint16_t> view_of_square;
  int square_px = 0;
};

struct ObjectResult {
  TriangleMesh mesh;
  MeshReport check;
  std::size_t points = 0;          ///< merged points in its voxels
  std::size_t candidates = 0;      ///< of the voxel stage
  std::size_t surface_points = 0;  ///< oriented points passed to the surface stage
  double invented_area_m2 = 0.0;   ///< surface far from any candidate
  double unknown_volume_m3 = 0.0;  ///< behind hollows that no view saw to their floor
  double no_return_area_m2 = 0.0;  ///< part of it that sensors observed without a return; 0 if
                                   ///< hardly any
  bool too_near = false;  ///< most of that is nearer to the sensors than anything they measured
  /// Per vertex, volumetric only: weight of its measurements relative to the median of the mesh, at
  /// most 1. 0 if nothing was measured.
  std::vector<float> confidence;
  std::vector<VertexQuality> quality;  ///< per vertex, volumetric only; else empty
  /// Per triangle; empty if it is not known, as without the repair of methods from points.
  std::vector<Evidence> evidence;
  bool left_open = false;                ///< as requested: not closed, which is not a fault
  std::vector<std::string> notes;        ///< repairs, for display
  std::optional<TextureReport> texture;  ///< of mesh.texture
  std::optional<Verdict> verdict;        ///< set by workflow/verdict
};

/// 1 for each vertex all of whose triangles were measured, as far as the evidence is known.
inline std::vector<std::uint8_t> measured_vertices(const ObjectResult& object) {
  std::vector<std::uint8_t> out(object.mesh.vertices.size(), 1);
  for (std::size_t t = 0; t < object.evidence.size(); ++t)
    if (object.evidence[t] != Evidence::kMeasured)
      for (const std::uint32_t v : object.mesh.triangles[t]) out[v] = 0;
  return out;
}

/// Accuracy of a pass's motion that was found from the surfaces.
struct FoundMotion {
  double sigma_m = 0.0, sigma_rad = 0.0;  ///< root mean square over its surface, and of its
                                          ///< rotation
  double overlap_m2 = 0.0;                ///< part of its surface that agrees with other passes'
};

/// One of several passes that were fused.
struct FusedPass {
  std::string name;
  Pose T_object_table = Pose::Identity();
  std::size_t frames = 0;
  std::optional<FoundMotion> found;  ///< nullopt if the motion was given, or this is the first pass
  int object = -1;                   ///< index of the object that it was fused into; -1: into all
};

struct SeenSpace;

struct Reconstruction {
  std::vector<ObjectResult> objects;  ///< largest first
  std::vector<ResolvedParameter> choices;
  std::vector<StageTime> stages;
  std::vector<FusedPass> passes;  ///< empty if there was only one
  std::vector<std::string> notes;
  std::size_t frames = 0, dropped_frames = 0;
  std::uint64_t returns = 0;              ///< of all frames, before the crop
  std::uint64_t inside_crop = 0;          ///< of these
  std::uint64_t points = 0;               ///< of these, those that the outlier filter kept
  std::shared_ptr<const SeenSpace> seen;  ///< if requested
  double sensor_noise_m = 0.0, merged_noise_m = 0.0, frame_spacing_m = 0.0, voxel_size_m = 0.0;
};

/// Called with a stage's cloud (all objects together), table frame.
using StageSink = std::function<Result<>(const std::string& stage, const PointCloud& cloud)>;

}  // namespace turnscan
