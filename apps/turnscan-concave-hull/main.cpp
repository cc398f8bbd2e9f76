// turnscan-concave-hull ALPHA_M
// The concave hull (alpha shape) of the points on standard input, as a mesh on standard output; the
// bytes of both are those of turnscan/reconstruction/surface/hull_bytes.hpp. On failure: exit 1 and
// one line on standard error, "CODE: SENTENCE", where CODE is the name of a turnscan::ErrorCode.

#include <fcntl.h>
#include <libqhull_r/qhull_ra.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <limits>
#include <new>
#include <turnscan/core/process/helper_program.hpp>
#include <turnscan/core/process/process_setup.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/geometry/hull/alpha_shape.hpp>
#include <turnscan/reconstruction/surface/hull_bytes.hpp>

namespace {

using namespace turnscan;

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

/// Owns what Qhull allocates. Its errors jump past destructors, so everything that a call needs is
/// made before it.
class Qhull {
 public:
  Qhull() { qh_zero(&state_, stderr); }
  ~Qhull() {
    int left = 0, all = 0;
    qh_freeqhull(&state_, !qh_ALL);
    qh_memfreeshort(&state_, &left, &all);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  /// "QJ" moves points by less than single precision so that all facets are tetrahedra.
  bool triangulate(std::vector<coordT>& coordinates) {
    char flags[] = "qhull d QJ Pp";
    return qh_new_qhull(&state_, 3, static_cast<int>(coordinates.size() / 3), coordinates.data(),
                        False, flags, nullptr, stderr) == 0;
  }

  std::vector<Tetrahedron> tetrahedra() {
    std::vector<Tetrahedron> out;
    for (facetT* facet = state_.facet_list; facet && facet->next; facet = facet->next) {
      if (facet->upperdelaunay) continue;
      Tetrahedron& tetrahedron = out.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        const auto* vertex = static_cast<vertexT*>(facet->vertices->e[k].p);
        tetrahedron[k] = static_cast<std::uint32_t>(qh_pointid(&state_, vertex->point));
      }
    }
    return out;
  }

 private:
  qhT state_;
};

Result<TriangleMesh> hull_of(const std::vector<Vec3f>& points, double alpha_m) {
  if (points.size() > std::size_t(std::numeric_limits<int>::max() / 4))
    return fail(ErrorCode::kResourceLimit, "{} points are too many", points.size());
  std::vector<coordT> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vec3f& p : points) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  Qhull qhull;
  if (!qhull.triangulate(coordinates))
    return fail(ErrorCode::kLibrary, "Qhull cannot triangulate the points");
  return alpha_shape(points, qhull.tetrahedra(), alpha_m);
}

Result<> run(int argc, char** argv, int output) {
  if (argc != 2)
    return fail(ErrorCode::kLibrary, "usage: turnscan-concave-hull ALPHA_M < POINTS > MESH");
  TURNSCAN_ASSIGN(const double alpha_m, parse_number(argv[1]));
  TURNSCAN_ASSIGN(const std::string bytes, read_all(STDIN_FILENO));
  const auto points = surface::points_from_bytes(bytes);
  if (!points) return fail(ErrorCode::kFormat, "the points end within one");
  TURNSCAN_ASSIGN(const TriangleMesh hull, hull_of(*points, alpha_m));
  if (!write_all(output, surface::bytes_of_mesh(hull)))
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

// Qhull writes messages of its own, which go nowhere.
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
