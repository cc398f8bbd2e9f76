#pragma once
// The exact nearest point on a triangle mesh.

#include <cstdint>
#include <limits>
#include <memory>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// The point of triangle (a, b, c) nearest to p; handles degenerate triangles (segments, points).
/// Region test of Ericson, Real-Time Collision Detection (2005), section 5.1.5.
Vec3d closest_point_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// Answers nearest-point queries on a mesh (metres), with a conservative hierarchy of float boxes
/// and double arithmetic at the triangles. Queries may run from many threads. Triangles with an
/// index out of range or a vertex that is not finite are ignored.
class MeshDistance {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  struct Hit {
    Vec3d point = Vec3d::Zero();     ///< on the mesh
    std::uint32_t triangle = kNone;  ///< the lowest index among equally near ones; kNone: nothing
                                     ///< found
    double distance = std::numeric_limits<double>::infinity();  ///< metres, unsigned
  };

  /// Copies what it needs of the mesh. Takes half a second of processor for a million triangles.
  explicit MeshDistance(const TriangleMesh& mesh);
  /// The same, for meshes of any size. Fails with kCancelled soon after the context is.
  static Result<MeshDistance> create(const TriangleMesh& mesh, const RunContext& context);
  MeshDistance(MeshDistance&&) noexcept;
  MeshDistance& operator=(MeshDistance&&) noexcept;
  ~MeshDistance();

  /// Nearest point within max_distance (inclusive, metres). If nothing is found, as for an empty
  /// mesh or a p that is not finite: triangle == kNone.
  Hit closest(const Vec3d& p, double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Appends the triangles that may reach into a box, all that do and some beside it, until there
  /// are `most`.
  void append_near(const Vec3f& low, const Vec3f& high, std::size_t most,
                   std::vector<std::uint32_t>& out) const;

 private:
  struct Impl;
  explicit MeshDistance(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
