#pragma once
// Registers the passes of one object by their surfaces, or gives the reason why these do not
// determine the motions.

#include <functional>
#include <span>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::passes {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct PassMotion {
  bool joined = false;
  std::string reason;                    ///< why it was not joined: one clause, for display
  bool open = false;                     ///< not joined, although several motions would fit
  Pose T_first_pass = Pose::Identity();  ///< from this pass's table frame to the first one's
  /// Covariance of a rotation vector (rad) and a translation (m) that follow the motion, in the
  /// first pass's frame, about `center`: T = exp(error about center) * T_first_pass. Zero for the
  /// first.
  Matrix6 covariance = Matrix6::Zero();
  Vec3d center = Vec3d::Zero();
  double sigma_m = 0.0;     ///< stated standard deviation of the motion, root mean square over the
                            ///< pass's surface
  double sigma_rad = 0.0;   ///< of its rotation
  double overlap_m2 = 0.0;  ///< surface that agrees with another pass's
  double against_m2 = 0.0;  ///< surface where another pass saw free space
  double residual_m = 0.0;  ///< deviation between the surfaces where they overlap
  /// Another object on the same table has the same shape wherever both were measured, and would fit
  /// equally well.
  bool interchangeable = false;
  bool by_colors = false;  ///< its shape left the motion undetermined, and its colours determined
                           ///< it
};

struct JoinOptions {
  double min_overlap = 0.08;    ///< share of the smaller of two surfaces that has to agree
  double max_against = 0.06;    ///< share of the agreeing surface that may be in free space
  double max_sigma_m = 0.0005;  ///< a motion with a larger deviation is undetermined
};

/// One motion per pass; that of the first is the identity. Shapes decide; if they leave a motion
/// undetermined and both passes have colours, these do. A pass whose motion is not determined, or
/// that does not fit, is not joined and gets a reason; the others are joined without it. Passes
/// that overlap only with joined passes are found through them. Each pass needs points and normals.
/// Fails with kTooFewPoints for fewer than two passes or a pass with fewer than 200 points, and
/// with kCancelled. Begins the phase "join passes". The result is byte-identical for any number of
/// threads.
Result<std::vector<PassMotion>> join_passes(std::span<const PassSurface> passes,
                                            const JoinOptions& options, const RunContext& context);

/// An object of one pass.
struct ObjectPart {
  std::size_t pass = 0, object = 0;
  /// If joined: relative to the first part of the object, in whose frame it is given.
  PassMotion motion;
};

/// Adds colours to surfaces that are being joined. Returns whether at least two passes have any.
using AddColors = std::function<Result<bool>()>;

/// The same for tables with several objects, whose positions and poses differ arbitrarily between
/// passes: all parts of each object, by pass, at most one per pass; objects in the order of their
/// first parts. An object found in no other pass is a single part, with a reason. add_colors is
/// called if the shapes leave a motion open. Fails as join_passes() does, with the objects of all
/// passes counted, and as add_colors.
Result<std::vector<std::vector<ObjectPart>>> join_objects(
    std::span<const std::vector<PassSurface>> passes, const JoinOptions& options,
    const RunContext& context, const AddColors& add_colors = {});

}  // namespace turnscan::passes
