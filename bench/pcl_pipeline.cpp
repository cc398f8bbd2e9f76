// The pipeline of `turnscan reconstruct` written straightforwardly with PCL's classes: what a user
// of PCL would write, and what turnscan is compared with (bench/compare_pipelines, scripts/bench).
//   pcl_pipeline RECORDING OUT.ply [--OPTION VALUE]...
// Nothing is automatic here: voxel size, threshold and radius must be given as turnscan found them,
// or as one likes.

#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/poisson.h>
#include <bench/plain_pipeline.hpp>

namespace {

using namespace turnscan;
using namespace turnscan::plain;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using OrientedCloud = pcl::PointCloud<pcl::PointNormal>;

enum class ViewpointChoice { kInside, kSensor };

struct Options {
  CropAndFilter frame;
  double voxel_size_m = 0.002;
  int voxel_min_points = 10;
  double normal_radius_m = 0.01;
  ViewpointChoice viewpoint = ViewpointChoice::kInside;
  int poisson_depth = 8;
  double poisson_samples = 1.5;
  double poisson_scale = 1.1;
  double poisson_point_weight = 4.0;
  std::string json;
};

OptionTable describe(Options& o) {
  OptionTable table = describe(o.frame);
  table.number("voxel-size", o.voxel_size_m, Quantity::kLength, {1e-5, 1.0}, "edge of a voxel")
      .number("voxel-min-points", o.voxel_min_points, {1, 1000000}, "threshold M")
      .number("normal-radius", o.normal_radius_m, Quantity::kLength, {1e-5, 1.0}, "neighbourhood")
      .choice("viewpoint", o.viewpoint, {"inside", "sensor"},
              "normals away from the middle of the cloud, or towards the first frame's sensor")
      .number("poisson-depth", o.poisson_depth, {2, 13}, "as turnscan's")
      .number("poisson-samples", o.poisson_samples, Quantity::kNone, {1.0, 100.0}, "as turnscan's")
      .number("poisson-scale", o.poisson_scale, Quantity::kNone, {1.0, 10.0}, "as turnscan's")
      .number("poisson-point-weight", o.poisson_point_weight, Quantity::kNone, {0.0, 100.0},
              "as turnscan's")
      .text("json", o.json, "file for the figures");
  return table;
}

Cloud without_outliers(const Cloud::Ptr& cloud, const Options& options) {
  Cloud kept;
  if (cloud->empty()) return kept;
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setMeanK(options.frame.outlier_k);
  filter.setStddevMulThresh(options.frame.outlier_lambda);
  filter.filter(kept);
  return kept;
}

Result<Cloud::Ptr> merge(const Scan& scan, const Options& options, Tally& tally) {
  Cloud::Ptr merged(new Cloud);
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    if (!scan.usable(i)) continue;
    TURNSCAN_ASSIGN(const FramePoints points, scan.points(i, tally));
    const FramePoints cropped = scan.cropped(points, i, options.frame, tally);
    Cloud::Ptr cloud(new Cloud);
    for (const Vec3f& p : cropped.cloud.points) cloud->emplace_back(p.x(), p.y(), p.z());
    const Cloud kept = without_outliers(cloud, options);
    tally.watch.lap("outliers");
    const Eigen::Isometry3f T = scan.pose(i).cast<float>();
    for (const pcl::PointXYZ& p : kept) {
      const Vec3f q = T * p.getVector3fMap();
      merged->emplace_back(q.x(), q.y(), q.z());
    }
    tally.watch.lap("merge");
  }
  tally.figures.points = merged->size();
  return merged;
}
Cloud::Ptr centroids(const Cloud::Ptr& merged, const Options& options) {
  const auto size = static_cast<float>(options.voxel_size_m);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(merged);
  grid.setLeafSize(size, size, size);
  grid.setMinimumPointsNumberPerVoxel(static_cast<unsigned>(options.voxel_min_points));
  Cloud::Ptr candidates(new Cloud);
  grid.filter(*candidates);
  return candidates;
}

/// One viewpoint for the whole cloud, as PCL's class has it.
OrientedCloud::Ptr with_normals(const Cloud::Ptr& candidates, const Vec3f& sensor,
                                const Options& options) {
  Vec3f middle = Vec3f::Zero();
  for (const pcl::PointXYZ& p : *candidates) middle += p.getVector3fMap();
  middle /= static_cast<float>(std::max<std::size_t>(candidates->size(), 1));
  const bool inside = options.viewpoint == ViewpointChoice::kInside;
  const Vec3f viewpoint = inside ? middle : sensor;
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::PointNormal> estimation;
  estimation.setInputCloud(candidates);
  estimation.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setRadiusSearch(options.normal_radius_m);
  estimation.setViewPoint(viewpoint.x(), viewpoint.y(), viewpoint.z());
  OrientedCloud normals;
  estimation.compute(normals);
  OrientedCloud::Ptr oriented(new OrientedCloud);
  for (std::size_t i = 0; i < candidates->size(); ++i) {
    pcl::PointNormal p = normals[i];
    if (!std::isfinite(p.normal_x)) continue;
    p.getVector3fMap() = (*candidates)[i].getVector3fMap();
    if (inside) p.getNormalVector3fMap() *= -1.0f;
    oriented->push_back(p);
  }
  return oriented;
}

TriangleMesh poisson(const OrientedCloud::Ptr& oriented, const Options& options) {
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setInputCloud(oriented);
  poisson.setDepth(options.poisson_depth);
  poisson.setSamplesPerNode(static_cast<float>(options.poisson_samples));
  poisson.setScale(static_cast<float>(options.poisson_scale));
  poisson.setPointWeight(static_cast<float>(options.poisson_point_weight));
  OrientedCloud vertices;
  std::vector<pcl::Vertices> polygons;
  poisson.reconstruct(vertices, polygons);
  TriangleMesh mesh;
  for (const pcl::PointNormal& p : vertices) mesh.vertices.emplace_back(p.getVector3fMap());
  for (const pcl::Vertices& polygon : polygons)
    mesh.triangles.push_back({std::uint32_t(polygon.vertices.at(0)),
                              std::uint32_t(polygon.vertices.at(1)),
                              std::uint32_t(polygon.vertices.at(2))});
  return mesh;
}

Result<> run(const std::string& input, const std::string& output, const Options& options) {
  Tally tally;
  TURNSCAN_ASSIGN(const Scan scan, Scan::open(input));
  tally.watch.lap("read");
  TURNSCAN_ASSIGN(const Cloud::Ptr merged, merge(scan, options, tally));
  const Cloud::Ptr candidates = centroids(merged, options);
  tally.figures.candidates = candidates->size();
  tally.watch.lap("voxels");
  const Vec3f sensor = (scan.pose(0) * scan.sensor(0).viewpoint.value).cast<float>();
  const OrientedCloud::Ptr oriented = with_normals(candidates, sensor, options);
  tally.watch.lap("normals");
  const TriangleMesh mesh = poisson(oriented, options);
  tally.watch.lap("surface");
  return finish(mesh, output, options.json, tally);
}

Result<> parse_and_run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2 || arguments.size() % 2 != 0)
    return fail(ErrorCode::kInvalidOption,
                "usage: pcl_pipeline RECORDING OUT.ply [--OPTION VALUE]...");
  Options options;
  TURNSCAN_TRY(read_options(describe(options), {arguments.begin() + 2, arguments.end()}));
  return run(arguments[0], arguments[1], options);
}

}  // namespace

int main(int argc, char** argv) {
  return turnscan::plain::report("pcl_pipeline",
                                 parse_and_run(std::vector<std::string>(argv + 1, argv + argc)));
}
