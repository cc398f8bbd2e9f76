#pragma once
// What a reconstruction gives: meshes, and what was chosen, measured and repaired on the way.

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

/// A parameter as it was used.
struct ResolvedParameter {
  std::string option;  ///< field name, e.g. "voxel-size"
  std::string value;   ///< with unit
  std::string reason;  ///< "given", or what in the data led to it
  int object = -1;     ///< -1: for all objects
};

struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// What a triangle rests on.
enum class Evidence : std::uint8_t {
  kMeasured,
  kInvented,  ///< nothing measured it
  kBase,      ///< closed flat on the platter
  kCut        ///< the face of a cut that was asked for
};

/// How well a vertex of a mesh is known.
struct VertexQuality {
  /// Standard deviation of its distance from the true surface, as far as noise, resolution and
  /// missing measurements go; where the frames stood is taken as right.
  float expected_error_m = 0.0f;
  std::uint16_t frames = 0;     ///< that measured its neighbourhood
  std::uint8_t directions = 0;  ///< sectors of 30 degrees from which they did
};

/// What became of the colour images of a mesh's texture.
struct TextureReport {
  int size_px = 0;              ///< a side of the picture
  double texel_m = 0.0;         ///< side of a texel on the surface, about
  std::size_t charts = 0;       ///< connected parts of the surface in the picture
  double stretch = 1.0;         ///< greatest of a triangle: longer by that in one direction
  double filled_share = 0.0;    ///< of the surface that no image showed, filled from around it
  double one_view_share = 0.0;  ///< of it where images did not fit and one was taken
  std::size_t views = 0;        ///< images that were used
  /// Per view, by which its red, green and blue were multiplied (linear light); mean 1.
  std::vector<Vec3f> gains;
  /// Per view, by how much the object had turned further in its image than in its depth image;
  /// empty: no view was moved for it.
  std::vector<double> turned_rad;
  /// Per sensor with colours that are not registered to depth: by how many pixels its camera was
  /// misplaced (rms over the surface), and the standard deviation of that.
  struct Camera {
    std::uint32_t sensor = 0;
    double misplaced_px = 0.0, moved_m = 0.0, turned_rad = 0.0;
    double deviation_px = 0.0;
    bool refined = false;  ///< false: left as it was
  };
  std::vector<Camera> cameras;
  double disagreement_px = 0.0;  ///< median shift between an image and the best one
  bool albedo = false;           ///< shading was taken out
  /// A lamp's highlight that was taken out: where the lamp stands, and what the surface mirrors of
  /// it at most, of white.
  struct Highlight {
    double azimuth_rad = 0.0;    ///< about the rig's +Y, from -Z, as a virtual scanner's
    double elevation_rad = 0.0;  ///< above the horizontal
    double strength = 0.0;       ///< linear light
  };
  std::optional<Highlight> highlight;

  /// A view that was used: its frame, by position in the sequence.
  struct View {
    std::size_t frame = 0;
    std::uint32_t sensor = 0;
    Vec3f eye = Vec3f::Zero();  ///< where its camera was; frame of the mesh
  };
  static constexpr std::uint16_t kNoView = 0xffff;
  std::vector<View> used;  ///< `views` of them
  /// Which of these gave the picture most of its colour, per square of square_px texels, where the
  /// square lies in the picture. kNoView: no view showed it (it was filled), or no surface is
  /// there.
  Image<std::uint16_t> view_of_square;
  int square_px = 0;
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
  std::vector<VertexQuality> quality;  ///< per vertex, volumetric only; else empty
  /// Per triangle; empty where it is not known, without the repair of methods from points.
  std::vector<Evidence> evidence;
  bool left_open = false;                ///< as asked for: not closed, and no fault
  std::vector<std::string> notes;        ///< what was repaired, for people
  std::optional<TextureReport> texture;  ///< of mesh.texture
  std::optional<Verdict> verdict;        ///< once it was judged (workflow/verdict)
};

/// 1 for each vertex all of whose triangles were measured, as far as the evidence is known.
inline std::vector<std::uint8_t> measured_vertices(const ObjectResult& object) {
  std::vector<std::uint8_t> out(object.mesh.vertices.size(), 1);
  for (std::size_t t = 0; t < object.evidence.size(); ++t)
    if (object.evidence[t] != Evidence::kMeasured)
      for (const std::uint32_t v : object.mesh.triangles[t]) out[v] = 0;
  return out;
}

/// How well the motion of a pass is known that was found from the surfaces.
struct FoundMotion {
  double sigma_m = 0.0, sigma_rad = 0.0;  ///< rms over its surface, and of its rotation
  double overlap_m2 = 0.0;                ///< of its surface that agrees with other passes'
};

/// One of several passes that were fused.
struct FusedPass {
  std::string name;
  Pose T_object_table = Pose::Identity();
  std::size_t frames = 0;
  std::optional<FoundMotion> found;  ///< nullopt: it was given, or is the first
  int object = -1;                   ///< whose mesh it went into; -1: that of all
};

struct SeenSpace;

struct Reconstruction {
  std::vector<ObjectResult> objects;  ///< largest first
  std::vector<ResolvedParameter> choices;
  std::vector<StageTime> stages;
  std::vector<FusedPass> passes;  ///< empty: there was but one
  std::vector<std::string> notes;
  std::size_t frames = 0, dropped_frames = 0;
  std::uint64_t returns = 0;              ///< of all frames, before the crop
  std::uint64_t inside_crop = 0;          ///< of these
  std::uint64_t points = 0;               ///< of these, what the outlier filter kept
  std::shared_ptr<const SeenSpace> seen;  ///< if asked for
  double sensor_noise_m = 0.0, merged_noise_m = 0.0, frame_spacing_m = 0.0, voxel_size_m = 0.0;
};

/// Called with a stage's cloud (all objects together), table frame.
using StageSink = std::function<Result<>(const std::string& stage, const PointCloud& cloud)>;

}  // namespace turnscan
