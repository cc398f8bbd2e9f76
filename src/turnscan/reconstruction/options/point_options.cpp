#include <cmath>
#include <turnscan/core/units.hpp>
#include <turnscan/reconstruction/options/point_options.hpp>

namespace turnscan {

OptionTable describe(MergeOptions& o) {
  OptionTable table;
  table
      .number("speed", o.speed_rad_s, Quantity::kAngularSpeed, {-100.0, 100.0},
              "Angular speed of the platter, counter-clockwise from above positive; automatic: as "
              "recorded")
      .flag("cloud-outliers", o.cloud_outliers,
            "Run the statistical filter once more, on the merged cloud")
      .number("pass", o.pass, {0, 1e9},
              "Pass to use of a recording with several, in which the object lies differently; "
              "automatic: the only one");
  return table;
}

OptionTable describe(VoxelOptions& o) {
  OptionTable table;
  table
      .number("voxel-size", o.size_m, Quantity::kLength, {1e-5, 1.0},
              "Edge of a voxel; automatic: from noise and density of the first frames")
      .number("voxel-grid", o.grid, {2, 100000},
              "Instead of voxel-size: number of voxels along the longest side that the first "
              "frames show")
      .number("voxel-min-points", o.min_points, {1, 1e9},
              "Voxels with fewer points are dropped; automatic: a tenth of the typical count")
      .flag(
          "voxel-grid-in-bounds", o.in_bounds,
          "Put the grid into the bounding box of all points, which are kept in memory, instead of "
          "fixing it to the turntable; voxel-grid then divides the longest side of that box");
  return table;
}

OptionTable describe(CandidateOptions& o) {
  OptionTable table;
  table
      .choice("candidates", o.method, {"centroid", "sub-voxel"},
              "Candidate of a voxel: centroid of its points, or sub-voxel counting")
      .number("sub-voxels", o.subdivisions, {1, 16},
              "Sub-voxel counting splits each edge of a voxel into this many parts")
      .choice("sub-voxel-line", o.line, {"chord", "towards-sensor"},
              "Part of the line through sensor and point that is counted; towards-sensor is biased "
              "outwards");
  return table;
}

OptionTable describe(ComponentOptions& o) {
  OptionTable table;
  table.text("keep", o.keep, "Objects to keep: all, largest, or a number N for the N largest")
      .number("min-object-share", o.min_share, Quantity::kNone, {0.0, 1.0},
              "Pieces with a smaller share of the largest piece's points are dropped")
      .number(
          "object-gap", o.gap_m, Quantity::kLength, {0.0, 1.0},
          "Pieces closer than this are one object; 0, with the methods from points: voxels that "
          "touch at a face, edge or corner; automatic: what the volume separates is separate, "
          "and with the methods from points by spacing and noise");
  return table;
}

Result<int> objects_to_keep(const ComponentOptions& options) {
  if (options.keep == "all") return 0;
  if (options.keep == "largest") return 1;
  const auto number = parse_number(options.keep);
  if (!number || !(*number >= 1.0) || *number > 1e6 || *number != std::floor(*number))
    return fail(ErrorCode::kInvalidOption, "keep = {} is neither all, largest nor a number from 1",
                options.keep);
  return static_cast<int>(*number);
}

OptionTable describe(NormalOptions& o) {
  OptionTable table;
  table.number("normal-radius", o.radius_m, Quantity::kLength, {1e-5, 1.0},
               "Neighbourhood for normals; automatic: from voxel size and noise");
  return table;
}

OptionTable describe(RefineOptions& o) {
  OptionTable table;
  table.flag("refine", o.enabled, "Move candidates onto the local surface of the measurements")
      .number(
          "refine-radius", o.radius_m, Quantity::kLength, {1e-5, 1.0},
          "Standard deviation of the weight along the surface; automatic: from noise and density")
      .number("refine-iterations", o.iterations, {1, 20}, "Projection steps");
  return table;
}

OptionTable describe(BaseOptions& o) {
  OptionTable table;
  table.flag("base", o.enabled, "Close the underside flat on the platter where the object stands");
  return table;
}

}  // namespace turnscan
