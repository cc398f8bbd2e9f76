#pragma once
// Meshes and the platter, prepared for ray queries. Hides Embree.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// Points origin + t * direction with t in (t_min, t_max). direction need not have unit length.
struct Ray {
  Vec3f origin = Vec3f::Zero();
  Vec3f direction = Vec3f::UnitZ();
  float t_min = 0.0f;
  float t_max = std::numeric_limits<float>::infinity();
};

inline constexpr std::uint32_t kNoObject = 0xffffffffu;  ///< RayHit::object of a ray that missed
inline constexpr std::uint32_t kPlatter = 0xfffffffeu;   ///< RayHit::object of the platter

struct RayHit {
  float t = std::numeric_limits<float>::infinity();  ///< in lengths of the ray's direction
  std::uint32_t object = kNoObject;                  ///< index in the scene's objects
  std::uint32_t triangle = 0;                        ///< of that object; 0 on the platter
  float u = 0.0f, v = 0.0f;      ///< barycentric: (1 - u - v) a + u b + v c; 0 on the platter
  Vec3f normal = Vec3f::Zero();  ///< unit, from the triangle's winding; platter: +Y

  bool valid() const { return object != kNoObject; }
};

/// kCoherent: consecutive rays in the span have similar origins and directions, which is 1.5 to 2.5
/// times as fast. The result is the same either way.
enum class RayOrder { kCoherent, kIncoherent };

/// Immutable; all members may be called from several threads at once. Triangles are two-sided. No
/// ray slips through between two triangles that share an edge; of rays aimed exactly at a vertex
/// Embree 3.13 loses about one in 200 (measured on a sphere).
class Scene {
 public:
  /// Copies what it needs of the meshes. A mesh without triangles is allowed. platter_radius_m adds
  /// a disc about the y axis with its face at y = 0. Fails with kFormat if a triangle references a
  /// vertex that does not exist or is not finite, with kInvalidOption if the radius is not
  /// positive, and with kResourceLimit if Embree runs out of memory. The scene does not depend on
  /// the number of threads. Fails with kCancelled soon after the context is.
  static Result<Scene> create(std::span<const TriangleMesh> objects,
                              std::optional<double> platter_radius_m = std::nullopt,
                              const RunContext& context = RunContext());
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// The nearest hit of each ray. hits must have the same length as rays.
  void intersect(std::span<const Ray> rays, std::span<RayHit> hits,
                 RayOrder order = RayOrder::kIncoherent) const;
  RayHit intersect(const Ray& ray) const;

  /// 1 if anything is on the ray, else 0. blocked must have the same length as rays.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                RayOrder order = RayOrder::kIncoherent) const;
  bool occluded(const Ray& ray) const;

  std::size_t object_count() const;
  std::optional<double> platter_radius_m() const;
  /// The corners of a triangle. Preconditions: object < object_count() and has that triangle.
  std::array<Vec3f, 3> corners(std::uint32_t object, std::uint32_t triangle) const;
  /// Bounding box of the objects, without the platter.
  const Box& object_box() const;
  /// Bounding box of everything.
  Box box() const;

  /// For the simulator's own sources (scene_impl.hpp).
  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  explicit Scene(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
