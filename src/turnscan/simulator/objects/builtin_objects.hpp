#pragma once
// Objects of known shape to scan virtually, made by code. Table frame: metres, standing on y = 0,
// centred on the y axis, front towards +Z, closed, 2-manifold, outward.

#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// The wooden letter A of Carruesco Llorens 2016 (17.4 x 19.4 x 1.6 cm), upright, in the plane
/// z = 0. The outline is exact: both legs are strips of horizontal width leg_m that lean inwards
/// from the feet at |x| <= width_m / 2 to the flat top of width leg_m; between them the crossbar,
/// below it the gap, above it the triangular counter, which goes through. All edges are sharp.
struct LetterA {
  static constexpr double width_m = 0.174;
  static constexpr double height_m = 0.194;
  static constexpr double thickness_m = 0.016;
  static constexpr double leg_m = 0.038;            ///< horizontal width of a leg and of the top
  static constexpr double crossbar_low_m = 0.050;   ///< height of the gap between the feet
  static constexpr double crossbar_high_m = 0.082;  ///< where the counter begins
};

/// Vertices lie on the true circle, so the facets are inside it by at most 2 um.
struct SolidCylinder {
  static constexpr double diameter_m = 0.080;
  static constexpr double height_m = 0.160;
  static constexpr int segments = 360;
};

/// A figure in a pleated dress that reaches the platter, with hat, two thin bent arms, a bag on a
/// loop in one hand and a shallow bowl, open to the front, in the other.
struct Doll {
  static constexpr double height_m = 0.200;         ///< platter to the top of the hat
  static constexpr double arm_thickness_m = 0.009;  ///< diameter of the forearms
  static constexpr double bag_loop_thickness_m = 0.0044;
  static constexpr double bag_loop_hole_m = 0.0136;  ///< inner diameter of the loop
  static constexpr double bowl_depth_m = 0.007;
  static constexpr double pleat_height_m = 0.0012;  ///< amplitude of the ridges at the hem
  static constexpr double button_height_m = 0.0011;
  static constexpr double cell_m = 0.0008;  ///< of the grid on which its surface is meshed
};

/// A scorpion with raised tail and claws, which measures reconstruction where it is hard: eight
/// thin bent legs beside a low body that hides its own underside.
struct Scorpion {
  static constexpr double height_m = 0.150;  ///< platter to the top of the tail
  static constexpr double body_clearance_m = 0.010;
  static constexpr double thigh_thickness_m = 0.008;  ///< diameter at the hip
  static constexpr double foot_thickness_m = 0.004;   ///< diameter at the platter
  static constexpr double cell_m = 0.0008;            ///< as the doll's
};

/// A skull with free-standing cheekbones, deep orbits and an open mouth that reaches far back:
/// three handles, hollows of which no view sees the ground.
struct Skull {
  static constexpr double height_m = 0.150;
  static constexpr double arch_thickness_m = 0.008;  ///< diameter of the cheekbones
  static constexpr double cell_m = 0.0008;           ///< as the doll's
};

/// A crouched figure on two feet and one hand, the other arm raised: thin limbs, as the action
/// figure of Carruesco Llorens 2016.
struct ActionFigure {
  static constexpr double height_m = 0.147;             ///< platter to the top of the head
  static constexpr double thigh_thickness_m = 0.018;    ///< diameter at the hip
  static constexpr double forearm_thickness_m = 0.009;  ///< diameter at the wrist
  static constexpr double cell_m = 0.0008;              ///< as the doll's
};

/// A figure in a robe with folds, hands folded, with a thin halo that stands free behind the head,
/// as the virgin of Carruesco Llorens 2016.
struct RobedFigure {
  static constexpr double height_m = 0.296;          ///< platter to the top of the halo
  static constexpr double halo_diameter_m = 0.072;   ///< outer
  static constexpr double halo_thickness_m = 0.006;  ///< diameter of its ring
  static constexpr double fold_height_m = 0.0022;    ///< amplitude at the hem
  static constexpr double cell_m = 0.001;            ///< of the grid on which its surface is meshed
};

/// A ball that touches the platter in a point. Vertices of all gauges lie on the true surface;
/// facets are inside balls by at most 4 um.
struct GaugeBall {
  static constexpr double diameter_m = 0.060;
};

/// Two balls on a bar that lies level, along x.
struct BallBar {
  static constexpr double diameter_m = 0.040;
  static constexpr double spacing_m = 0.150;  ///< of the balls' centres
  static constexpr double bar_diameter_m = 0.012;
};

/// A plate that stands on its edge, its faces towards +Z and -Z.
struct GaugePlate {
  static constexpr double width_m = 0.160;
  static constexpr double height_m = 0.120;
  static constexpr double thickness_m = 0.012;
};

/// "letter-a", "cylinder", "labelled-cylinder", "doll", "scorpion", "skull", "action-figure",
/// "robed-figure", and the gauges "ball", "ball-bar", "plate".
std::vector<std::string> builtin_object_names();

/// Whether it is an artefact to test a rig with (measure_artefact()), not an object.
bool is_gauge(std::string_view name);

/// The object of that name, with vertex colours or, the labelled cylinder, a texture. Takes up to
/// about a second of a processor (the figures and the skull). An unknown name fails with kNotFound
/// and lists the known ones; fails with kCancelled.
Result<TriangleMesh> builtin_object(std::string_view name, const RunContext& context = {});

/// The mesh turned by yaw_rad about +Y (counter-clockwise seen from above), then moved by (x, z).
TriangleMesh place(TriangleMesh mesh, double x_m, double z_m, double yaw_rad);

/// The mesh moved so that its lowest point is at y = 0 and its bounding box is centred on the y
/// axis; with height_m scaled about that point to be so tall. An empty mesh, or one without height
/// to scale, is only moved.
TriangleMesh stand_on_platter(TriangleMesh mesh, std::optional<double> height_m = std::nullopt);

}  // namespace turnscan
