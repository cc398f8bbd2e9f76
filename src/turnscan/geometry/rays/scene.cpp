#include <algorithm>
#include <stdexcept>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/rays/scene_impl.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kPacket = 16;

Result<> check_mesh_indices(const TriangleMesh& mesh, std::size_t object) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= mesh.vertices.size())
        return fail(ErrorCode::kFormat,
                    "object {}: triangle {} names vertex {}, but there are {}; repair the mesh",
                    object, t, v, mesh.vertices.size());
      if (!mesh.vertices[v].allFinite())
        return fail(ErrorCode::kFormat,
                    "object {}: vertex {} of triangle {} is not finite; repair the mesh", object, v,
                    t);
    }
  }
  return {};
}

/// Lanes without a ray get the first one: where 16 lanes are emulated, Embree processes them, too.
template <class Packet>
void load(Packet& packet, std::span<const Ray> rays) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    const Ray& r = rays[i < rays.size() ? i : 0];
    packet.org_x[i] = r.origin.x();
    packet.org_y[i] = r.origin.y();
    packet.org_z[i] = r.origin.z();
    packet.tnear[i] = r.t_min;
    packet.dir_x[i] = r.direction.x();
    packet.dir_y[i] = r.direction.y();
    packet.dir_z[i] = r.direction.z();
    packet.time[i] = 0.0f;
    packet.tfar[i] = r.t_max;
    packet.mask[i] = 0xffffffffu;
    packet.id[i] = static_cast<unsigned>(i);
    packet.flags[i] = 0;
  }
}

void take(const RTCHit16& hit, float t, std::size_t i, RayHit& out) {
  out.t = t;
  out.object = hit.geomID[i];
  out.triangle = hit.primID[i];
  out.u = hit.u[i];
  out.v = hit.v[i];
  out.normal = Vec3f(hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]).normalized();
}

}  // namespace

Result<> Scene::Impl::attach(const TriangleMesh& mesh, std::uint32_t id) {
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  const bool there = vertices != nullptr && indices != nullptr;
  if (there) {
    objects[id] = {vertices, indices, static_cast<std::uint32_t>(mesh.vertices.size()),
                   static_cast<std::uint32_t>(mesh.triangles.size())};
    for (const Vec3f& p : mesh.vertices) vertices = std::copy_n(p.data(), 3, vertices);
    for (const auto& t : mesh.triangles) indices = std::copy_n(t.data(), 3, indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene.get(), geometry, id);
  }
  rtcReleaseGeometry(geometry);
  if (there) return {};
  return fail(ErrorCode::kResourceLimit, "object {}: not enough memory for {} triangles", id,
              mesh.triangles.size());
}

const sampling::RasterMesh& Scene::Impl::raster() const {
  std::call_once(raster_once_, [&] { raster_ = sampling::RasterMesh::build(objects); });
  return *raster_;
}

std::size_t Scene::Impl::triangle_count() const {
  std::size_t count = 0;
  for (const sampling::ObjectView& object : objects) count += object.triangle_count;
  return count;
}

float Scene::Impl::platter_t(const Ray& ray) const {
  constexpr float kNever = std::numeric_limits<float>::infinity();
  if (!platter_radius_m || ray.direction.y() == 0.0f) return kNever;
  const float t = -ray.origin.y() / ray.direction.y();
  if (!(t > ray.t_min && t < ray.t_max)) return kNever;
  const float x = ray.origin.x() + t * ray.direction.x();
  const float z = ray.origin.z() + t * ray.direction.z();
  return x * x + z * z <= platter_radius_squared ? t : kNever;
}

void Scene::Impl::intersect_packet(std::span<const Ray> rays, std::span<RayHit> hits,
                                   embree::Query& query) const {
  alignas(64) int valid[kPacket] = {};
  RTCRayHit16 packet;
  load(packet.ray, rays);
  for (std::size_t i = 0; i < kPacket; ++i) {
    valid[i] = i < rays.size() ? -1 : 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  query.intersect(valid, scene.get(), packet);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits[i] = RayHit();
    const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    if (hit) take(packet.hit, packet.ray.tfar[i], i, hits[i]);
    const float t = platter_t(rays[i]);
    if (t < hits[i].t) hits[i] = {t, kPlatter, 0, 0.0f, 0.0f, Vec3f::UnitY()};
  }
}

void Scene::Impl::occluded_packet(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                                  embree::Query& query) const {
  alignas(64) int valid[kPacket] = {};
  RTCRay16 packet;
  load(packet, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    blocked[i] = std::isfinite(platter_t(rays[i])) ? 1 : 0;
    valid[i] = blocked[i] ? 0 : -1;
  }
  query.occluded(valid, scene.get(), packet);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    // Embree marks an occluded ray with tfar = -inf.
    if (valid[i] != 0 && packet.tfar[i] < 0.0f) blocked[i] = 1;
  }
}

