#include <turnscan/reconstruction/quality/thin_walls.hpp>

namespace turnscan::quality {

ThinWalls::ThinWalls(const TriangleMesh& mesh, std::span<const Vec3f> normals)
    : mesh_(mesh), distance_(mesh), side_(mesh), normals_(normals) {}

bool ThinWalls::thinner_than(double thickness_m, std::size_t vertex) const {
  const Vec3d behind =
      (mesh_.vertices[vertex] - float(thickness_m) * normals_[vertex]).cast<double>();
  const auto hit = distance_.closest(behind, thickness_m);
  return hit.triangle != MeshDistance::kNone &&
         (behind - hit.point).dot(side_.at(hit.point, hit.triangle)) > 0.0;
}

}  // namespace turnscan::quality
