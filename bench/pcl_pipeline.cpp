// The pipeline of `turnscan reconstruct` written straightforwardly with PCL's classes: what a user
// of PCL would write, and what turnscan is compared with (bench/compare_pipelines).
//   pcl_pipeline RECORDING OUT.ply [--OPTION VALUE]...
// Nothing is automatic here: voxel size, threshold and radius must be given as turnscan found them,
// or as one likes.

#include <fmt/format.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/poisson.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <turnscan/core/option_table.hpp>
#include <turnscan/io/atomic_file.hpp>
#include <turnscan/io/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/crop.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace {

using namespace turnscan;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using OrientedCloud = pcl::PointCloud<pcl::PointNormal>;

enum class ViewpointChoice { kInside, kSensor };

struct Options {
  double crop_margin_m = 0.005;
  double crop_radius_m = 0.0;
  int outlier_k = 10;
  double outlier_lambda = 1.0;
  double voxel_size_m = 0.002;
  int voxel_min_points = 10;
  double normal_radius_m = 0.01;
  ViewpointChoice viewpoint = ViewpointChoice::kInside;
  int poisson_depth = 8;
  double poisson_samples = 1.5;
  double poisson_scale = 1.1;
  std::string json;
};

OptionTable describe(Options& o) {
  OptionTable table;
  table.number("crop-margin", o.crop_margin_m, Quantity::kLength, {-0.1, 1.0}, "as turnscan's")
      .number("crop-radius", o.crop_radius_m, Quantity::kLength, {0.0, 100.0}, "0: no crop")
      .number("outlier-k", o.outlier_k, {1, 1000}, "as turnscan's")
      .number("outlier-lambda", o.outlier_lambda, Quantity::kNone, {0.0, 100.0}, "as turnscan's")
      .number("voxel-size", o.voxel_size_m, Quantity::kLength, {1e-5, 1.0}, "edge of a voxel")
      .number("voxel-min-points", o.voxel_min_points, {1, 1000000}, "threshold M")
      .number("normal-radius", o.normal_radius_m, Quantity::kLength, {1e-5, 1.0}, "neighbourhood")
      .choice("viewpoint", o.viewpoint, {"inside", "sensor"},
              "normals away from the middle of the cloud, or towards the first frame's sensor")
      .number("poisson-depth", o.poisson_depth, {2, 13}, "as turnscan's")
      .number("poisson-samples", o.poisson_samples, Quantity::kNone, {1.0, 100.0}, "as turnscan's")
      .number("poisson-scale", o.poisson_scale, Quantity::kNone, {1.0, 10.0}, "as turnscan's")
      .text("json", o.json, "file for the figures");
  return table;
}

/// Seconds per stage, in order; the time between two calls of lap() goes to the stage named.
class Stopwatch {
 public:
  void lap(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    for (auto& [name, sum] : stages_)
      if (name == stage) {
        sum += seconds;
        return;
      }
    stages_.emplace_back(stage, seconds);
  }
  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> stages_;
};

struct Figures {
  std::size_t frames = 0, returns = 0, points = 0, candidates = 0, vertices = 0, triangles = 0;
};

Cloud::Ptr crop_to_cylinder(const FramePoints& frame, const Pose& T_table_sensor,
                            const Options& options) {
  Cylinder cylinder;
  cylinder.margin_m = options.crop_margin_m;
  cylinder.radius_m = options.crop_radius_m;
  Cloud::Ptr cloud(new Cloud);
  for (const Vec3f& p : frame.cloud.points)
    if (options.crop_radius_m == 0.0 || cylinder.contains(T_table_sensor * p.cast<double>()))
      cloud->emplace_back(p.x(), p.y(), p.z());
  return cloud;
}

Cloud without_outliers(const Cloud::Ptr& cloud, const Options& options) {
  Cloud kept;
  if (cloud->empty()) return kept;
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setMeanK(options.outlier_k);
  filter.setStddevMulThresh(options.outlier_lambda);
  filter.filter(kept);
  return kept;
}

