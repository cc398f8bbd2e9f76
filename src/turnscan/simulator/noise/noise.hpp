#pragma once
// Converts the ideal samples of a scanner to measurements.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/sensors/scanner_model.hpp>
#include <turnscan/simulator/sampling/samples.hpp>
#include <vector>

namespace turnscan {

enum class NoiseKind {
  kNone,
  kGaussian,  ///< one sigma for all samples
  kModel,     ///< the formulae of the scanner's NoiseModel
  kPhysics    ///< NoiseModel::physics
};

inline constexpr int kMaxNoiseWindow_px = 31;
inline constexpr double kMaxFattening_px = 15.0;

struct NoiseOptions {
  NoiseKind kind = NoiseKind::kNone;
  double sigma_m = 0.0;  ///< for kGaussian
  /// kNone and kGaussian only. Share of the silhouette's pixels (0 to 1) that are placed randomly
  /// between the edge and the background, at most mixed_reach behind the edge: a simplified model
  /// of mixed pixels that needs no rays. kModel and kPhysics mix what the pixel really sees.
  double mixed_pixels = 0.0;
  double mixed_reach_m = 0.08;
  /// For scanners that match patterns (structured light, stereo). kModel: side of the window whose
  /// pixels determine one disparity, so that errors of neighbours are correlated. All kinds: number
  /// of pixels by which the foreground grows over its edges.
  int window_px = 1;
  double edge_fattening_px = 0.0;
  /// For time-of-flight scanners: the error of half the light's path is wiggling * sin(2 pi * half
  /// path / period).
  double wiggling_m = 0.0;
  double wiggling_period_m = 1.0;
};

/// A pixel with a hit is a silhouette pixel if one of its four neighbours has none, or one farther
/// away by more than this. Two neighbours on the platter never are.
inline constexpr double kSilhouetteStep_m = 0.02;

/// "none", "gaussian:SIGMA" (SIGMA a length up to 1 m), "model" or "physics". Fails with
/// kInvalidOption.
Result<NoiseOptions> parse_noise_options(std::string_view text);

/// Share of the scanner's light, 0 to 1, that a triangle of an object of a body reflects.
using Albedo =
    std::function<float(std::uint32_t body, std::uint32_t object, std::uint32_t triangle)>;
inline constexpr double kDefaultAlbedo = 0.8;  ///< of surface without colour

/// Albedo of each triangle: mean luminance of its corners' colours (linear light); empty if the
/// mesh has none.
std::vector<float> triangle_albedos(const TriangleMesh& mesh);

/// State of the scene and the scanner at one moment of an exposure.
struct SensorMoment {
  std::vector<Body> bodies;
  Pose T_world_sensor = Pose::Identity();
  SampleGrid exact;  ///< as from SampleTracer::trace
};
/// Moments of an exposure, evenly spaced. As many as a Kinect v2 takes images for one frame.
inline constexpr std::size_t kExposureMoments = 9;

/// Viewpoint and scene of a frame. All references must outlive the call it is passed to.
struct SensorView {
  const SampleTracer& tracer;
  std::span<const Body> bodies;
  const Pose& T_world_sensor;
  const Albedo* albedo = nullptr;  ///< nullptr: kDefaultAlbedo everywhere
  /// Empty: instantaneous. Else kExposureMoments; bodies, pose and exact samples are those of the
  /// middle one.
  std::span<const SensorMoment> moments = {};
  double too_far_m = 0.0;  ///< added to each depth
};

/// Measurements of one view: arrays over the rectangle of the exact samples, row by row.
struct MeasuredGrid {
  PixelRect rect;
  std::vector<float> z;        ///< along the optical axis, metres; 0: no return
  std::vector<Miss> miss;      ///< kNone where z > 0
  std::vector<float> sigma_m;  ///< predicted, along z; on request; 0 if nothing is predicted
};

/// Immutable; apply() may be called from several threads at once. A value depends only on the
/// scanner, the options and (seed, scanner index, frame, pixel); speckle on the seed, the point of
/// the surface and the direction to the camera.
class SensorNoise {
 public:
  /// Fails with kInvalidOption if an option or a parameter of the model is out of range, or if
  /// physics is requested for a scanner that has no such model or lacks its parameters.
  static Result<SensorNoise> create(const ScannerModel& model, const NoiseOptions& options,
                                    std::uint64_t seed, std::uint32_t scanner_index);
  SensorNoise(SensorNoise&&) noexcept;
  SensorNoise& operator=(SensorNoise&&) noexcept;
  ~SensorNoise();

  /// exact: from view.tracer.trace(view.bodies, view.T_world_sensor), of the same scanner. Mixed
  /// pixels and laser lines trace more rays. measured is overwritten, on the calling thread.
  void apply(const SensorView& view, const SampleGrid& exact, std::uint32_t frame,
             MeasuredGrid& measured, bool with_sigma = false) const;

  /// One sigma along z of a single sample (see noise_model.hpp); NaN if none is expected.
  double predicted_sigma_m(double z_m, double incidence_rad, double albedo = kDefaultAlbedo) const;

 private:
  struct Impl;
  explicit SensorNoise(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

/// f * b of a scanner, pixel * metres: from the camera's fx and the distance of its eyes; for a
/// laser line, from its own camera and the receiver's distance from the light sheet. 0 with one
/// eye.
double focal_baseline(const ScannerModel& model);

}  // namespace turnscan
