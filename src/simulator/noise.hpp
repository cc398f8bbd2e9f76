#pragma once
// Makes of what a scanner ought to see what it measures.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

struct Body;
struct SampleGrid;
struct ScannerModel;
class SampleTracer;
enum class Miss : std::uint8_t;

enum class NoiseKind {
  kNone,
  kGaussian,  ///< one sigma for all samples
  kModel,     ///< the formulae of the scanner's NoiseModel
  kPhysics    ///< NoiseModel::physics
};

struct NoiseOptions {
  NoiseKind kind = NoiseKind::kNone;
  double sigma_m = 0.0;  ///< of kGaussian
  /// kGaussian only. Share of the silhouette's pixels (0 to 1) that lie anywhere between the edge
  /// and what is behind it, at most mixed_reach behind the edge: a caricature of mixed pixels that
  /// needs no rays. kModel and kPhysics mix what the pixel really sees.
  double mixed_pixels = 0.0;
  double mixed_reach_m = 0.08;
};

/// "none", "gaussian:SIGMA" (SIGMA a length up to 1 m), "model" or "physics". Fails with
/// kInvalidOption.
Result<NoiseOptions> parse_noise_options(std::string_view text);

/// What a scanner measured of one view: arrays over the rectangle of the exact samples, row by row.
struct MeasuredGrid {
  std::vector<float> z;        ///< along the optical axis, metres; 0: no return
  std::vector<Miss> miss;      ///< kNone where z > 0
  std::vector<float> sigma_m;  ///< predicted, along z; filled on request; 0 where there is none
};

/// Immutable; apply() may be called from several threads at once. A value depends on the scanner,
/// the options and (seed, scanner index, frame, pixel) alone.
class SensorNoise {
 public:
  /// Fails with kInvalidOption when an option is out of range, or when physics is asked of a
  /// scanner that has none.
  static Result<SensorNoise> create(const ScannerModel& model, const NoiseOptions& options,
                                    std::uint64_t seed, std::uint32_t scanner_index);
  SensorNoise(SensorNoise&&) noexcept;
  SensorNoise& operator=(SensorNoise&&) noexcept;
  ~SensorNoise();

  /// exact: of tracer.trace(bodies, T_world_sensor). tracer and bodies serve the rays within mixed
  /// pixels. measured is overwritten; its memory is used again.
  void apply(const SampleTracer& tracer, std::span<const Body> bodies, const Pose& T_world_sensor,
             const SampleGrid& exact, std::uint32_t frame, MeasuredGrid& measured,
             bool with_sigma = false) const;

  /// One sigma along z of a single sample (see noise_model.hpp); NaN where none is to be expected.
  double predicted_sigma_m(double z_m, double incidence_rad, double albedo) const;

 private:
  struct Impl;
  explicit SensorNoise(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

}  // namespace turnscan
