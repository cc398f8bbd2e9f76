#pragma once
// All frames in one least-squares problem: they share the axis, and each has one angle. Internal to
// turntable: not installed.

#include <array>
#include <turnscan/turntable/motion_data.hpp>

namespace turnscan::detail {

struct MotionState {
  Vec3d axis = Vec3d::UnitY();   ///< unit, sensor frame
  Vec3d center = Vec3d::Zero();  ///< a point of the axis
  std::vector<double> angle;     ///< per frame of MotionData, radians
  /// Two views of one thing from sides d apart (-pi to pi) seem to be apart by lead[0] d + lead[1]
  /// d |d| more: silhouettes and hidden places pull that way, by some thousandths.
  std::array<double, 2> lead{};

  /// Where a point seen in one frame is when the platter has turned by `angle_rad`.
  Vec3d turned(const Vec3d& p, double angle_rad) const {
    return center + Eigen::AngleAxisd(angle_rad, axis) * (p - center);
  }
};

/// The samples of `from` are looked up in the view of `to`, a key frame.
struct FramePair {
  std::uint32_t from, to;
};

/// What is known of the angles without looking at the object.
struct AngleLaw {
  bool timed = false;               ///< speed changes are small: (angle / time)' is a random walk
  double speed_rad_s = 0.0;         ///< typical, for its scale
  double wander = 0.02;             ///< change of speed in a second, as a share of it
  std::vector<std::uint8_t> loose;  ///< per frame: the table starts or stops there; may be empty
  std::vector<std::uint8_t> still;  ///< per frame: the table stands, at the start or the end
  std::optional<double> stated_rad_s;  ///< mean speed that somebody stated
  double nominal_sigma_rad = 0.0;      ///< of the frames' own angles; 0: none
  double nominal_sign = 1.0;
  std::vector<std::uint8_t> held;  ///< per frame: its angle stays as it is; may be empty
};

struct SolveOptions {
  int iterations = 8;
  double reach_m = 0.02;     ///< partners farther away do not count, at first
  double floor_m = 0.0;      ///< residuals up to this count in full until the end
  std::size_t stride = 1;    ///< use every so manyth sample
  bool hold_angles = false;  ///< leave the angles to the law
  bool hold_axis = false;    ///< axis and centre stay as they are
  bool covariance = false;
  std::optional<double> scale_m;  ///< of the residuals, where it is known
  std::optional<double> unit_m2;  ///< as in MotionSolution, where it is known
};

struct MotionSolution {
  MotionState state;
  double scale_m = 0.0;  ///< robust standard deviation of the residuals
  double unit_m2 = 0.0;  ///< the square that a residual is compared with, correlations considered
  double rms_m = 0.0;
  std::size_t residuals = 0;
  /// -2 times the logarithm of the probability of the data, given the law, up to a constant: what
  /// is lost by a law too narrow against what is gained by having fewer free angles.
  double misfit = 0.0;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< axis (two tilts), centre (across)
  std::vector<double> angle_sigma;
};

/// Point-to-plane distances (Chen and Medioni 1992) between frames, minimised over the axis, a
/// point of it and all angles by Gauss-Newton steps with Huber weights; the normal equations are
/// sparse. Fails with kTooFewPoints when fewer than 100 samples find a partner, kLibrary when the
/// system cannot be solved, kCancelled.
Result<MotionSolution> solve_motion(const MotionData& data, const MotionState& start,
                                    const std::vector<FramePair>& pairs, const AngleLaw& law,
                                    const SolveOptions& options, const RunContext& context);

/// Mean truncated squared distance over the samples of the pair, as a multiple of gate_m squared,
/// with the frames' angles apart by `angle_rad`; samples without a partner count 0.6.
double pair_cost(const MotionData& data, const MotionState& state, const FramePair& pair,
                 double angle_rad, double gate_m, std::size_t most_samples);

/// Partners for each frame among the key frames: close in angle, some tens of degrees away, and a
/// whole number of turns away.
std::vector<FramePair> choose_pairs(const MotionData& data, const std::vector<double>& angle,
                                    bool all_frames);

}  // namespace turnscan::detail
