#pragma once
// Models of the disturbances of a recording, each with a few unknowns that move all frames.

#include <turnscan/turntable/placement/keyframes.hpp>

namespace turnscan::placement {

enum class ModelKind {
  kCalibration,  ///< the sensor's pose differs from the assumed one all the time
  kSpeed,        ///< the table turns faster or slower than assumed
  kSlip,         ///< from one frame on, the table has turned by more than assumed
  kHalt,         ///< the table turns by less during some frames
  kObject,       ///< from one frame on, the object has moved
  kSensor,       ///< from one frame on, the sensor has moved
  kWobble        ///< the axis tilts in changing directions
};

struct DisturbanceModel {
  ModelKind kind = ModelKind::kObject;
  std::size_t first = 0;   ///< position of the first frame that is fully affected
  std::size_t last = 0;    ///< kHalt: position of the last frame before the stop
  double cycles = 1.0;     ///< kWobble: number per turn
  Eigen::VectorXd values;  ///< of the unknowns, metres
  bool held = false;       ///< the values are kept fixed
};

/// One frame of the sequence.
struct ModelFrame {
  std::size_t position = 0;
  double turned_rad = 0.0;  ///< since the first frame, as assumed
  Pose T_table_sensor = Pose::Identity();
};

struct ModelScene {
  Vec3d middle = Vec3d::Zero();         ///< of the object, table frame
  Vec3d middle_sensor = Vec3d::Zero();  ///< its mean in the sensor frame
  double lever_m = 0.05;
  double turn_rad = 1.0;  ///< of the whole sequence, as assumed
};

using Basis = Eigen::Matrix<double, 6, Eigen::Dynamic>;

Eigen::Index unknowns_of(ModelKind kind);

/// The twist of a frame for each unknown.
Basis basis_of(const DisturbanceModel& model, const ModelFrame& frame, const ModelScene& scene);

/// Tilt of a wobbling axis, root mean square over its cycle; model: kWobble.
double wobble_rad(const DisturbanceModel& model, double lever_m);

}  // namespace turnscan::placement
