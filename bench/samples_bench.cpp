// Samples of a virtual scanner beside the same rays in a bare Embree loop and in the loop of
// Open3D's RaycastingScene, in one run. Times are of the process's CPU, so that a busy machine
// disturbs them little; each is the best of several rounds in which all take turns.
//
//   samples_bench [rounds] [triangles in thousands ...]

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numbers>
#include <string>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/rays/embree.hpp>
#include <turnscan/simulator/sampling/samples.hpp>
#include <vector>

namespace {

using turnscan::Body;
using turnscan::kTurn;
using turnscan::Pose;
using turnscan::SampleGrid;
using turnscan::SampleTracer;
using turnscan::ScannerModel;
using turnscan::TriangleMesh;
using turnscan::Vec3d;
using turnscan::Vec3f;

constexpr int kLanes = 16;

/// A torus with bumps, 0.4 m across, standing upright on y = 0.
TriangleMesh bumpy_torus(std::size_t triangles) {
  const auto n = static_cast<std::uint32_t>(std::sqrt(double(triangles)));
  const std::uint32_t m = n / 2;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const double a = kTurn * i / n, b = kTurn * j / m;
      const double r = 0.06 + 0.004 * std::sin(13 * a) * std::sin(7 * b);
      const double ring = 0.13 + r * std::cos(b);
      mesh.vertices.push_back(
          Vec3d(ring * std::cos(a), 0.2 + ring * std::sin(a), r * std::sin(b)).cast<float>());
      const std::uint32_t p = i * m + j, q = (i + 1) % n * m + j, s = (j + 1) % m - j;
      mesh.triangles.push_back({p, q, q + s});
      mesh.triangles.push_back({p, q + s, p + s});
    }
  }
  return mesh;
}

struct Embree {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);

  Embree(const TriangleMesh& mesh, int flags) {
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(flags));
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
        g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
    for (const Vec3f& p : mesh.vertices) v = std::copy_n(p.data(), 3, v);
    auto* t = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) t = std::copy_n(triangle.data(), 3, t);
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(scene);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

struct View {
  float rotation[9], origin[3], emitter[3];
  float fx, fy, cx, cy;
  int width, height;
};

View view_of(const ScannerModel& model, const Pose& T) {
  View v{};
  for (int i = 0; i < 9; ++i) v.rotation[i] = float(T.linear()(i / 3, i % 3));
  const Vec3d e = T * model.other_eye_m();
  for (int k = 0; k < 3; ++k) v.origin[k] = float(T.translation()[k]), v.emitter[k] = float(e[k]);
  const auto& c = model.camera;
  v.fx = float(c.fx), v.fy = float(c.fy), v.cx = float(c.cx), v.cy = float(c.cy);
  v.width = c.width, v.height = c.height;
  return v;
}

struct Output {
  std::vector<float> z;
  std::vector<std::uint32_t> triangle;
};

