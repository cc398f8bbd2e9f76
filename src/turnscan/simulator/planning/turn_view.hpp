#pragma once
// What one turn in front of a sensor shows of the spots of a surface, and with which accuracy.

#include <span>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/sensors/scanner_model.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/planning/plan_surface.hpp>
#include <vector>

namespace turnscan::planning {

/// Predicted sigma of a scanner's samples, tabulated over distance, incidence and albedo.
class SigmaSteps {
 public:
  /// noise: as for `--noise`. Fails as parse_noise_options() and SensorNoise::create().
  static Result<SigmaSteps> create(const ScannerModel& model, const NoiseOptions& noise);
  /// Along z; NaN if nothing returns.
  float at(float z_m, float cosine, std::uint8_t albedo_step) const;

 private:
  static constexpr int kDistances = 128, kAngles = 64;
  float near_ = 0.0f, scale_ = 1.0f;
  std::vector<float> values_;
};

/// A turn of the object in one pose in front of one sensor.
struct TurnView {
  const ScannerModel* model = nullptr;
  const SigmaSteps* sigma = nullptr;
  const Scene* scene = nullptr;  ///< object and platter in this pose; table frame, angle 0
  Pose T_table_surface = Pose::Identity();  ///< maps spots to that frame
  std::span<const Pose> T_table_sensor;     ///< for the directions of the turn
  double frames_per_direction = 1.0;        ///< number of frames that each represents
};

/// Observation of a spot during a turn. Sums over the frames that see it.
struct SpotSight {
  float missed = 1.0f;    ///< probability that no sample of any frame falls on the cell
  float cosines = 0.0f;   ///< of the incidence: equivalent number of frontal frames
  float weights = 0.0f;   ///< cosine / sigma^2, 1/m^2
  float steps_m2 = 0.0f;  ///< squared distance of samples on the object, times cosine

  /// Probability that the coverage map counts the cell.
  float chance() const { return 1.0f - missed; }
  bool seen() const { return missed < 0.5f; }
  SpotSight& operator+=(const SpotSight& o);
};

/// One entry per spot. A spot is tested at its middle; if that is not seen, at its further points,
/// each of which represents its part of the cell. As in SampleTracer, a sample counts if it is in
/// view, in range, within the scanner's largest incidence, and seen by both eyes; it must also have
/// a sigma. Samples of a frame lie on a grid at a random offset to the cell: a cell with an
/// expected number h of samples gets none with the probability max(0, 1 - h).
std::vector<SpotSight> turn_sights(const PlanSurface& surface, const TurnView& view);

/// Poses of the sensor relative to the turning table, one per frame, for at most `most` frames,
/// evenly spread. T_world_sensor as from scanner_pose().
std::vector<Pose> turn_directions(std::span<const double> angles_rad, const Pose& T_world_table,
                                  const Pose& T_world_sensor, std::size_t most);

}  // namespace turnscan::planning
