#pragma once
// How much better a disturbance explains where the keyframes lie.

#include <turnscan/turntable/placement/disturbance_model.hpp>
#include <turnscan/turntable/placement/pose_graph.hpp>

namespace turnscan::placement {

/// What one pair of keyframes says of the twist of `from` minus that of `to`, as information: what
/// errors that its points share make of it is in it.
struct RelativeTwist {
  FramePair pair{0, 0};
  Matrix6d information = Matrix6d::Zero();
  Twist right = Twist::Zero();
  double apart_rad = 0.0;  ///< between the views
  double shown = 0.0;      ///< how many of the six unknowns it says something of
};

/// What a frame shows of the platter's tilt: the level parts (x, z) of its axis in the table frame.
struct PlatterTilt {
  std::size_t frame = 0;
  Eigen::Matrix<double, 2, 3> to_level = Eigen::Matrix<double, 2, 3>::Zero();  ///< from the sensor
  Eigen::Vector2d level = Eigen::Vector2d::Zero();
};

struct ModelFit {
  std::vector<DisturbanceModel> models;  ///< with values
  double gain = 0.0;                     ///< of chi square by all of them together, of pairs
  double tilt_gain = 0.0;                ///< and of the platter's tilts
  double spread = 1.0;                   ///< of what a pair says beside them, over what is expected
  std::vector<double> sizes_m;           ///< of each model: how far it moves the object's points
};

class Evidence {
 public:
  /// What the free graph says of the frames' places relative to `believed`.
  Evidence(const Keyframes& frames, const PoseGraph& graph, const std::vector<Pose>& believed,
           std::vector<ModelFrame> model_frames, const ModelScene& scene);

  /// Least squares for the unknowns of all models together.
  ModelFit fit(std::vector<DisturbanceModel> models) const;

  /// By how much more each of the candidates, added to the models, lowers chi square.
  std::vector<double> gains(const std::vector<DisturbanceModel>& models,
                            const std::vector<DisturbanceModel>& candidates) const;

  /// Robust standard deviation of a residual.
  double scale_m() const { return scale_m_; }

 private:
  struct System;

  void find_excess(const PoseGraph& graph);
  void find_tilts(const Keyframes& frames, const std::vector<Pose>& believed);
  System system_of(const std::vector<DisturbanceModel>& models) const;
  double spread_of(const System& system, const Eigen::VectorXd& values) const;
  double gain_of(const System& system, const DisturbanceModel& candidate) const;

  std::vector<ModelFrame> model_frames_;
  ModelScene scene_;
  std::vector<RelativeTwist> twists_;
  std::vector<PlatterTilt> tilts_;
  /// Directions in which the axis may seem to lean, sensor frame.
  Eigen::Matrix<double, 3, 2> beside_axis_ = Eigen::Matrix<double, 3, 2>::Zero();
  double tilt_sigma_ = 1.0;  ///< of one of them, rad
  double excess_ = 1.0, scale_m_ = 0.0;
};

}  // namespace turnscan::placement
