// What a user of Open3D 0.16 would write for the same job, with its own classes and on all cores;
// scripts/bench runs it beside turnscan.
//   open3d_pipeline points|tsdf|voxel-blocks|poisson RECORDING OUT.ply [--OPTION VALUE]...
// points: each frame cropped and filtered, merged, voxel_down_sample, normals, Poisson.
// tsdf: ScalableTSDFVolume, voxel-blocks: t::geometry::VoxelBlockGrid, both with the known poses
// and without the crumbs that stray pixels leave. poisson: all points merged as they are, with
// normals from each frame, into Poisson.

#include <open3d/camera/PinholeCameraIntrinsic.h>
#include <open3d/geometry/Image.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/RGBDImage.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>
#include <open3d/t/geometry/Image.h>
#include <open3d/t/geometry/TriangleMesh.h>
#include <open3d/t/geometry/VoxelBlockGrid.h>
#include <open3d/utility/Logging.h>
#include <bench/plain_pipeline.hpp>

#include <algorithm>
#include <limits>

namespace {

using namespace turnscan;
using namespace turnscan::plain;
using open3d::camera::PinholeCameraIntrinsic;
using Cloud = open3d::geometry::PointCloud;
using open3d::core::Tensor;

struct Options {
  CropAndFilter frame;
  double voxel_size_m = 0.002;
  double normal_radius_m = 0.01;
  int poisson_depth = 8;
  double poisson_scale = 1.1;
  double truncation_m = 0.0;
  double least_weight = 3.0;
  std::string json;
};

OptionTable describe(Options& o) {
  OptionTable table = describe(o.frame);
  table.number("voxel-size", o.voxel_size_m, Quantity::kLength, {1e-5, 1.0}, "edge of a voxel")
      .number("normal-radius", o.normal_radius_m, Quantity::kLength, {1e-5, 1.0}, "neighbourhood")
      .number("poisson-depth", o.poisson_depth, {2, 13}, "as turnscan's")
      .number("poisson-scale", o.poisson_scale, Quantity::kNone, {1.0, 10.0}, "as turnscan's")
      .number("truncation", o.truncation_m, Quantity::kLength, {0.0, 1.0}, "0: 4 voxels")
      .number("least-weight", o.least_weight, Quantity::kNone, {0.0, 1e6},
              "voxel-blocks: frames that must have seen a voxel")
      .text("json", o.json, "file for the figures");
  return table;
}

TriangleMesh from_open3d(const open3d::geometry::TriangleMesh& in) {
  TriangleMesh mesh;
  for (const Eigen::Vector3d& p : in.vertices_) mesh.vertices.push_back(p.cast<float>());
  for (const Eigen::Vector3i& t : in.triangles_)
    mesh.triangles.push_back({std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2])});
  return mesh;
}

std::shared_ptr<open3d::geometry::TriangleMesh> poisson(const Cloud& cloud,
                                                        const Options& options) {
  return std::get<0>(open3d::geometry::TriangleMesh::CreateFromPointCloudPoisson(
      cloud, std::size_t(options.poisson_depth), 0.0f, static_cast<float>(options.poisson_scale),
      false, -1));
}

/// Points and their sensor in the table frame, normals towards that sensor.
Cloud with_normals(const FramePoints& frame, const Pose& T_table_sensor, double radius) {
  Cloud cloud;
  for (const Vec3f& p : frame.cloud.points)
    cloud.points_.push_back(T_table_sensor * p.cast<double>());
  cloud.EstimateNormals(open3d::geometry::KDTreeSearchParamHybrid(radius, 30));
  const Viewpoint eye = frame.viewpoint.transformed(T_table_sensor);
  if (eye.parallel)
    cloud.OrientNormalsToAlignWithDirection(eye.value);
  else
    cloud.OrientNormalsTowardsCameraLocation(eye.value);
  return cloud;
}

