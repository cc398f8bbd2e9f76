#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/reconstruction/report.hpp>

namespace turnscan {

namespace {

using Json = nlohmann::ordered_json;

Json check_json(const MeshReport& r) {
  return {{"watertight", r.watertight()},
          {"closed", r.closed},
          {"manifold", r.manifold},
          {"oriented", r.oriented},
          {"outward", r.outward},
          {"components", r.components},
          {"boundary_edges", r.boundary_edges},
          {"non_manifold_edges", r.non_manifold_edges},
          {"non_manifold_vertices", r.non_manifold_vertices},
          {"degenerate_triangles", r.degenerate_triangles},
          {"area_cm2", r.area_m2 * 1e4},
          {"volume_cm3", r.volume_m3 * 1e6}};
}

Json verdict_json(const Verdict& verdict) {
  Json sentences = Json::array();
  for (const VerdictSentence& s : verdict.sentences) {
    Json own = {{"topic", s.topic}, {"level", name_of(s.level)}, {"text", s.text}};
    if (std::isfinite(s.value)) {
      own["value"] = s.value;
      own["unit"] = s.unit;
    }
    sentences.push_back(std::move(own));
  }
  return {{"colour", verdict.colour()}, {"sentences", sentences}};
}

Json texture_json(const TextureReport& texture) {
  Json gains = Json::array(), cameras = Json::array(), turned = Json::array();
  for (const double angle : texture.turned_rad) turned.push_back(angle * kDegreesPerRadian);
  for (const Vec3f& g : texture.gains) gains.push_back({g.x(), g.y(), g.z()});
  for (const TextureReport::Camera& camera : texture.cameras)
    cameras.push_back({{"sensor", camera.sensor},
                       {"refined", camera.refined},
                       {"misplaced_px", camera.misplaced_px},
                       {"deviation_px", camera.deviation_px},
                       {"moved_mm", camera.moved_m * 1e3},
                       {"turned_deg", camera.turned_rad * kDegreesPerRadian}});
  Json highlight;
  if (texture.highlight)
    highlight = {{"azimuth_deg", texture.highlight->azimuth_rad * kDegreesPerRadian},
                 {"elevation_deg", texture.highlight->elevation_rad * kDegreesPerRadian},
                 {"strength", texture.highlight->strength}};
  return {{"size_px", texture.size_px},
          {"texel_mm", texture.texel_m * 1e3},
          {"charts", texture.charts},
          {"stretch", texture.stretch},
          {"filled_share", texture.filled_share},
          {"one_view_share", texture.one_view_share},
          {"views", texture.views},
          {"gains", gains},
          {"turned_deg", turned},
          {"colour_cameras", cameras},
          {"disagreement_px", texture.disagreement_px},
          {"albedo", texture.albedo},
          {"highlight", highlight}};
}

Json object_json(const ObjectResult& o) {
  const Vec3d size = bounds(o.mesh.vertices).size() * 1e3;
  Json out = {{"name", o.mesh.name},
              {"points", o.points},
              {"candidates", o.candidates},
              {"surface_points", o.surface_points},
              {"vertices", o.mesh.vertices.size()},
              {"triangles", o.mesh.triangles.size()},
              {"size_mm", {size.x(), size.y(), size.z()}},
              {"invented_area_cm2", o.invented_area_m2 * 1e4},
              {"unknown_volume_cm3", o.unknown_volume_m3 * 1e6},
              {"mesh", check_json(o.check)},
              {"notes", o.notes}};
  if (o.texture) out["texture"] = texture_json(*o.texture);
  if (o.verdict) out["verdict"] = verdict_json(*o.verdict);
  return out;
}

Json passes_json(const Reconstruction& r) {
  Json passes = Json::array();
  for (const FusedPass& pass : r.passes) {
    Json rows = Json::array();
    const auto& m = pass.T_object_table.matrix();
    for (int i = 0; i < 4; ++i) rows.push_back({m(i, 0), m(i, 1), m(i, 2), m(i, 3)});
    Json own = {{"name", pass.name}, {"frames", pass.frames}, {"T_object_table", rows}};
    if (pass.object >= 0) own["object"] = pass.object + 1;
    if (pass.found) {
      own["sigma_mm"] = pass.found->sigma_m * 1e3;
      own["sigma_deg"] = pass.found->sigma_rad * kDegreesPerRadian;
      own["overlap_cm2"] = pass.found->overlap_m2 * 1e4;
    }
    passes.push_back(std::move(own));
  }
  return passes;
}

double peak_memory_bytes() {
  struct rusage own {
  }, children{};
  getrusage(RUSAGE_SELF, &own);
  getrusage(RUSAGE_CHILDREN, &children);
  return 1024.0 * double(std::max(own.ru_maxrss, children.ru_maxrss));
}

}  // namespace

std::string report_json(const Reconstruction& r, const ReconstructOptions& options) {
  Json stages = Json::object();
  double total = 0.0;
  for (const StageTime& stage : r.stages) {
    stages[stage.stage] = stage.seconds;
    total += stage.seconds;
  }
  Json choices = Json::array();
  for (const ResolvedParameter& c : r.choices)
    choices.push_back({{"option", c.option}, {"value", c.value}, {"reason", c.reason}});
  Json objects = Json::array();
  for (const ObjectResult& o : r.objects) objects.push_back(object_json(o));
  ReconstructOptions copy = options;
  Json given = Json::object();
  for (const OptionGroup& stage : describe_stages(copy)) {
    for (const OptionField& field : stage.table.fields())
      given[stage.name][field.name] = field.get();
  }
  const Json report = {{"software", "turnscan"},
                       {"version", version()},
                       {"frames", r.frames},
                       {"dropped_frames", r.dropped_frames},
                       {"passes", passes_json(r)},
                       {"returns", r.returns},
                       {"points_in_crop", r.inside_crop},
                       {"points", r.points},
                       {"sensor_noise_mm", r.sensor_noise_m * 1e3},
                       {"merged_noise_mm", r.merged_noise_m * 1e3},
                       {"frame_spacing_mm", r.frame_spacing_m * 1e3},
                       {"objects", objects},
                       {"parameters", choices},
                       {"options", given},
                       {"seconds", stages},
                       {"seconds_total", total},
                       {"threads", thread_count()},
                       {"peak_memory_mb", peak_memory_bytes() / 1048576.0},
                       {"notes", r.notes}};
  return report.dump(2) + "\n";
}

}  // namespace turnscan
