#pragma once
// How much better a disturbance explains the poses of the keyframes.

#include <turnscan/turntable/placement/disturbance_model.hpp>
#include <turnscan/turntable/placement/pose_graph.hpp>

namespace turnscan::placement {

/// Information of one pair of keyframes about the twist of `from` minus that of `to`; it includes
/// the effect of errors that the pair's points share.
struct RelativeTwist {
  FramePair pair{0, 0};
  Matrix6d information = Matrix6d::Zero();
  Twist right = Twist::Zero();
  double apart_rad = 0.0;  ///< between the viewpoints
  double shown = 0.0;      ///< number of the six unknowns that the pair determines
};

/// Observed tilt of the platter in a frame: the horizontal parts (x, z) of its axis in the table
/// frame.
struct PlatterTilt {
  std::size_t frame = 0;
  Eigen::Matrix<double, 2, 3> to_level = Eigen::Matrix<double, 2, 3>::Zero();  ///< maps from the
                                                                               ///< sensor frame
  Eigen::Vector2d level = Eigen::Vector2d::Zero();
};

struct ModelFit {
  std::vector<DisturbanceModel> models;  ///< with values
  double gain = 0.0;       ///< reduction of chi square of the pairs by all models together
  double tilt_gain = 0.0;  ///< and of the platter's tilts
  double spread = 1.0;     ///< scatter of the pairs about the models, relative to the expected one
  std::vector<double> sizes_m;  ///< of each model: by how far it moves the object's points
};

class Evidence {
 public:
  /// Relates the poses of the free graph to the `believed` poses.
  Evidence(const Keyframes& frames, const PoseGraph& graph, const std::vector<Pose>& believed,
           std::vector<ModelFrame> model_frames, const ModelScene& scene);

  /// Least squares for the unknowns of all models together.
  ModelFit fit(std::vector<DisturbanceModel> models) const;

  /// Further reduction of chi square by each candidate when added to the models.
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
  /// Directions in which the axis may appear to tilt, sensor frame.
  Eigen::Matrix<double, 3, 2> beside_axis_ = Eigen::Matrix<double, 3, 2>::Zero();
  double tilt_sigma_ = 1.0;  ///< of one component, rad
  double excess_ = 1.0, scale_m_ = 0.0;
};

}  // namespace turnscan::placement
