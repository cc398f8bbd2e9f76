#include <algorithm>
#include <bit>
#include <cstring>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/ply/ply_write.hpp>
#include <vector>

namespace turnscan::ply {

namespace {

constexpr std::size_t kChunkRows = 4096;

/// Appends `value` in little-endian order and advances.
template <class T>
void append(char*& at, T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  std::memcpy(at, bytes.data(), sizeof(T));
  at += sizeof(T);
}

void put_vector(char*& at, const Vec3f& v) {
  append(at, v.x());
  append(at, v.y());
  append(at, v.z());
}

/// Writes n rows of at most max_row_bytes each; fill(at, i) writes row i and advances `at`.
template <class Fill>
Result<> write_rows(FileSink& sink, std::size_t n, std::size_t max_row_bytes, const Fill& fill) {
  std::vector<char> buffer(std::min(n, kChunkRows) * max_row_bytes);
  for (std::size_t begin = 0; begin < n; begin += kChunkRows) {
    char* at = buffer.data();
    for (std::size_t i = begin; i < std::min(n, begin + kChunkRows); ++i) fill(at, i);
    const auto used = static_cast<std::size_t>(at - buffer.data());
    TURNSCAN_TRY(sink.write(std::string_view(buffer.data(), used)));
  }
  return {};
}

std::string info_of(const PlyJob& job) {
  std::string text;
  if (!job.grid.empty())
    text += fmt::format("obj_info num_cols {}\nobj_info num_rows {}\n", job.grid_width,
                        job.grid_height);
  if (job.viewpoint)
    text += fmt::format(
        "obj_info {} {} {} {}\n", job.viewpoint->parallel ? "view_direction" : "viewpoint",
        job.viewpoint->value.x(), job.viewpoint->value.y(), job.viewpoint->value.z());
  if (!job.name.empty()) text += fmt::format("obj_info name {}\n", file::clean_name(job.name));
  if (!job.frame_mark.empty()) text += fmt::format("obj_info frame {}\n", job.frame_mark);
  return text;
}

std::string header_of(const PlyJob& job) {
  std::string text = "ply\nformat binary_little_endian 1.0\n" + info_of(job);
  text += fmt::format("element vertex {}\n", job.points.size());
  text += "property float x\nproperty float y\nproperty float z\n";
  if (!job.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!job.colors.empty())
    text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!job.weights.empty()) text += "property float weight\n";
  if (!job.confidence.empty()) text += "property float confidence\n";
  if (!job.frame.empty()) text += "property uint frame\n";
  if (!job.triangles.empty())
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n",
                        job.triangles.size());
  if (!job.grid.empty())
    text += fmt::format("element range_grid {}\nproperty list uchar int vertex_indices\n",
                        job.grid.size());
  return text + "end_header\n";
}

Result<> write_vertices(FileSink& sink, const PlyJob& job) {
  return write_rows(sink, job.points.size(), 39, [&job](char*& at, std::size_t i) {
    put_vector(at, job.points[i]);
    if (!job.normals.empty()) put_vector(at, job.normals[i]);
    if (!job.colors.empty()) {
      append(at, job.colors[i].r);
      append(at, job.colors[i].g);
      append(at, job.colors[i].b);
    }
    if (!job.weights.empty()) append(at, job.weights[i]);
    if (!job.confidence.empty()) append(at, job.confidence[i]);
    if (!job.frame.empty()) append(at, job.frame[i]);
  });
}

Result<> write_triangles(FileSink& sink, const PlyJob& job) {
  return write_rows(sink, job.triangles.size(), 13, [&job](char*& at, std::size_t i) {
    append(at, std::uint8_t(3));
    for (const std::uint32_t index : job.triangles[i]) append(at, index);
  });
}

Result<> write_grid(FileSink& sink, const PlyJob& job) {
  return write_rows(sink, job.grid.size(), 5, [&job](char*& at, std::size_t i) {
    append(at, std::uint8_t(job.grid[i] < 0 ? 0 : 1));
    if (job.grid[i] >= 0) append(at, job.grid[i]);
  });
}

}  // namespace

Result<> write_ply(FileSink& sink, const PlyJob& job) {
  TURNSCAN_TRY(sink.write(header_of(job)));
  TURNSCAN_TRY(write_vertices(sink, job));
  TURNSCAN_TRY(write_triangles(sink, job));
  return write_grid(sink, job);
}

}  // namespace turnscan::ply
