#include <cmath>
#include <limits>
#include <turnscan/simulator/sample_packet.hpp>

namespace turnscan::sampling {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Rounding of a hit and of the way to it, relative to the distances concerned.
constexpr float kLift = 0x1p-20f;

/// Rays from one point; lanes that are not valid are left out by Embree, but it may look at them.
void fill_common(RTCRay16& ray, const float* origin) {
  for (int i = 0; i < kLanes; ++i) {
    ray.org_x[i] = origin[0];
    ray.org_y[i] = origin[1];
    ray.org_z[i] = origin[2];
    ray.tnear[i] = 0.0f;
    ray.time[i] = 0.0f;
    ray.mask[i] = 0xffffffffu;
    ray.id[i] = 0;
    ray.flags[i] = 0;
  }
}

/// direction[] = rotation * (x, y, z)
void rotate(const float* r, const float* x, const float* y, const float* z, RTCRay16& ray) {
  for (int i = 0; i < kLanes; ++i) {
    ray.dir_x[i] = r[0] * x[i] + r[1] * y[i] + r[2] * z[i];
    ray.dir_y[i] = r[3] * x[i] + r[4] * y[i] + r[5] * z[i];
    ray.dir_z[i] = r[6] * x[i] + r[7] * y[i] + r[8] * z[i];
  }
}

/// Where a ray meets the platter (y = 0), or infinity.
float platter_t(const RTCRay16& ray, int i, float radius_squared) {
  if (ray.dir_y[i] == 0.0f) return kInfinity;
  const float t = -ray.org_y[i] / ray.dir_y[i];
  if (!(t > ray.tnear[i] && t < ray.tfar[i])) return kInfinity;
  const float x = ray.org_x[i] + t * ray.dir_x[i], z = ray.org_z[i] + t * ray.dir_z[i];
  return x * x + z * z <= radius_squared ? t : kInfinity;
}

void take_hits(const BodyView& body, const RTCRayHit16& hits, Packet& p) {
  const float* r = body.rotation;
  for (int i = 0; i < kLanes; ++i) {
    const bool hit = hits.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    const float nx = hits.hit.Ng_x[i], ny = hits.hit.Ng_y[i], nz = hits.hit.Ng_z[i];
    p.z[i] = hit ? hits.ray.tfar[i] : p.z[i];
    p.surface[i] = hit ? body.id | hits.hit.geomID[i] : p.surface[i];
    p.triangle[i] = hit ? hits.hit.primID[i] : p.triangle[i];
    p.normal[0][i] = hit ? r[0] * nx + r[3] * ny + r[6] * nz : p.normal[0][i];
    p.normal[1][i] = hit ? r[1] * nx + r[4] * ny + r[7] * nz : p.normal[1][i];
    p.normal[2][i] = hit ? r[2] * nx + r[5] * ny + r[8] * nz : p.normal[2][i];
  }
}

void take_platter(const BodyView& body, const int* valid, const RTCRayHit16& hits, Packet& p) {
  for (int i = 0; i < kLanes; ++i) {
    if (valid[i] == 0) continue;
    const float t = platter_t(hits.ray, i, body.scene->platter_radius_squared);
    if (!(t < p.z[i])) continue;
    p.z[i] = t;
    p.surface[i] = body.id | (kPlatter & 0xffffffu);
    p.triangle[i] = 0;
    for (int k = 0; k < 3; ++k) p.normal[k][i] = body.rotation[3 + k];
  }
}

void intersect(const BodyView& body, const int* valid, RTCIntersectContext& context, Packet& p) {
  alignas(64) float ones[kLanes];
  for (float& one : ones) one = 1.0f;
  RTCRayHit16 hits;
  fill_common(hits.ray, body.origin);
  rotate(body.rotation, p.x, p.y, ones, hits.ray);
  for (int i = 0; i < kLanes; ++i) {
    hits.ray.tfar[i] = p.z[i];
    hits.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    hits.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect16(valid, body.scene->scene.get(), &context, &hits);
  take_hits(body, hits, p);
  if (body.scene->platter_radius_squared >= 0.0f) take_platter(body, valid, hits, p);
}

/// Everything but what may stand between the other eye and the surface. target: from that eye to
/// just above the surface.
void judge(const View& view, Packet& p, float (&target)[3][kLanes]) {
  for (int i = 0; i < kLanes; ++i) {
    const float x = p.x[i], y = p.y[i], z = p.z[i];
    const bool hit = z < kInfinity;
    const float nx = p.normal[0][i], ny = p.normal[1][i], nz = p.normal[2][i];
    const float px = hit ? x * z : 0.0f, py = hit ? y * z : 0.0f, pz = hit ? z : 0.0f;
    const float to_origin = -(nx * x + ny * y + nz);
    const float to_other =
        nx * (view.other[0] - px) + ny * (view.other[1] - py) + nz * (view.other[2] - pz);
    const float length = std::sqrt(nx * nx + ny * ny + nz * nz);
    const float ray = std::sqrt(x * x + y * y + 1.0f);
    const bool same_side = view.one_way || to_origin * to_other > 0.0f;
    const bool grazing = !(std::fabs(to_origin) >= view.least_cosine * length * ray);
    int miss = same_side ? int(Miss::kNone) : view.blocked;
    miss = grazing ? int(Miss::kGrazing) : miss;
    miss = z > view.far_m ? int(Miss::kTooFar) : miss;
    miss = z < view.near_m ? int(Miss::kTooNear) : miss;
    miss = hit ? miss : int(Miss::kNothing);
    p.miss[i] = x == x && y == y ? miss : int(Miss::kOutOfView);
    const float lift = kLift * (std::fabs(px) + std::fabs(py) + pz + view.size);
    const float scale = length > 0.0f ? (to_other > 0.0f ? lift : -lift) / length : 0.0f;
    target[0][i] = px + scale * nx - view.other[0];
    target[1][i] = py + scale * ny - view.other[1];
    target[2][i] = pz + scale * nz - view.other[2];
    p.z[i] = pz;
  }
}

bool any(const int* valid) {
  int all = 0;
  for (int i = 0; i < kLanes; ++i) all |= valid[i];
  return all != 0;
}

/// Takes out of valid those lanes that the body blocks.
void occlude(const BodyView& body, const float (&target)[3][kLanes], RTCIntersectContext& context,
             int* valid) {
  RTCRay16 ray;
  fill_common(ray, body.other);
  rotate(body.rotation, target[0], target[1], target[2], ray);
  for (int i = 0; i < kLanes; ++i) ray.tfar[i] = 1.0f;
  if (const float radius_squared = body.scene->platter_radius_squared; radius_squared >= 0.0f)
    for (int i = 0; i < kLanes; ++i)
      valid[i] = platter_t(ray, i, radius_squared) < kInfinity ? 0 : valid[i];
  rtcOccluded16(valid, body.scene->scene.get(), &context, &ray);
  // Embree marks a blocked ray with tfar = -inf.
  for (int i = 0; i < kLanes; ++i) valid[i] = ray.tfar[i] < 0.0f ? 0 : valid[i];
}

}  // namespace

void trace(const View& view, std::span<const std::uint32_t> bodies, RTCIntersectContext& context,
           Packet& p) {
  alignas(64) int valid[kLanes];
  alignas(64) float target[3][kLanes];
  for (int i = 0; i < kLanes; ++i) {
    valid[i] = p.x[i] == p.x[i] && p.y[i] == p.y[i] ? -1 : 0;
    p.z[i] = kInfinity;
    p.surface[i] = Samples::kNoSurface;
    p.triangle[i] = 0;
    p.normal[0][i] = p.normal[1][i] = p.normal[2][i] = 0.0f;
  }
  for (const std::uint32_t b : bodies) intersect(view.bodies[b], valid, context, p);
  judge(view, p, target);
  if (view.one_way) return;
  alignas(64) int seen[kLanes];
  for (int i = 0; i < kLanes; ++i) valid[i] = seen[i] = p.miss[i] == int(Miss::kNone) ? -1 : 0;
  for (const BodyView& body : view.bodies)
    if (any(valid)) occlude(body, target, context, valid);
  for (int i = 0; i < kLanes; ++i)
    if (seen[i] != valid[i]) p.miss[i] = view.blocked;
}

}  // namespace turnscan::sampling