/// One packet of neighbours through Embree: a ray to the surface and one to the emitter.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
void bare_packet(RTCScene scene, turnscan::embree::Query& query, const View& view, int left, int top,
                 int tile_width, Output& out) {
  alignas(64) int valid[kLanes];
  alignas(64) RTCRayHit16 p;
  const float* r = view.rotation;
  const int shift = tile_width == 4 ? 2 : 0;
  for (int i = 0; i < kLanes; ++i) {
    const int u = left + (i & (tile_width - 1)), v = top + (i >> shift);
    const float x = (float(u) - view.cx) / view.fx, y = (float(v) - view.cy) / view.fy;
    valid[i] = u < view.width && v < view.height ? -1 : 0;
    p.ray.org_x[i] = view.origin[0], p.ray.org_y[i] = view.origin[1];
    p.ray.org_z[i] = view.origin[2];
    p.ray.dir_x[i] = r[0] * x + r[1] * y + r[2];
    p.ray.dir_y[i] = r[3] * x + r[4] * y + r[5];
    p.ray.dir_z[i] = r[6] * x + r[7] * y + r[8];
    p.ray.tnear[i] = 0.0f, p.ray.time[i] = 0.0f;
    p.ray.tfar[i] = std::numeric_limits<float>::infinity();
    p.ray.mask[i] = 0xffffffffu, p.ray.flags[i] = 0, p.ray.id[i] = 0;
    p.hit.geomID[i] = p.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  query.intersect(valid, scene, p);
  alignas(64) RTCRay16 s;
  alignas(64) int lit[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    lit[i] = p.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? valid[i] : 0;
    const float t = lit[i] ? p.ray.tfar[i] : 0.0f;
    s.org_x[i] = view.emitter[0], s.org_y[i] = view.emitter[1], s.org_z[i] = view.emitter[2];
    s.dir_x[i] = view.origin[0] + t * p.ray.dir_x[i] - view.emitter[0];
    s.dir_y[i] = view.origin[1] + t * p.ray.dir_y[i] - view.emitter[1];
    s.dir_z[i] = view.origin[2] + t * p.ray.dir_z[i] - view.emitter[2];
    s.tnear[i] = 0.0f, s.time[i] = 0.0f, s.tfar[i] = 1.0f - 1e-5f;
    s.mask[i] = 0xffffffffu, s.flags[i] = 0, s.id[i] = 0;
  }
  query.occluded(lit, scene, s);
  for (int i = 0; i < kLanes; ++i) {
    const int u = left + (i & (tile_width - 1)), v = top + (i >> shift);
    if (!valid[i]) continue;
    const std::size_t at = std::size_t(v) * std::size_t(view.width) + std::size_t(u);
    out.z[at] = lit[i] && s.tfar[i] > 0.0f ? p.ray.tfar[i] : 0.0f;
    const bool hit = p.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    out.triangle[at] = hit ? p.hit.primID[i] : RTC_INVALID_GEOMETRY_ID;
  }
}

void bare_pose(const Embree& embree, const View& view, Output& out) {
  turnscan::embree::Query query(true);
  const int width = view.width >= 4 ? 4 : 1, height = kLanes / width;
  out.z.resize(std::size_t(view.width) * std::size_t(view.height));
  out.triangle.resize(out.z.size());
  for (int top = 0; top < view.height; top += height)
    for (int left = 0; left < view.width; left += width)
      bare_packet(embree.scene, query, view, left, top, width, out);
}

/// What cast_rays of Open3D 0.13 and later returns.
struct CastRays {
  std::vector<float> t_hit, uvs, normals;
  std::vector<unsigned> geometry_ids, primitive_ids;
  std::vector<std::uint8_t> lit;
  void resize(std::size_t n) {
    t_hit.resize(n), uvs.resize(2 * n), normals.resize(3 * n), lit.resize(n);
    geometry_ids.resize(n), primitive_ids.resize(n);
  }
  void take(const RTCRayHit& r, std::size_t at) {
    t_hit[at] = r.ray.tfar;
    const bool hit = r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    geometry_ids[at] = r.hit.geomID;
    primitive_ids[at] = hit ? r.hit.primID : RTC_INVALID_GEOMETRY_ID;
    uvs[2 * at] = hit ? r.hit.u : 0.0f, uvs[2 * at + 1] = hit ? r.hit.v : 0.0f;
    const Vec3f n(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z);
    const Vec3f unit = hit ? Vec3f(n / n.norm()) : Vec3f::Zero();
    for (std::size_t k = 0; k < 3; ++k) normals[3 * at + k] = unit[int(k)];
  }
};

/// Rays of a batch, one by one or as Embree 3's stream.
void intersect_batch(RTCScene scene, std::vector<RTCRayHit>& hits, std::size_t n) {
#if TURNSCAN_EMBREE_MAJOR >= 4
  for (std::size_t i = 0; i < n; ++i) rtcIntersect1(scene, &hits[i]);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1M(scene, &context, hits.data(), unsigned(n), sizeof(RTCRayHit));
#endif
}

void occlude_batch(RTCScene scene, std::vector<RTCRay>& rays, std::size_t n) {
#if TURNSCAN_EMBREE_MAJOR >= 4
  for (std::size_t i = 0; i < n; ++i) rtcOccluded1(scene, &rays[i]);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1M(scene, &context, rays.data(), unsigned(n), sizeof(RTCRay));
#endif
}

/// What a user of Open3D gets from cast_rays of a tensor of rays and then test_occlusions from the
/// hits to the emitter: streams of single rays, context as initialised (incoherent), scene ROBUST
/// with filter functions. In batches of 1024, as its newer versions (its older: of 1 M).
void open3d_pose(const Embree& embree, const View& view, const std::vector<float>& rays,
                 CastRays& out) {
  constexpr std::size_t kBatch = 1024;
  const std::size_t total = rays.size() / 6;
  out.resize(total);
  std::vector<RTCRayHit> hits(kBatch);
  std::vector<RTCRay> shadows(kBatch);
  const float* e = view.emitter;
  for (std::size_t from = 0; from < total; from += kBatch) {
    const std::size_t n = std::min(kBatch, total - from);
    for (std::size_t i = 0; i < n; ++i) {
      const float* r = rays.data() + 6 * (from + i);
      hits[i].ray = {r[0],        r[1],        r[2],
                     0.0f,        r[3],        r[4],
                     r[5],        0.0f,        std::numeric_limits<float>::infinity(),
                     0xffffffffu, unsigned(i), 0};
      hits[i].hit.geomID = hits[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect_batch(embree.scene, hits, n);
    std::size_t m = 0;
    for (std::size_t i = 0; i < n; ++i) {
      out.take(hits[i], from + i);
      out.lit[from + i] = hits[i].hit.geomID != RTC_INVALID_GEOMETRY_ID;
      if (!out.lit[from + i]) continue;
      const float t = hits[i].ray.tfar, *r = rays.data() + 6 * (from + i);
      shadows[m++] = {e[0],
                      e[1],
                      e[2],
                      0.0f,
                      r[0] + t * r[3] - e[0],
                      r[1] + t * r[4] - e[1],
                      r[2] + t * r[5] - e[2],
                      0.0f,
                      1.0f - 1e-5f,
                      0xffffffffu,
                      unsigned(i),
                      0};
    }
    occlude_batch(embree.scene, shadows, m);
    for (std::size_t k = 0; k < m; ++k)
      if (shadows[k].tfar < 0.0f) out.lit[from + shadows[k].id] = 0;
  }
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

struct Setup {
  std::string name;
  ScannerModel model;
  double distance_m;
  int poses;
};

std::vector<Pose> poses_of(const Setup& setup) {
  std::vector<Pose> poses;
  for (int i = 0; i < setup.poses; ++i) {
    const double c = std::cos(0.3), s = std::sin(0.3);
    Pose T = Pose::Identity();
    T.linear().col(0) = Vec3d(-1.0, 0.0, 0.0);
    T.linear().col(1) = Vec3d(0.0, -c, -s);
    T.linear().col(2) = Vec3d(0.0, -s, c);
    T.translation() = Vec3d(0.0, 0.2, 0.0) - setup.distance_m * T.linear().col(2);
    poses.push_back(turnscan::rotation_about_y(kTurn * i / setup.poses) * T);
  }
  return poses;
}

std::vector<Setup> setups() {
  ScannerModel kinect;
  kinect.camera.width = 512, kinect.camera.height = 424;
  kinect.camera.fx = kinect.camera.fy = 365.5;
  kinect.camera.cx = 255.5, kinect.camera.cy = 211.5;
  kinect.emitter_m = {0.08, 0.0, 0.0};
  kinect.max_incidence_rad = std::numbers::pi / 2;
  ScannerModel narrow = kinect;
  narrow.camera.fx = narrow.camera.fy = 850.0;
  ScannerModel line = kinect;
  line.kind = turnscan::ScannerKind::kLine;
  line.camera.width = 1, line.camera.height = 1280;
  line.camera.cx = 0.0, line.camera.cy = 639.5;
  line.camera.fx = line.camera.fy = 1600.0;
  line.receiver_m = {0.1, 0.0, 0.0};
  return {{"matrix, object fills the view", narrow, 0.7, 12},
          {"matrix, from 0.3 m", kinect, 0.30, 12},
          {"matrix, object small in the view", kinect, 0.9, 12},
          {"line of 1280", line, 0.6, 400}};
}

struct Way {
  std::string name;
  std::function<void()> run;
  double best = 1e9;
};

void compare(const Setup& setup, const TriangleMesh& mesh, int rounds) {
  const std::vector<Pose> poses = poses_of(setup);
  const Embree robust(mesh, RTC_SCENE_FLAG_ROBUST);
  const Embree open3d(mesh, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  const auto scene = turnscan::Scene::create({&mesh, 1});
  const auto tracer = SampleTracer::create(setup.model);
  const auto by_rays = SampleTracer::create(
      setup.model, {turnscan::HitMethod::kRays, turnscan::OcclusionMethod::kAllRays});
  const auto drawn = SampleTracer::create(
      setup.model, {turnscan::HitMethod::kDrawn, turnscan::OcclusionMethod::kDoubtful});
  const auto traced = SampleTracer::create(
      setup.model, {turnscan::HitMethod::kRays, turnscan::OcclusionMethod::kDoubtful});
  const Body body{&*scene, Pose::Identity()};
  std::vector<Output> bare(poses.size());
  std::vector<CastRays> theirs(poses.size());
  std::vector<SampleGrid> ours(poses.size()), rays_only(poses.size()), other(poses.size());
  std::vector<std::vector<float>> rays(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (int v = 0; v < setup.model.camera.height; ++v) {
      for (int u = 0; u < setup.model.camera.width; ++u) {
        const Vec3d d = poses[i].linear() * tracer->direction(u, v), o = poses[i].translation();
        for (const Vec3d& p : {o, d})
          for (int k = 0; k < 3; ++k) rays[i].push_back(float(p[k]));
      }
    }
  }
  const auto each = [&](const auto& pose) { turnscan::parallel_for(poses.size(), 1, pose); };
  std::vector<Way> ways{
      {"bare Embree packets",
       [&] {
         each([&](std::size_t i) { bare_pose(robust, view_of(setup.model, poses[i]), bare[i]); });
       }},
      {"SampleTracer, all rays",
       [&] { each([&](std::size_t i) {
               by_rays->trace({&body, 1}, poses[i], rays_only[i]);
             }); }},
      {"rays where in doubt",
       [&] { each([&](std::size_t i) {
               traced->trace({&body, 1}, poses[i], other[i]);
             }); }},
      {"drawn",
       [&] { each([&](std::size_t i) {
               drawn->trace({&body, 1}, poses[i], other[i]);
             }); }},
      {"SampleTracer",
       [&] { each([&](std::size_t i) {
               tracer->trace({&body, 1}, poses[i], ours[i]);
             }); }},
      {"Open3D's loop", [&] {
         each([&](std::size_t i) {
           open3d_pose(open3d, view_of(setup.model, poses[i]), rays[i], theirs[i]);
         });
       }}};
  for (int round = 0; round < rounds; ++round) {
    for (Way& way : ways) {
      const double start = cpu_seconds();
      way.run();
      way.best = std::min(way.best, cpu_seconds() - start);
    }
  }
  std::size_t pixels = 0, hits = 0, seen = 0;
  for (const Output& o : bare) {
    pixels += o.z.size();
    for (std::size_t i = 0; i < o.z.size(); ++i)
      hits += o.triangle[i] != RTC_INVALID_GEOMETRY_ID, seen += o.z[i] > 0.0f;
  }
  const double n = double(poses.size());
  fmt::print("{} triangles, {}: {:.0f} % of the pixels hit, {:.1f} % of these seen by both\n",
             mesh.triangles.size(), setup.name, 100.0 * double(hits) / double(pixels),
             100.0 * double(seen) / double(hits));
  for (const Way& way : ways)
    fmt::print(
        "  {:<23} {:8.3f} ms a pose and core  {:6.2f} Mrays/s  {:6.2f} Msamples/s  {:5.2f}\n",
        way.name, 1e3 * way.best / n, 1e-6 * double(pixels + hits) / way.best,
        1e-6 * double(pixels) / way.best, ways[0].best / way.best);
  std::size_t changed = 0;
  for (std::size_t k = 0; k < poses.size(); ++k)
    for (std::size_t i = 0; i < ours[k].size(); ++i)
      changed += ours[k].miss[i] != rays_only[k].miss[i] || ours[k].z[i] != rays_only[k].z[i] ||
                 ours[k].triangle[i] != rays_only[k].triangle[i];
  std::size_t other_hit = 0, other_triangle = 0, other_seen = 0, far = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const SampleGrid& g = ours[k];
    for (int v = 0; v < g.height; ++v) {
      for (int u = 0; u < g.width; ++u) {
        const std::size_t at = std::size_t(v) * std::size_t(g.width) + std::size_t(u);
        const bool in = g.contains(u, v), b = bare[k].triangle[at] != RTC_INVALID_GEOMETRY_ID;
        const bool hit = in && g.hit(g.index(u, v));
        other_hit += hit != b;
        if (!hit || !b) continue;
        const std::size_t i = g.index(u, v);
        other_triangle += g.triangle[i] != bare[k].triangle[at];
        other_seen += g.counts(i) != (bare[k].z[at] > 0.0f);
        far += g.counts(i) && bare[k].z[at] > 0.0f && std::abs(g.z[i] - bare[k].z[at]) > 1e-6f;
      }
    }
  }
  fmt::print("  differences between the two: {} samples\n", changed);
  fmt::print(
      "  differences to bare Embree: {} hit or not, {} triangle, {} seen or not, {} farther "
      "than 1 um, of {} pixels\n",
      other_hit, other_triangle, other_seen, far, pixels);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  std::vector<std::size_t> thousands;
  for (int i = 2; i < argc; ++i) thousands.push_back(std::size_t(std::atoi(argv[i])));
  if (thousands.empty()) thousands = {100, 300, 1000};
  for (const std::size_t k : thousands) {
    const TriangleMesh mesh = bumpy_torus(1000 * k);
    for (const Setup& setup : setups()) compare(setup, mesh, rounds);
  }
  return 0;
}
