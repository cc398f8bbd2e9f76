#pragma once
// Implementation of a scene, for sources of the simulator that call Embree themselves.

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <turnscan/geometry/rays/embree.hpp>
#include <turnscan/geometry/rays/raster_mesh.hpp>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/geometry/rays/triangle_clusters.hpp>
#include <type_traits>
#include <vector>

namespace turnscan {

struct Scene::Impl {
  struct DeviceDeleter {
    void operator()(RTCDevice released) const { rtcReleaseDevice(released); }
  };
  struct SceneDeleter {
    void operator()(RTCScene released) const { rtcReleaseScene(released); }
  };

  std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter> device;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter> scene;
  std::vector<sampling::ObjectView> objects;  ///< their buffers belong to Embree
  std::optional<double> platter_radius_m;
  float platter_radius_squared = -1.0f;  ///< negative if there is none
  Box object_box;

  /// Created on first use.
  const sampling::RasterMesh& raster() const;
  std::size_t triangle_count() const;

  Result<> attach(const TriangleMesh& mesh, std::uint32_t id);
  /// Parameter at which the ray intersects the platter, or infinity.
  float platter_t(const Ray& ray) const;
  void intersect_packet(std::span<const Ray> rays, std::span<RayHit> hits,
                        embree::Query& query) const;
  void occluded_packet(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                       embree::Query& query) const;

 private:
  mutable std::once_flag raster_once_;
  mutable std::optional<sampling::RasterMesh> raster_;
};

}  // namespace turnscan