Scene::Scene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Result<Scene> Scene::create(std::span<const TriangleMesh> objects,
                            std::optional<double> platter_radius_m, const RunContext& context) {
  if (platter_radius_m && !(*platter_radius_m > 0.0))
    return fail(ErrorCode::kInvalidOption, "platter: the radius {} m is not positive",
                *platter_radius_m);
  auto impl = std::make_unique<Impl>();
  impl->device.reset(rtcNewDevice(nullptr));
  if (!impl->device) return fail(ErrorCode::kLibrary, "Embree could not be started");
  impl->scene.reset(rtcNewScene(impl->device.get()));
  rtcSetSceneFlags(impl->scene.get(), RTC_SCENE_FLAG_ROBUST);
  impl->objects.resize(objects.size());
  impl->platter_radius_m = platter_radius_m;
  if (platter_radius_m)
    impl->platter_radius_squared = static_cast<float>(*platter_radius_m * *platter_radius_m);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    TURNSCAN_TRY(context.check());
    if (objects[i].empty()) continue;
    TURNSCAN_TRY(check_mesh_indices(objects[i], i));
    TURNSCAN_TRY(impl->attach(objects[i], static_cast<std::uint32_t>(i)));
    for (const auto& t : objects[i].triangles)
      for (const std::uint32_t v : t) impl->object_box.add(objects[i].vertices[v].cast<double>());
  }
  // Single-threaded: the tree, and thus the winner if two triangles tie, must not depend on the
  // number of threads. The device's setting is not used because it would apply to the whole
  // process.
  const auto goes_on = [](void* of, double) {
    return !static_cast<const RunContext*>(of)->cancelled();
  };
  rtcSetSceneProgressMonitorFunction(impl->scene.get(), goes_on, const_cast<RunContext*>(&context));
  run_on_this_thread([&] { rtcCommitScene(impl->scene.get()); });
  rtcSetSceneProgressMonitorFunction(impl->scene.get(), nullptr, nullptr);
  TURNSCAN_TRY(context.check());
  const RTCError error = rtcGetDeviceError(impl->device.get());
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    return fail(ErrorCode::kResourceLimit, "not enough memory to trace rays in this scene");
  if (error != RTC_ERROR_NONE)
    return fail(ErrorCode::kLibrary, "Embree failed with error {}", static_cast<int>(error));
  return Scene(std::move(impl));
}

void Scene::intersect(std::span<const Ray> rays, std::span<RayHit> hits, RayOrder order) const {
  if (hits.size() != rays.size()) throw std::invalid_argument("Scene::intersect: sizes differ");
  embree::Query query(order == RayOrder::kCoherent);
  for (std::size_t i = 0; i < rays.size(); i += kPacket) {
    const std::size_t n = std::min(kPacket, rays.size() - i);
    impl_->intersect_packet(rays.subspan(i, n), hits.subspan(i, n), query);
  }
}

RayHit Scene::intersect(const Ray& ray) const {
  RayHit hit;
  intersect({&ray, 1}, {&hit, 1});
  return hit;
}

void Scene::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                     RayOrder order) const {
  if (blocked.size() != rays.size()) throw std::invalid_argument("Scene::occluded: sizes differ");
  embree::Query query(order == RayOrder::kCoherent);
  for (std::size_t i = 0; i < rays.size(); i += kPacket) {
    const std::size_t n = std::min(kPacket, rays.size() - i);
    impl_->occluded_packet(rays.subspan(i, n), blocked.subspan(i, n), query);
  }
}

bool Scene::occluded(const Ray& ray) const {
  std::uint8_t blocked = 0;
  occluded({&ray, 1}, {&blocked, 1});
  return blocked != 0;
}

std::size_t Scene::object_count() const { return impl_->objects.size(); }
std::array<Vec3f, 3> Scene::corners(std::uint32_t object, std::uint32_t triangle) const {
  const sampling::ObjectView& o = impl_->objects[object];
  std::array<Vec3f, 3> out;
  for (std::size_t k = 0; k < 3; ++k) {
    const float* p = o.vertices + 3 * std::size_t(o.indices[3 * std::size_t(triangle) + k]);
    out[k] = {p[0], p[1], p[2]};
  }
  return out;
}

std::optional<double> Scene::platter_radius_m() const { return impl_->platter_radius_m; }
const Box& Scene::object_box() const { return impl_->object_box; }

Box Scene::box() const {
  Box box = impl_->object_box;
  if (const auto radius = impl_->platter_radius_m) {
    box.add({-*radius, 0.0, -*radius});
    box.add({*radius, 0.0, *radius});
  }
  return box;
}

}  // namespace turnscan
