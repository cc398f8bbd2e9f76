#pragma once
// What can go wrong in a recording, as a few unknowns that move all its frames.

#include <turnscan/turntable/placement/keyframes.hpp>

namespace turnscan::placement {

enum class ModelKind {
  kCalibration,  ///< the sensor stands elsewhere than believed, all the time
  kSpeed,        ///< the table turns faster or slower than believed
  kSlip,         ///< from one frame on the table has turned by more than believed
  kHalt,         ///< the table turns by less during some frames
  kObject,       ///< from one frame on the object stands elsewhere
  kSensor,       ///< from one frame on the sensor stands elsewhere
  kWobble        ///< the axis leans to changing sides
};

struct DisturbanceModel {
  ModelKind kind = ModelKind::kObject;
  std::size_t first = 0;   ///< position of the first frame that it has moved in full
  std::size_t last = 0;    ///< kHalt: position of the last frame before it began
  double cycles = 1.0;     ///< kWobble: in one turn
  Eigen::VectorXd values;  ///< of the unknowns, metres
  bool held = false;       ///< the values stay as they are
};

/// One frame of the sequence, and what all of them share.
struct ModelFrame {
  std::size_t position = 0;
  double turned_rad = 0.0;  ///< since the first frame, as believed
  Pose T_table_sensor = Pose::Identity();
};

struct ModelScene {
  Vec3d middle = Vec3d::Zero();         ///< of the object, table frame
  Vec3d middle_sensor = Vec3d::Zero();  ///< mean of it, sensor frame
  double lever_m = 0.05;
  double turn_rad = 1.0;  ///< of the whole sequence, as believed
};

using Basis = Eigen::Matrix<double, 6, Eigen::Dynamic>;

Eigen::Index unknowns_of(ModelKind kind);

/// The twist of a frame by each unknown.
Basis basis_of(const DisturbanceModel& model, const ModelFrame& frame, const ModelScene& scene);

/// By how much a wobbling axis leans to a side, rms over its way; model: kWobble.
double wobble_rad(const DisturbanceModel& model, double lever_m);

}  // namespace turnscan::placement