Result<Cloud::Ptr> merge(const Recording& recording, const std::vector<Pose>& poses,
                         const Options& options, Stopwatch& watch, Figures& figures) {
  std::vector<RayTable> rays;
  for (const SensorInfo& sensor : recording.header().sensors)
    rays.emplace_back(sensor.kind == SensorKind::kDepthCamera ? RayTable(sensor.intrinsics)
                                                              : RayTable());
  Cloud::Ptr merged(new Cloud);
  for (std::size_t i = 0; i < recording.frames().size(); ++i) {
    if (recording.frames()[i].status != FrameStatus::kOk) continue;
    TURNSCAN_ASSIGN(const Frame frame, recording.read(i));
    const std::size_t sensor = frame.info.sensor;
    TURNSCAN_ASSIGN(const FramePoints points,
                    points_of(frame, recording.header().sensors[sensor], rays[sensor]));
    ++figures.frames;
    figures.returns += points.cloud.size();
    watch.lap("read");
    const Cloud::Ptr cropped = crop_to_cylinder(points, poses[i], options);
    watch.lap("crop");
    const Cloud kept = without_outliers(cropped, options);
    watch.lap("outliers");
    const Eigen::Isometry3f T = poses[i].cast<float>();
    for (const pcl::PointXYZ& p : kept) {
      const Vec3f q = T * p.getVector3fMap();
      merged->emplace_back(q.x(), q.y(), q.z());
    }
    watch.lap("merge");
  }
  figures.points = merged->size();
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

std::string figures_json(const Stopwatch& watch, const Figures& figures) {
  std::string seconds;
  double total = 0.0;
  for (const auto& [stage, value] : watch.stages()) {
    seconds += fmt::format("{}\"{}\": {:.4f}", seconds.empty() ? "" : ", ", stage, value);
    total += value;
  }
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return fmt::format(
      "{{\"frames\": {}, \"returns\": {}, \"points\": {}, \"candidates\": {}, \"vertices\": {}, "
      "\"triangles\": {},\n \"seconds\": {{{}}}, \"seconds_total\": {:.4f}, "
      "\"peak_memory_mb\": {:.1f}}}\n",
      figures.frames, figures.returns, figures.points, figures.candidates, figures.vertices,
      figures.triangles, seconds, total, double(usage.ru_maxrss) / 1024.0);
}

Result<> run(const std::string& input, const std::string& output, const Options& options) {
  Stopwatch watch;
  Figures figures;
  TURNSCAN_ASSIGN(const Recording recording, Recording::open(input));
  TURNSCAN_ASSIGN(const FramePoses poses,
                  frame_poses(recording.header(), recording.frames(), std::nullopt));
  watch.lap("read");
  TURNSCAN_ASSIGN(const Cloud::Ptr merged,
                  merge(recording, poses.T_table_sensor, options, watch, figures));
  const Cloud::Ptr candidates = centroids(merged, options);
  figures.candidates = candidates->size();
  watch.lap("voxels");
  const Pose& first = poses.T_table_sensor.at(0);
  const Vec3f sensor = (first * recording.header().sensors.at(0).viewpoint.value).cast<float>();
  const OrientedCloud::Ptr oriented = with_normals(candidates, sensor, options);
  watch.lap("normals");
  const TriangleMesh mesh = poisson(oriented, options);
  figures.vertices = mesh.vertices.size(), figures.triangles = mesh.triangles.size();
  watch.lap("surface");
  TURNSCAN_TRY(write_mesh(output, mesh));
  watch.lap("write");
  const std::string json = figures_json(watch, figures);
  std::fputs(json.c_str(), stdout);
  return options.json.empty() ? Result<>() : write_file_atomically(options.json, json);
}

Result<> parse_and_run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2 || arguments.size() % 2 != 0)
    return fail(ErrorCode::kInvalidOption,
                "usage: pcl_pipeline RECORDING OUT.ply [--OPTION VALUE]...");
  Options options;
  const OptionTable table = describe(options);
  for (std::size_t i = 2; i < arguments.size(); i += 2) {
    const std::string& name = arguments[i];
    TURNSCAN_TRY(table.set(name.starts_with("--") ? name.substr(2) : name, arguments[i + 1]));
  }
  TURNSCAN_TRY(table.check());
  return run(arguments[0], arguments[1], options);
}

}  // namespace

int main(int argc, char** argv) {
  const Result<> result = parse_and_run(std::vector<std::string>(argv + 1, argv + argc));
  if (result) return 0;
  fmt::print(stderr, "pcl_pipeline: {}\n", result.error().text());
  return result.error().code == ErrorCode::kInvalidOption ? 2 : 1;
}
