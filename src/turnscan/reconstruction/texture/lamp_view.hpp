#pragma once
// Surface illuminated by a distant lamp: the surface visible from it.

#include <optional>
#include <turnscan/reconstruction/texture/color_view.hpp>

namespace turnscan::texture {

/// Whether the lamp reaches a point.
enum class Lit : std::uint8_t {
  kNo,      ///< something occludes it, or the surface faces away
  kUnsure,  ///< the edge of a shadow is near
  kYes,
};

/// Shadow map (Williams 1978), made by a camera that looks from very far away.
class LampView {
 public:
  /// to_lamp: unit, the mesh's frame. pixel_m: of the map; edges of shadows are uncertain by two of
  /// them.
  LampView(const TriangleMesh& mesh, const Vec3f& to_lamp, double pixel_m);

  /// p: a point of the mesh.
  Lit lit(const Vec3f& p, const Vec3f& normal) const;

 private:
  Vec3f to_lamp_;
  ColorView view_;
  std::optional<DrawnMesh> drawn_;
};

}  // namespace turnscan::texture
