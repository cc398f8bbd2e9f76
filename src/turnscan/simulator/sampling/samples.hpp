#pragma once
// Ideal samples of a scanner, without noise: the hit of every sample, and the reason if it does not
// count. A sample counts if its ray hits a surface within the scanner's range and the scanner's
// other eye sees the same side of the surface there.

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/sensors/scanner_model.hpp>
#include <vector>

namespace turnscan {

/// Why a sample (or, for coverage, a part of a surface) is missing. The tracer gives the first that
/// applies of kOutOfView, kNothing, kTooNear, kTooFar, kGrazing, and lastly occlusion from the
/// other eye; noise adds the last two.
enum class Miss : std::uint8_t {
  kNone,             ///< the sample counts
  kNothing,          ///< the ray hits nothing
  kTooNear,          ///< the surface hit is nearer than near_m
  kTooFar,           ///< the surface hit is farther than far_m
  kOutOfView,        ///< outside the image, or no ray corresponds to that image point
  kEmitterBlocked,   ///< the receiver sees it, the emitter does not
  kReceiverBlocked,  ///< the emitter sees it, the receiver does not
  kGrazing,          ///< the incidence angle is too large
  kTooDark,          ///< too little light returns
  kRejected          ///< removed by the sensor's own filters
};
inline constexpr int kMissCount = 10;

/// Lower case with hyphens: "emitter-blocked".
std::string_view name_of(Miss miss);

/// A rigid group of objects and its pose. The scene must outlive the call it is passed to.
struct Body {
  const Scene* scene = nullptr;
  Pose T_world_body = Pose::Identity();
};
inline constexpr std::size_t kMaxBodies = 255;

/// Pixels [left, right) x [top, bottom).
struct PixelRect {
  int left = 0, top = 0, right = 0, bottom = 0;
  int width() const { return right > left ? right - left : 0; }
  int height() const { return bottom > top ? bottom - top : 0; }
  bool operator==(const PixelRect&) const = default;
};

/// Samples as parallel arrays. z, surface and triangle describe whatever the ray hits, even if the
/// sample does not count.
struct Samples {
  static constexpr std::uint32_t kNoSurface = 0xffffffffu;

  std::vector<float> z;                 ///< depth along the optical axis, m; 0: nothing is hit
  std::vector<std::uint32_t> surface;   ///< body and object, see body() and object()
  std::vector<std::uint32_t> triangle;  ///< of the object; 0 on the platter
  std::vector<Miss> miss;

  std::size_t size() const { return z.size(); }
  bool counts(std::size_t i) const { return miss[i] == Miss::kNone; }
  bool hit(std::size_t i) const { return surface[i] != kNoSurface; }
  /// Index in the bodies traced. Precondition: hit(i).
  std::uint32_t body(std::size_t i) const { return surface[i] >> 24; }
  /// As RayHit::object. Precondition: hit(i).
  std::uint32_t object(std::size_t i) const {
    const std::uint32_t id = surface[i] & 0xffffffu;
    return id == (kPlatter & 0xffffffu) ? kPlatter : id;
  }
  void resize(std::size_t n);
};

/// The samples of an image within rect, row by row; those outside it see nothing (kNothing).
struct SampleGrid : Samples {
  int width = 0, height = 0;  ///< of the whole image
  PixelRect rect;

  bool contains(int column, int row) const {
    return column >= rect.left && column < rect.right && row >= rect.top && row < rect.bottom;
  }
  /// Precondition: contains(column, row).
  std::size_t index(int column, int row) const {
    return std::size_t(row - rect.top) * std::size_t(rect.width()) +
           std::size_t(column - rect.left);
  }
};

/// Geometry of a sample on its surface, computed in double from the triangle itself.
struct SampleHit {
  Vec3d p_sensor = Vec3d::Zero();
  Vec3d p_body = Vec3d::Zero();
  Vec3d normal_body = Vec3d::Zero();  ///< unit, by the triangle's winding; platter: +Y
  bool back = false;                  ///< the ray hits the side opposite to the normal
  double incidence_rad = 0.0;         ///< between ray and surface normal, [0, pi/2]
  double other_incidence_rad = 0.0;   ///< the same for the other eye
  double u = 0.0, v = 0.0;            ///< barycentric, as RayHit
};

enum class OcclusionMethod {
  /// Traces a ray to the other eye only from those samples of an image that something in it could
  /// occlude. Occluders thinner than the distance of two samples are ignored. For images whose
  /// other eye is displaced along their rows or columns, and without distortion.
  kDoubtful,
  kAllRays  ///< from every sample
};

enum class HitMethod {
  kCheapest,  ///< whichever is expected to be cheaper for the pose, by the number of triangles per
              ///< pixel
  kRays,      ///< a ray through every pixel
  /// Rasterises the triangles; a lens with distortion gets rays nevertheless. Gives the same
  /// triangle, and thus the same depth to the last bit, except where a ray hits an edge within
  /// rounding.
  kDrawn
};

struct TraceMethods {
  HitMethod hits = HitMethod::kCheapest;
  OcclusionMethod occlusion = OcclusionMethod::kDoubtful;
};

/// Immutable; all members may be called from several threads at once.
class SampleTracer {
 public:
  /// Fails as ScannerModel::check does.
  static Result<SampleTracer> create(const ScannerModel& model, const TraceMethods& methods = {});
  SampleTracer(SampleTracer&&) noexcept;
  SampleTracer& operator=(SampleTracer&&) noexcept;
  ~SampleTracer();

  const ScannerModel& model() const;

  /// The samples of the whole image, on the calling thread; out's memory is reused. The rect
  /// contains all pixels that may see a body. Occlusion ends 2^-20 of the distances concerned
  /// before the surface (about 2 um at 1 m), so that rounding occludes nothing. Throws
  /// std::invalid_argument if there are more than kMaxBodies bodies or one has no scene.
  void trace(std::span<const Body> bodies, const Pose& T_world_sensor, SampleGrid& out) const;

  /// The samples of rays in the directions (x[i], y[i], 1) from the sensor's origin, NaN for none
  /// (kOutOfView). Neighbours in the list should be neighbours in space: 16 are traced together.
  /// Also throws if x and y differ in length.
  void trace(std::span<const Body> bodies, const Pose& T_world_sensor, std::span<const float> x,
             std::span<const float> y, Samples& out) const;

  /// Direction with z = 1 of the ray through an image point; NaN if there is none.
  Vec3d direction(double u, double v) const;

  /// Details of a sample with a hit, seen in the given direction (z = 1).
  SampleHit hit_of(std::span<const Body> bodies, const Pose& T_world_sensor, const Samples& samples,
                   std::size_t i, const Vec3d& direction) const;

 private:
  struct Impl;
  explicit SampleTracer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
