#pragma once
// The implementations of the noise kinds, and their common parts.

#include <turnscan/core/camera.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/noise/noise_kernel.hpp>
#include <vector>

namespace turnscan::noise {

inline constexpr int kMixedPixelRays = 4;  ///< rows and columns of rays through a mixed pixel

/// Data that do not change from frame to frame.
struct Setup {
  ScannerModel model;
  NoiseOptions options;
  std::uint64_t seed = 0;
  std::uint32_t scanner = 0;
  double focal_baseline = 0.0;
  RayTable rays;  ///< of all pixels

  std::size_t pixel(int column, int row) const {
    return std::size_t(row) * std::size_t(model.camera.width) + std::size_t(column);
  }
};

/// One call of SensorNoise::apply.
struct Job {
  const Setup& setup;
  const SensorView& view;
  const SampleGrid& exact;
  std::uint32_t frame;
  MeasuredGrid& out;  ///< sized; z and miss are initialised to no hit

  /// Seed of the random numbers for one purpose.
  std::uint64_t seed_of(std::uint64_t purpose) const {
    return hash_key(setup.seed, setup.scanner, frame, purpose);
  }
  Key key_of(std::uint64_t purpose) const;
};

/// Orientation of surfaces to the line of sight, and their albedo.
class Surfaces {
 public:
  explicit Surfaces(const SensorView& view);
  /// Unit normal in the sensor frame, of either sign; zero for a triangle without area.
  /// Precondition: samples.hit(i).
  Vec3d normal(const Samples& samples, std::size_t i) const;
  /// Cosine between line of sight (x, y, 1) and normal, 0 to 1. Precondition: samples.hit(i).
  double facing(const Samples& samples, std::size_t i, double x, double y) const;
  double albedo(const Samples& samples, std::size_t i) const;

 private:
  const SensorView& view_;
  std::vector<Eigen::Matrix3d> R_sensor_body_;
};

/// Flags of the samples that count, as an array of 0 and 1.
using Mask = std::vector<std::uint8_t>;

/// Pixels whose surface may not be planar: next to one without a hit (by counts), or where depth
/// bends by more than kBend_m within three pixels; and all within radius pixels of such.
Mask steps_of(const SampleGrid& exact, const Mask& counts, int radius);
inline constexpr float kBend_m = 0.002f;

/// Rays within pixels, traced together.
struct SubSamples {
  std::vector<std::uint32_t> index;  ///< index in the grid, per pixel
  std::vector<float> x, y;           ///< directions, `each` per pixel
  Samples samples;
  std::size_t each = 1;

  /// Adds side x side rays over a square of footprint_px about the pixel's centre shifted by (du,
  /// dv).
  void add(const Setup& setup, int column, int row, std::size_t index_in_grid, int side,
           double footprint_px, double du, double dv);
};

/// One sigma for all; with NoiseOptions::mixed_pixels the simplified model of a silhouette.
void apply_gaussian(Job& job);
/// The formulae of NoiseModel.
void apply_formulae(Job& job);
/// Removes samples that a dot matcher would not find (NoiseModel::window_px).
void match_windows(Job& job);
/// Kinect v2.
void apply_time_of_flight(Job& job);
void apply_laser_line(Job& job);
/// Blurs the measurement of the middle of an exposure over its moments.
void blur(Job& job);
bool matches_patterns(const ScannerModel& model);
/// Lets the foreground grow over its edges.
void fatten_edges(Job& job);
/// Standard normals over the exact samples' rectangle, each the sum over a window about its pixel:
/// the correlation of pixels dx and dy apart is the overlapping share of their windows.
std::vector<float> window_normals(const Job& job, std::uint64_t purpose);
/// Adds the systematic errors: wiggling, and the view's too_far_m.
void add_systematic(Job& job);
/// Fills out.sigma_m.
void predict(Job& job);
/// One sigma along z; NaN if none is expected.
double predicted_sigma_m(const Setup& setup, double z_m, double incidence_rad, double albedo);

}  // namespace turnscan::noise
