#pragma once
// What a plan chooses from: objects with the poses in which they can be laid, and places of
// sensors.

#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/planning/turn_view.hpp>
#include <turnscan/workflow/plan/plan.hpp>
#include <utility>

namespace turnscan::workflow {

/// An object in one way to lie.
struct PlanPose {
  PassEntry entry;                        ///< beside the first pass; empty: the first
  Pose T_table_first = Pose::Identity();  ///< from the table's frame of the first pass
  Scene scene;
};

struct PlanObject {
  TriangleMesh given;  ///< of read_object()
  TriangleMesh mesh;   ///< as it lies in the first pass; table frame
  planning::PlanSurface surface;
  std::vector<PlanPose> poses;  ///< the first pass first
  double radius_m = 0.0;        ///< about the axis, of the largest pose
  double height_m = 0.0;        ///< in the first pass
};

/// A place that a sensor can take. Positions in PlanSensors.
struct PlanPlace {
  std::size_t scanner = 0;
  ScannerPlacement placement;
};

/// A scanner at hand.
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
  std::vector<double> angles_rad;  ///< of the turntable, of all frames
  Pose T_world_table = Pose::Identity();
  double distance_step_m = 0.0, elevation_step_rad = 0.0;
};

/// Fails as run_plan().
Result<PlanField> make_plan_field(const PlanRequest& request, const RunContext& context);

/// The range of distances that a scanner may take.
struct DistanceRange {
  double least_m, greatest_m;
};
Result<DistanceRange> distances_of(const PlanRequest& request, const PlanField& field,
                                   const ScannerModel& model);

/// What a turn of an object in a pose shows from a place; shadows of one sensor only.
std::vector<planning::SpotSight> sights_from(const PlanField& field, const PlanObject& object,
                                             const PlanPose& pose, const PlanPlace& place);

/// The entry of a scene's scanner: all that a plan decides. The azimuth of each sensor but the
/// first is its own, so that they do not stand in each other's way; a full turn makes it no
/// difference.
ScannerEntry entry_of(const PlanField& field, const PlanPlace& place);

}  // namespace turnscan::workflow
