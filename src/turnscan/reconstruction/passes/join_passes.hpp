#pragma once
// Brings the passes of one object together: finds how it lay in each, from its shape alone, or says
// why its shape does not tell.

#include <span>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::passes {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct PassMotion {
  bool joined = false;
  std::string reason;                    ///< why it was not joined: one clause, for people
  bool open = false;                     ///< not joined, though in several ways it would fit
  Pose T_first_pass = Pose::Identity();  ///< from this pass's table frame to the first one's
  /// Of a rotation vector (rad) and a translation (m) that follow the motion, in the first pass's
  /// frame, about `center`: T = exp(error about center) * T_first_pass. Zero for the first.
  Matrix6 covariance = Matrix6::Zero();
  Vec3d center = Vec3d::Zero();
  double sigma_m = 0.0;     ///< stated deviation of the motion, rms over the pass's surface
  double sigma_rad = 0.0;   ///< of its rotation
  double overlap_m2 = 0.0;  ///< of its surface that agrees with another pass's
  double against_m2 = 0.0;  ///< of its surface that lies where another pass saw nothing
  double residual_m = 0.0;  ///< deviation of the surfaces from each other where they overlap
  /// Another object on the same table is of the same shape wherever both were measured, and would
  /// do as well.
  bool interchangeable = false;
  bool by_colors = false;  ///< its shape left the motion open, and its colours told
};

struct JoinOptions {
  double min_overlap = 0.08;    ///< of the smaller of two surfaces, that has to agree
  double max_against = 0.06;    ///< of what agrees, that may lie in empty space
  double max_sigma_m = 0.0005;  ///< a motion known less well is undetermined
};

/// One motion a pass; the first is where it is. Shapes decide; where they leave a motion open and
/// both passes have colours, these do. A pass whose motion is not determined, or that does
/// not fit, is not joined and has a reason; the others are joined without it. Passes that overlap
/// only with passes that are joined are found through them. Each pass needs points and normals.
/// Fails with kTooFewPoints for fewer than two passes or a pass with fewer than 200 points, and
/// with kCancelled. Begins the phase "join passes". The same bytes for any number of threads.
Result<std::vector<PassMotion>> join_passes(std::span<const PassSurface> passes,
                                            const JoinOptions& options, const RunContext& context);

/// An object of one pass.
struct ObjectPart {
  std::size_t pass = 0, object = 0;
  /// Joined: to the first part of the object, in whose frame it is given.
  PassMotion motion;
};

/// The same for tables with several objects, which stand and lie anywhere in each pass: all parts
/// of each object, by pass, at most one a pass; objects by their first part. One that was found in
/// no other pass is a part alone, with a reason. Fails as join_passes() does, with the objects of
/// all passes counted.
Result<std::vector<std::vector<ObjectPart>>> join_objects(
    std::span<const std::vector<PassSurface>> passes, const JoinOptions& options,
    const RunContext& context);

}  // namespace turnscan::passes
