// turnscan-concave-hull ALPHA_M
// The concave hull (alpha shape) of the points on standard input, as a mesh on standard output; the
// bytes of both are those of turnscan/reconstruction/surface/hull_bytes.hpp. On failure: exit 1 and
// one line on standard error, "CODE: SENTENCE", where CODE is the name of a turnscan::ErrorCode.

#include <fcntl.h>
#include <pcl/point_types.h>
#include <pcl/surface/concave_hull.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <memory>
#include <new>
#include <turnscan/core/process/helper_program.hpp>
#include <turnscan/core/process/process_setup.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/reconstruction/surface/hull_bytes.hpp>

namespace {

using namespace turnscan;

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Result<std::string> read_all(int descriptor) {
  std::string bytes;
  std::string part(std::size_t(1) << 20, '\0');
  while (true) {
    const ssize_t got = ::read(descriptor, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail(ErrorCode::kIo, "the points cannot be read");
    if (got == 0) return bytes;
    bytes.append(part, 0, static_cast<std::size_t>(got));
  }
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

TriangleMesh hull_of(const std::vector<Vec3f>& points, double alpha_m) {
  auto cloud = std::make_shared<Cloud>();
  for (const Vec3f& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
  pcl::ConcaveHull<pcl::PointXYZ> hull;
  hull.setInputCloud(cloud);
  hull.setAlpha(alpha_m);
  hull.setDimension(3);
  Cloud vertices;
  std::vector<pcl::Vertices> polygons;
  hull.reconstruct(vertices, polygons);
  TriangleMesh mesh;
  for (const auto& p : vertices.points) mesh.vertices.emplace_back(p.getVector3fMap());
  for (const auto& polygon : polygons) {
    if (polygon.vertices.size() != 3) continue;
    mesh.triangles.push_back({static_cast<std::uint32_t>(polygon.vertices[0]),
                              static_cast<std::uint32_t>(polygon.vertices[1]),
                              static_cast<std::uint32_t>(polygon.vertices[2])});
  }
  return mesh;
}

Result<> run(int argc, char** argv, int output) {
  if (argc != 2)
    return fail(ErrorCode::kLibrary, "usage: turnscan-concave-hull ALPHA_M < POINTS > MESH");
  TURNSCAN_ASSIGN(const double alpha_m, parse_number(argv[1]));
  TURNSCAN_ASSIGN(const std::string bytes, read_all(STDIN_FILENO));
  const auto points = surface::points_from_bytes(bytes);
  if (!points) return fail(ErrorCode::kFormat, "the points end within one");
  if (!write_all(output, surface::bytes_of_mesh(hull_of(*points, alpha_m))))
    return fail(ErrorCode::kIo, "the mesh cannot be written");
  return {};
}

Result<> run_guarded(int argc, char** argv, int output) {
  try {
    return run(argc, argv, output);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kResourceLimit, "it takes more memory than there is");
  } catch (const std::exception& error) {
    return fail(ErrorCode::kLibrary, "{}", error.what());
  }
}

/// As much memory as the machine has: what takes more would take the machine with it.
std::optional<std::uint64_t> memory_of_machine() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || size <= 0) return std::nullopt;
  return std::uint64_t(pages) * std::uint64_t(size);
}

}  // namespace

// The libraries write messages of their own, which go nowhere.
int main(int argc, char** argv) {
  process::set_up_process();
  process::limit_this_process({.memory_bytes = memory_of_machine()});
  const int output = ::dup(STDOUT_FILENO), errors = ::dup(STDERR_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  const Result<> result = run_guarded(argc, argv, output);
  if (result) ::_exit(0);
  const std::string& message = result.error().message;
  write_all(errors, fmt::format("{}: {}\n", name_of(result.error().code),
                                message.substr(0, message.find('\n'))));
  ::_exit(1);
}
