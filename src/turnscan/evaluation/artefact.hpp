#pragma once
// Characteristics of a measuring system from the scan of an artefact of known shape, after VDI/VDE
// 2634 part 2 (2012), "Optical 3-D measuring systems: optical systems based on area scanning".
//
//   probing error, form  PF = max d_i - min d_i,  d_i = |p_i - c| - r
//   probing error, size  PS = 2 r - D             D: calibrated diameter
//   sphere spacing error SD = |c_1 - c_2| - L     L: calibrated distance of the centres
//   flatness error       F  = max h_i - min h_i,  h_i = n . (p_i - o)
//
// Sphere (c, r) and plane (n, o) are least-squares fits, over c, r and over n, o. Up to 0.3 % of
// the points may be rejected: the floor(0.003 N) points with the largest |d_i| (|h_i|) are
// rejected, the fit is repeated with the others, and so on until the same points are rejected. ISO
// 10360-13 (2021) excludes 5 % of the points in the same way; form95_m is that range.
// docs/reference/evaluation.md lists the parts of the guideline's procedure that are left to the
// user: artefact, number of positions, acceptance.

#include <optional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

enum class Artefact { kNone, kBall, kBallBar, kPlate };

struct ArtefactOptions {
  Artefact artefact = Artefact::kNone;
  std::optional<double> diameter_m;  ///< calibrated; of both balls of a ball bar
  std::optional<double> spacing_m;   ///< calibrated; without it SD is not computed
  /// Points of a ball below this elevation, seen from its centre, are not used; +y is up. nullopt:
  /// -30 deg if there are normals, as in a mesh, whose underside was not seen; else all.
  std::optional<double> lowest_rad;
  /// Maximum distance of points from the artefact's surface. nullopt: six standard deviations, from
  /// the median of the distances.
  std::optional<double> band_m;
  double margin_m = 0.005;  ///< rim of a plate that is excluded
};
/// Fields artefact (none, ball, ball-bar, plate), ball-diameter, ball-spacing, ball-lowest,
/// artefact-band, plate-margin.
OptionTable describe(ArtefactOptions& options);

/// Statistics of the points of a fit, metres.
struct FitFigures {
  std::size_t points = 0;    ///< N, including the rejected ones
  std::size_t rejected = 0;  ///< floor(0.003 N)
  std::size_t left_out = 0;  ///< near the surface, but beyond the band: not included in N
  double form_m = 0.0;       ///< PF or F
  double form95_m = 0.0;     ///< the same with 5 % excluded
  double sigma_m = 0.0;      ///< standard deviation of the distances
};

struct BallFigures {
  FitFigures fit;
  Vec3d center_m = Vec3d::Zero();
  double diameter_m = 0.0;    ///< 2 r
  double size_error_m = 0.0;  ///< PS
  double covered = 0.0;       ///< share of the sphere's surface that has points
};

struct SpacingFigures {
  double measured_m = 0.0;
  std::optional<double> error_m;  ///< SD
  /// SD if both spheres are fitted with the calibrated diameter.
  std::optional<double> error_fixed_diameter_m;
};

struct PlateFigures {
  FitFigures fit;
  Vec3d normal = Vec3d::UnitZ(), center_m = Vec3d::Zero();
  double length_m = 0.0, width_m = 0.0;  ///< of the part that was used
};

struct ArtefactFigures {
  Artefact artefact = Artefact::kNone;
  std::vector<BallFigures> balls;  ///< one; for a bar two, the nearer to the origin first
  std::optional<SpacingFigures> spacing;
  std::optional<PlateFigures> plate;
};

/// Finds the artefact among the points (metres), which may include those of other objects, and
/// measures it. Normals, if there are any, must point outward; points whose normal is more than 45
/// deg from that of the artefact are not used. Fails with kInvalidOption (no artefact chosen, a
/// ball without diameter, a value out of range), kTooFewPoints, kMissingData if there is no such
/// artefact, kCancelled. The result is byte-identical on every run.
Result<ArtefactFigures> measure_artefact(const PointCloud& cloud, const ArtefactOptions& options,
                                         const RunContext& context);

/// Points of a mesh for measure_artefact(): 200,000 samples, uniformly distributed over its
/// surface, with normals. Fails as sample_surface() does.
Result<PointCloud> artefact_points(const TriangleMesh& mesh, const RunContext& context);

/// JSON text with a final newline; keys carry units. docs/reference/evaluation.md lists them.
std::string to_json(const ArtefactFigures& figures);

}  // namespace turnscan
