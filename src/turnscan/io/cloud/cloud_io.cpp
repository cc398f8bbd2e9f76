#include <algorithm>
#include <stdexcept>
#include <turnscan/core/units.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/cloud/pcd_read.hpp>
#include <turnscan/io/cloud/xyz_read.hpp>
#include <turnscan/io/file/decode_file.hpp>
#include <turnscan/io/file/file_frame.hpp>
#include <turnscan/io/file/file_name.hpp>
#include <turnscan/io/ply/ply_header.hpp>
#include <turnscan/io/ply/ply_read.hpp>
#include <turnscan/io/ply/ply_write.hpp>

namespace turnscan {

namespace {

Result<CloudFile> decode_ply(std::string_view bytes) {
  TURNSCAN_ASSIGN(auto content, ply::parse_ply(bytes, ply::PlyParts::kGrid));
  CloudFile file;
  file.cloud = std::move(content.cloud);
  file.grid_width = content.grid_width;
  file.grid_height = content.grid_height;
  file.grid = std::move(content.grid);
  file.viewpoint = content.viewpoint;
  return file;
}

template <class T>
void keep_only(std::vector<T>& values, const std::vector<std::int32_t>& new_place) {
  if (values.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (new_place[i] >= 0) values[kept++] = values[i];
  values.resize(kept);
}

/// Scanners write NaN for points without a return.
void drop_points_that_are_not_finite(CloudFile& file) {
  const std::vector<Vec3f>& points = file.cloud.points;
  std::vector<std::int32_t> new_place(points.size(), -1);
  std::int32_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite()) new_place[i] = kept++;
  if (static_cast<std::size_t>(kept) == points.size()) return;
  keep_only(file.cloud.points, new_place);
  keep_only(file.cloud.normals, new_place);
  keep_only(file.cloud.colors, new_place);
  keep_only(file.cloud.weights, new_place);
  keep_only(file.cloud.frame, new_place);
  for (std::int32_t& cell : file.grid)
    if (cell >= 0) cell = new_place[static_cast<std::size_t>(cell)];
}

/// In the file's own unit, which may be a thousandth of a millimetre.
Result<> check_distances(const std::vector<Vec3f>& points) {
  constexpr double kFarthest = 1e6 * kMaxDistance_m;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].cwiseAbs().maxCoeff() > kFarthest)
      return fail(ErrorCode::kFormat,
                  "a point has a coordinate beyond {:.0e}, which no scan has; check the file",
                  kFarthest);
  return {};
}

void require_lengths(const PointCloud& cloud) {
  const auto fits = [n = cloud.size()](std::size_t size) { return size == 0 || size == n; };
  if (!fits(cloud.normals.size()) || !fits(cloud.colors.size()) || !fits(cloud.weights.size()) ||
      !fits(cloud.frame.size()))
    throw std::invalid_argument("an attribute of a cloud must be empty or as long as its points");
}

void require_grid(const CloudFile& file) {
  const std::size_t cells =
      std::size_t(std::max(file.grid_width, 0)) * std::size_t(std::max(file.grid_height, 0));
  const auto limit = static_cast<std::int64_t>(file.cloud.size());
  if (file.grid.size() != cells ||
      std::any_of(file.grid.begin(), file.grid.end(),
                  [limit](std::int32_t cell) { return cell < -1 || cell >= limit; }))
    throw std::invalid_argument(
        "a grid of points must have width x height cells, each -1 or the position of a point");
}

ply::PlyJob job_of(const PointCloud& cloud) {
  ply::PlyJob job;
  job.points = cloud.points;
  job.normals = cloud.normals;
  job.colors = cloud.colors;
  job.weights = cloud.weights;
  job.frame = cloud.frame;
  return job;
}

Result<> write_job(const std::filesystem::path& path, const ply::PlyJob& job) {
  if (file::lower_extension(path) != "ply")
    return fail_at(path.string(), ErrorCode::kUnsupported,
                   "clouds are written as PLY only; give a name that ends in .ply");
  return write_file_atomically(path, [&job](FileSink& sink) { return ply::write_ply(sink, job); });
}

Result<CloudFile> checked(Result<CloudFile> file) {
  if (!file) return file;
  drop_points_that_are_not_finite(*file);
  TURNSCAN_TRY(check_distances(file->cloud.points));
  return file;
}

}  // namespace

Result<CloudFile> decode_cloud(std::string_view bytes) {
  if (!ply::looks_like_ply(bytes) && !pcd::looks_like_pcd(bytes))
    return fail(ErrorCode::kUnsupported, "neither a PLY nor a PCD file");
  return checked(ply::looks_like_ply(bytes) ? decode_ply(bytes) : pcd::parse_pcd(bytes));
}

Result<CloudFile> read_cloud(const std::filesystem::path& path) {
  return file::decode_file(path, [&](std::string_view bytes) {
    const bool by_content = ply::looks_like_ply(bytes) || pcd::looks_like_pcd(bytes);
    return by_content || !xyz::is_xyz_name(path) ? decode_cloud(bytes)
                                                 : checked(xyz::parse_xyz(bytes));
  });
}

Result<> write_cloud(const std::filesystem::path& path, const PointCloud& cloud, UpAxis up) {
  require_lengths(cloud);
  if (up != UpAxis::kZ) return write_job(path, job_of(cloud));
  const file::FileFrame frame{.z_up = true};
  PointCloud turned = cloud;
  file::to_file(frame, turned.points, turned.normals);
  ply::PlyJob job = job_of(turned);
  job.frame_mark = file::mark_of(frame);
  return write_job(path, job);
}

Result<> write_cloud(const std::filesystem::path& path, const CloudFile& file) {
  require_lengths(file.cloud);
  require_grid(file);
  ply::PlyJob job = job_of(file.cloud);
  job.grid_width = file.grid_width;
  job.grid_height = file.grid_height;
  job.grid = file.grid;
  job.viewpoint = file.viewpoint;
  return write_job(path, job);
}

}  // namespace turnscan
