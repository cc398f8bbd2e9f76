#pragma once
// Point clouds as cubes, which a picture can shade: voxels and sub-voxels with their counts, and
// points.

#include <string>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// A cube for each point, in the point's colour, else from violet to yellow by its weight, up to
/// the largest but for 5 % of all points. Where the points lie on a grid along the axes, as the
/// stages voxels and sub-voxels do, cubes are its cells; otherwise a cube is 0.6 of the median
/// distance to the fourth neighbour. Refers to the cloud.
class CloudCubes {
 public:
  explicit CloudCubes(const PointCloud& cloud);

  bool on_grid() const { return !cells_.empty(); }
  /// The weight that is yellow; 0: the colours are the cloud's own, or there are none.
  double brightest() const { return brightest_; }
  /// Those whose weight is at least min_weight (without weights: all). Faces between two cells are
  /// left out. Fails with kTooFewPoints if none is left.
  Result<TriangleMesh> mesh(double min_weight) const;
  /// The same on a grid of half the resolution, for a view that moves: a cube has the colour of the
  /// largest weight in it. Empty if the points lie on no grid.
  TriangleMesh coarser(double min_weight) const;

 private:
  /// Of points in the middles of cells of this half edge.
  CloudCubes(const PointCloud& cloud, std::vector<Eigen::Vector3i> cells, float half_m);

  const PointCloud& cloud_;
  std::vector<Eigen::Vector3i> cells_;  ///< of the points; empty if they do not lie on a grid
  float half_ = 0.0f;                   ///< of a cube's edge
  std::vector<Rgb> colors_;
  double brightest_ = 0.0;
};

/// CloudCubes::mesh(). Fails as that does, and with kCancelled.
Result<TriangleMesh> cubes_of(const PointCloud& cloud, double min_weight,
                              const RunContext& context);

/// A mesh to show, or the cubes of a cloud (.pcd, or .ply without triangles). Fails as read_mesh(),
/// read_cloud() and cubes_of() do.
Result<TriangleMesh> read_shown(const std::string& path, double min_weight,
                                const RunContext& context);

}  // namespace turnscan
