#include <algorithm>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/geometry/mesh/clip.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/low_pass.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/finishing/finishing.hpp>
#include <turnscan/reconstruction/finishing/hole_patches.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>

namespace turnscan::finishing {

namespace {

/// Per triangle or vertex: 1 if it is marked.
using Marks = std::vector<std::uint8_t>;

/// Does nothing if there are no values.
template <class T>
void keep_only(std::vector<T>& values, const Marks& kept) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < values.size(); ++v)
    if (kept[v]) values[count++] = values[v];
  values.resize(count);
}

/// Removes triangles with their attributes, and then unreferenced vertices.
void drop(ObjectResult& object, const Marks& dropped) {
  TriangleMesh& mesh = object.mesh;
  if (!object.evidence.empty()) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < dropped.size(); ++t)
      if (!dropped[t]) object.evidence[kept++] = object.evidence[t];
    object.evidence.resize(kept);
  }
  mesh::drop_triangles(mesh, dropped);
  Marks named(mesh.vertices.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) named[v] = 1;
  keep_only(object.confidence, named);
  keep_only(object.quality, named);
  mesh::compact_vertices(mesh);
}

/// Number of boundary edges of the remaining triangles that leave each vertex.
std::vector<std::uint32_t> boundaries_at(const TriangleMesh& mesh, const Marks& dropped) {
  Marks kept(dropped.size());
  std::transform(dropped.begin(), dropped.end(), kept.begin(),
                 [](std::uint8_t d) { return d ? 0 : 1; });
  const mesh::EdgeTable edges(mesh.triangles, mesh.vertices.size(), kept);
  std::vector<std::uint32_t> leaving(mesh.vertices.size(), 0);
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto on_edge = edges.half_edges(e);
    if (on_edge.size() == 1) ++leaving[mesh::origin(mesh, on_edge[0])];
  }
  return leaving;
}

/// Drops the triangles around vertices that are the only connection of the remaining surface.
void drop_at_pinches(const TriangleMesh& mesh, Marks& dropped) {
  for (bool found = true; found;) {
    found = false;
    const std::vector<std::uint32_t> leaving = boundaries_at(mesh, dropped);
    for (std::size_t t = 0; t < dropped.size(); ++t) {
      if (dropped[t] || std::none_of(mesh.triangles[t].begin(), mesh.triangles[t].end(),
                                     [&](std::uint32_t v) { return leaving[v] > 1; }))
        continue;
      dropped[t] = 1;
      found = true;
    }
  }
}

/// Drops the parts whose longest side is shorter. Returns their number.
Result<std::size_t> drop_small_parts(ObjectResult& object, double least_m) {
  const std::vector<Evidence> all(object.mesh.triangles.size(), Evidence::kInvented);
  Marks dropped(object.mesh.triangles.size(), 0);
  std::size_t parts = 0;
  for (const HolePatch& part : find_hole_patches(object.mesh, all)) {
    if (part.size_m >= least_m) continue;
    ++parts;
    for (const std::uint32_t t : part.triangles) dropped[t] = 1;
  }
  if (parts > 0) drop(object, dropped);
  return parts;
}

std::string holes_text(const std::vector<HolePatch>& patches, const char* what) {
  double area_m2 = 0.0;
  for (const HolePatch& patch : patches) area_m2 += patch.area_m2;
  return fmt::format("{} {}: {:.1f} cm^2 that nothing measured",
                     patches.size() == 1 ? std::string("one hole was")
                                         : fmt::format("{} holes were", patches.size()),
                     what, area_m2 * 1e4);
}

Result<> open_holes(ObjectResult& object, const std::vector<HolePatch>& patches, double size_m) {
  Marks dropped(object.mesh.triangles.size(), 0);
  for (const HolePatch& patch : patches)
    for (const std::uint32_t t : patch.triangles) dropped[t] = 1;
  drop_at_pinches(object.mesh, dropped);
  drop(object, dropped);
  // Scraps within unmeasured surface.
  TURNSCAN_TRY(drop_small_parts(object, size_m));
  object.left_open = true;
  object.notes.push_back(holes_text(patches, "left open"));
  return {};
}

/// Replaces the interior of the patches by a surface of least area over their rims.
Result<> flatten_holes(ObjectResult& object, const std::vector<HolePatch>& patches,
                       const RunContext& context) {
  const TriangleMesh& mesh = object.mesh;
  Marks flat(mesh.triangles.size(), 0), movable(mesh.vertices.size(), 0);
  for (const HolePatch& patch : patches)
    for (const std::uint32_t t : patch.triangles) flat[t] = 1;
  for (const int want : {1, 0})
    for (std::size_t t = 0; t < flat.size(); ++t)
      if (flat[t] == want)
        for (const std::uint32_t v : mesh.triangles[t]) movable[v] = std::uint8_t(want);
  RelaxOptions membrane;
  membrane.tension = 1.0;
  TURNSCAN_ASSIGN(object.mesh, relax(mesh, movable, membrane, context));
  object.notes.push_back(holes_text(patches, "closed flat"));
  return {};
}

/// Requires the evidence.
Result<> settle_holes(const FinishOptions& options, ObjectResult& object,
                      const RunContext& context) {
  if (options.holes == Holes::kSmooth) return {};
  std::vector<HolePatch> patches = find_hole_patches(object.mesh, object.evidence);
  const bool open = options.holes == Holes::kOpen;
  std::erase_if(patches, [&](const HolePatch& patch) {
    // The platter's plane is flat already.
    const bool base = std::any_of(patch.triangles.begin(), patch.triangles.end(),
                                  [&](auto t) { return object.evidence[t] == Evidence::kBase; });
    return patch.size_m < options.hole_size_m || (!open && base);
  });
  if (patches.empty()) return {};
  return open ? open_holes(object, patches, options.hole_size_m)
              : flatten_holes(object, patches, context);
}

