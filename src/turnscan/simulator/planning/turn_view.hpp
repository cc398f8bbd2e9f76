#pragma once
// What one turn in front of a sensor shows of the spots of a surface, and how well.

#include <span>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/sensors/scanner_model.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/planning/plan_surface.hpp>
#include <vector>

namespace turnscan::planning {

/// Predicted sigma of a scanner's samples at steps of distance, incidence and albedo.
class SigmaSteps {
 public:
  /// noise: as `--noise`. Fails as parse_noise_options() and SensorNoise::create().
  static Result<SigmaSteps> create(const ScannerModel& model, const NoiseOptions& noise);
  /// Along z; NaN where nothing returns.
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
  const Scene* scene = nullptr;  ///< object and platter as the object lies; table frame, angle 0
  Pose T_table_surface = Pose::Identity();  ///< takes spots to that frame
  std::span<const Pose> T_table_sensor;     ///< of directions of the turn
  double frames_per_direction = 1.0;        ///< how many frames each stands for
};

/// What a turn shows of a spot. Sums over the frames that see it.
struct SpotSight {
  float missed = 1.0f;    ///< chance that no sample of any frame falls on the cell
  float cosines = 0.0f;   ///< of the incidence: frames, each as seen from the front
  float weights = 0.0f;   ///< cosine / sigma^2, 1/m^2
  float steps_m2 = 0.0f;  ///< squared distance of samples at the object, times cosine

  /// That the coverage map counts the cell.
  float chance() const { return 1.0f - missed; }
  bool seen() const { return missed < 0.5f; }
  SpotSight& operator+=(const SpotSight& o);
};

/// One entry a spot. A spot is tried at its middle; where that shows nothing, at its further
/// points, each of which stands for its part of the cell. As of SampleTracer, a sample counts when
/// it is in view, in range, flat by no more than the scanner's largest incidence, and seen by both
/// eyes; it has to have a sigma, too. Samples of a frame lie on a grid, at random to the cell: a
/// cell on which h of them are to be expected gets none with the chance max(0, 1 - h).
std::vector<SpotSight> turn_sights(const PlanSurface& surface, const TurnView& view);

/// One entry a frame: where the sensor is seen from the table as that turns, of at most `most`
/// frames, evenly spread. T_world_sensor as of scanner_pose().
std::vector<Pose> turn_directions(std::span<const double> angles_rad, const Pose& T_world_table,
                                  const Pose& T_world_sensor, std::size_t most);

}  // namespace turnscan::planning