Result<TriangleMesh> raw_poisson(const Scan& scan, const Options& options, Tally& tally) {
  Cloud merged;
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    if (!scan.usable(i)) continue;
    TURNSCAN_ASSIGN(const FramePoints points, scan.points(i, tally));
    const FramePoints cropped = scan.cropped(points, i, options.frame, tally);
    merged += with_normals(cropped, scan.pose(i), options.normal_radius_m);
    tally.watch.lap("normals");
  }
  tally.figures.points = tally.figures.candidates = merged.points_.size();
  const auto mesh = poisson(merged, options);
  tally.watch.lap("surface");
  return from_open3d(*mesh);
}

Result<TriangleMesh> points_pipeline(const Scan& scan, const Options& options, Tally& tally) {
  Cloud merged;
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    if (!scan.usable(i)) continue;
    TURNSCAN_ASSIGN(const FramePoints points, scan.points(i, tally));
    const FramePoints cropped = scan.cropped(points, i, options.frame, tally);
    Cloud cloud;
    for (const Vec3f& p : cropped.cloud.points) cloud.points_.push_back(p.cast<double>());
    if (cloud.IsEmpty()) continue;
    // Open3D counts the point itself among the neighbours.
    const auto [kept, index] = cloud.RemoveStatisticalOutliers(
        std::size_t(options.frame.outlier_k) + 1, options.frame.outlier_lambda);
    tally.watch.lap("outliers");
    kept->Transform(scan.pose(i).matrix());
    merged += *kept;
    tally.watch.lap("merge");
  }
  tally.figures.points = merged.points_.size();
  const auto candidates = merged.VoxelDownSample(options.voxel_size_m);
  tally.figures.candidates = candidates->points_.size();
  tally.watch.lap("voxels");
  candidates->EstimateNormals(
      open3d::geometry::KDTreeSearchParamHybrid(options.normal_radius_m, 100));
  // One viewpoint for the whole cloud, as the class has it: the middle, then outwards.
  candidates->OrientNormalsTowardsCameraLocation(candidates->GetCenter());
  for (Eigen::Vector3d& n : candidates->normals_) n = -n;
  tally.watch.lap("normals");
  const auto mesh = poisson(*candidates, options);
  tally.watch.lap("surface");
  return from_open3d(*mesh);
}

/// The frame's depth in metres, zero outside the crop.
struct CroppedDepth {
  std::vector<float> metres;
  const SensorInfo* sensor;
  Eigen::Matrix4d T_sensor_table;
};

Result<CroppedDepth> read_depth(const Scan& scan, std::size_t i, const Options& options,
                                Tally& tally) {
  TURNSCAN_ASSIGN(const FramePoints points, scan.points(i, tally));
  CroppedDepth out{{}, &scan.sensor(i), scan.pose(i).inverse().matrix()};
  if (points.cell.empty() || out.sensor->kind != SensorKind::kDepthCamera)
    return fail(ErrorCode::kUnsupported, "Open3D integrates depth images only");
  const FramePoints cropped = scan.cropped(points, i, options.frame, tally);
  out.metres.assign(std::size_t(points.width) * std::size_t(points.height), 0.0f);
  for (std::size_t k = 0; k < cropped.cell.size(); ++k)
    out.metres[std::size_t(cropped.cell[k])] = cropped.cloud.points[k].z();
  tally.figures.points += cropped.cloud.size();
  tally.watch.lap("crop");
  return out;
}

double truncation(const Options& options) {
  return options.truncation_m > 0.0 ? options.truncation_m : 4.0 * options.voxel_size_m;
}

/// Without the crumbs that stray pixels leave in the air: pieces of less than 2 % of the triangles
/// of the largest, as for turnscan's own methods.
open3d::geometry::TriangleMesh without_crumbs(open3d::geometry::TriangleMesh mesh) {
  constexpr double kMinShare = 0.02;
  const auto [cluster, counts, areas] = mesh.ClusterConnectedTriangles();
  if (counts.empty()) return mesh;
  const auto most = double(*std::max_element(counts.begin(), counts.end()));
  std::vector<bool> crumb(cluster.size());
  for (std::size_t t = 0; t < crumb.size(); ++t)
    crumb[t] = double(counts[std::size_t(cluster[t])]) < kMinShare * most;
  mesh.RemoveTrianglesByMask(crumb);
  mesh.RemoveUnreferencedVertices();
  return mesh;
}