VertexQuality worse_of(const VertexQuality& a, const VertexQuality& b) {
  return {std::max(a.expected_error_m, b.expected_error_m), std::min(a.frames, b.frames),
          std::min(a.directions, b.directions)};
}

/// Transfers the attributes of a clipped mesh's parts.
void take(ClippedMesh clipped, ObjectResult& object) {
  if (!object.evidence.empty()) {
    std::vector<Evidence> evidence;
    for (const std::uint32_t t : clipped.source)
      evidence.push_back(t == ClippedMesh::kCutFace ? Evidence::kCut : object.evidence[t]);
    object.evidence = std::move(evidence);
  }
  if (!object.confidence.empty()) {
    std::vector<float> confidence;
    for (const auto& [a, b] : clipped.vertex_source)
      confidence.push_back(std::min(object.confidence[a], object.confidence[b]));
    object.confidence = std::move(confidence);
  }
  if (!object.quality.empty()) {
    std::vector<VertexQuality> quality;
    for (const auto& [a, b] : clipped.vertex_source)
      quality.push_back(worse_of(object.quality[a], object.quality[b]));
    object.quality = std::move(quality);
  }
  object.mesh = std::move(clipped.mesh);
}

Result<> cut(ObjectResult& object, const std::vector<HalfSpace>& kept, const RunContext& context) {
  double area_m2 = 0.0;
  bool outlines_cross = false;
  for (const HalfSpace& half_space : kept) {
    TURNSCAN_TRY(context.check());
    TURNSCAN_ASSIGN(ClippedMesh clipped, clip(object.mesh, half_space));
    area_m2 += clipped.cut_area_m2;
    outlines_cross = outlines_cross || clipped.outlines_cross;
    take(std::move(clipped), object);
  }
  if (area_m2 > 0.0)
    object.notes.push_back(fmt::format("it was cut as asked for, with {:.1f} cm^2 of flat faces{}",
                                       area_m2 * 1e4,
                                       outlines_cross ? ", some of which cross each other" : ""));
  return {};
}

double invented_area(const ObjectResult& object) {
  double area_m2 = 0.0;
  for (std::size_t t = 0; t < object.evidence.size(); ++t)
    if (object.evidence[t] == Evidence::kInvented) area_m2 += triangle_area(object.mesh, t);
  return area_m2;
}

Result<> finish_object(const FinishOptions& options, const std::vector<HalfSpace>& kept,
                       ObjectResult& object, const RunContext& context) {
  TURNSCAN_TRY(context.check());
  TURNSCAN_TRY(settle_holes(options, object, context));
  if (options.smooth_m > 0.0) {
    TURNSCAN_ASSIGN(object.mesh, low_pass(object.mesh, options.smooth_m, context));
  }
  TURNSCAN_TRY(cut(object, kept, context));
  if (options.smallest_part_m > 0.0) {
    TURNSCAN_ASSIGN(const std::size_t parts, drop_small_parts(object, options.smallest_part_m));
    if (parts > 0)
      object.notes.push_back(
          fmt::format("{} smaller than {} {} dropped",
                      parts == 1 ? std::string("one part") : fmt::format("{} parts", parts),
                      length_text(options.smallest_part_m), parts == 1 ? "was" : "were"));
  }
  object.check = check_mesh(object.mesh);
  if (!object.evidence.empty()) object.invented_area_m2 = invented_area(object);
  return {};
}

}  // namespace

Result<> finish_objects(const FinishOptions& options, Reconstruction& reconstruction,
                        const RunContext& context) {
  std::vector<ObjectResult>& objects = reconstruction.objects;
  if (options.object) {
    const auto number = std::size_t(*options.object);
    if (number > objects.size())
      return fail(ErrorCode::kInvalidOption, "only-object {}: there {} only {}", number,
                  objects.size() == 1 ? "is" : "are", objects.size());
    ObjectResult chosen = std::move(objects[number - 1]);
    objects.clear();
    objects.push_back(std::move(chosen));
    std::erase_if(reconstruction.choices, [&](ResolvedParameter& choice) {
      const bool others = choice.object >= 0 && choice.object != int(number) - 1;
      choice.object = std::min(choice.object, 0);
      return others;
    });
  }
  TURNSCAN_ASSIGN(const std::vector<HalfSpace> kept, kept_half_spaces(options));
  if (options.holes == Holes::kSmooth && !(options.smooth_m > 0.0) && kept.empty() &&
      !(options.smallest_part_m > 0.0))
    return {};
  const StageTimer timer(reconstruction.stages, "finish");
  context.begin_phase("finish", objects.size());
  for (ObjectResult& object : objects) {
    TURNSCAN_TRY(finish_object(options, kept, object, context));
    context.advance();
  }
  std::erase_if(objects, [](const ObjectResult& object) { return object.mesh.triangles.empty(); });
  if (objects.empty())
    return fail(
        ErrorCode::kTooFewPoints,
        "nothing is left: all parts are smaller than --smallest-part or --hole-size, or cut "
        "away");
  return {};
}

}  // namespace turnscan::finishing
