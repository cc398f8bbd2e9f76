#pragma once
// Candidates of a plan: objects with their poses, and placements of sensors.

#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/planning/turn_view.hpp>
#include <turnscan/workflow/plan/plan.hpp>
#include <utility>

namespace turnscan::workflow {

/// One pose of an object.
struct PlanPose {
  PassEntry entry;                        ///< relative to the first pass; empty: the first
  Pose T_table_first = Pose::Identity();  ///< from the table frame of the first pass
  Scene scene;
};

struct PlanObject {
  TriangleMesh given;  ///< as returned by read_object()
  TriangleMesh mesh;   ///< in the pose of the first pass; table frame
  planning::PlanSurface surface;
  std::vector<PlanPose> poses;  ///< the first pass first
  double radius_m = 0.0;        ///< about the axis, the largest of all poses
  double height_m = 0.0;        ///< in the first pass
};

/// A candidate placement of a sensor. `scanner` is an index into PlanField::scanners.
struct PlanPlace {
  std::size_t scanner = 0;
  ScannerPlacement placement;
};

/// An available scanner.
struct PlanScanner {
  std::string name;  ///< preset or file
  ScannerModel model;
  planning::SigmaSteps sigma;
  ScannerEntry given;
};

struct PlanField {
  std::vector<PlanObject> objects;
  std::vector<PlanScanner> scanners;
  std::vector<PlanPlace> places;
  std::vector<double> angles_rad;  ///< turntable angles of all frames
  Pose T_world_table = Pose::Identity();
  double distance_step_m = 0.0, elevation_step_rad = 0.0;
};

/// Fails as run_plan().
Result<PlanField> make_plan_field(const PlanRequest& request, const RunContext& context);

/// The range of distances allowed for a scanner.
struct DistanceRange {
  double least_m, greatest_m;
};
Result<DistanceRange> distances_of(const PlanRequest& request, const PlanField& field,
                                   const ScannerModel& model);

/// What one turn of an object in a pose shows from a placement; accounts for the occlusion of one
/// sensor only.
std::vector<planning::SpotSight> sights_from(const PlanField& field, const PlanObject& object,
                                             const PlanPose& pose, const PlanPlace& place);

/// Scene entry of a scanner with everything that a plan decides. Each sensor but the first gets an
/// azimuth of its own, so that sensors do not collide; over a full turn the azimuth makes no
/// difference.
ScannerEntry entry_of(const PlanField& field, const PlanPlace& place);

}  // namespace turnscan::workflow