Result<TriangleMesh> tsdf(const Scan& scan, const Options& options, Tally& tally) {
  open3d::pipelines::integration::ScalableTSDFVolume volume(
      options.voxel_size_m, truncation(options),
      open3d::pipelines::integration::TSDFVolumeColorType::NoColor, 16, 1);
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    if (!scan.usable(i)) continue;
    TURNSCAN_ASSIGN(const CroppedDepth depth, read_depth(scan, i, options, tally));
    const CameraIntrinsics& c = depth.sensor->intrinsics;
    open3d::geometry::RGBDImage image;
    image.depth_.Prepare(c.width, c.height, 1, 4);
    std::memcpy(image.depth_.data_.data(), depth.metres.data(), depth.metres.size() * 4);
    volume.Integrate(image, PinholeCameraIntrinsic(c.width, c.height, c.fx, c.fy, c.cx, c.cy),
                     depth.T_sensor_table);
    tally.watch.lap("integrate");
  }
  const auto mesh = volume.ExtractTriangleMesh();
  tally.watch.lap("surface");
  return from_open3d(without_crumbs(*mesh));
}

Tensor row_major(const Eigen::MatrixXd& m) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = m;
  return {rows.data(), {m.rows(), m.cols()}, open3d::core::Float64};
}

Result<TriangleMesh> voxel_blocks(const Scan& scan, const Options& options, Tally& tally) {
  using open3d::core::Float32;
  const auto size = static_cast<float>(options.voxel_size_m);
  const auto multiple = static_cast<float>(truncation(options) / options.voxel_size_m);
  open3d::t::geometry::VoxelBlockGrid grid({"tsdf", "weight"}, {Float32, Float32}, {{1}, {1}}, size,
                                           16, 20000);
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    if (!scan.usable(i)) continue;
    TURNSCAN_ASSIGN(const CroppedDepth depth, read_depth(scan, i, options, tally));
    const CameraIntrinsics& c = depth.sensor->intrinsics;
    Eigen::Matrix3d K;
    K << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1;
    const open3d::t::geometry::Image image(
        Tensor(depth.metres.data(), {c.height, c.width, 1}, Float32));
    const Tensor intrinsic = row_major(K), extrinsic = row_major(depth.T_sensor_table);
    const Tensor blocks =
        grid.GetUniqueBlockCoordinates(image, intrinsic, extrinsic, 1.0f, 10.0f, multiple);
    grid.Integrate(blocks, image, intrinsic, extrinsic, 1.0f, 10.0f, multiple);
    tally.watch.lap("integrate");
  }
  const auto mesh = grid.ExtractTriangleMesh(static_cast<float>(options.least_weight)).ToLegacy();
  tally.watch.lap("surface");
  return from_open3d(without_crumbs(mesh));
}

Result<TriangleMesh> reconstruct_with(const std::string& method, const Scan& scan,
                                      const Options& options, Tally& tally) {
  if (method == "points") return points_pipeline(scan, options, tally);
  if (method == "tsdf") return tsdf(scan, options, tally);
  if (method == "voxel-blocks") return voxel_blocks(scan, options, tally);
  if (method == "poisson") return raw_poisson(scan, options, tally);
  return fail(ErrorCode::kInvalidOption, "unknown method {}", method);
}

Result<> parse_and_run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 3 || arguments.size() % 2 == 0)
    return fail(ErrorCode::kInvalidOption,
                "usage: open3d_pipeline METHOD RECORDING OUT.ply [--OPTION VALUE]...");
  Options options;
  TURNSCAN_TRY(read_options(describe(options), {arguments.begin() + 3, arguments.end()}));
  Tally tally;
  TURNSCAN_ASSIGN(const Scan scan, Scan::open(arguments[1]));
  tally.watch.lap("read");
  TURNSCAN_ASSIGN(const TriangleMesh mesh, reconstruct_with(arguments[0], scan, options, tally));
  return finish(mesh, arguments[2], options.json, tally);
}

}  // namespace

int main(int argc, char** argv) {
  open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  return turnscan::plain::report("open3d_pipeline",
                                 parse_and_run(std::vector<std::string>(argv + 1, argv + argc)));
}
