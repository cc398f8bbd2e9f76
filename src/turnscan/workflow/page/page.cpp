#include <turnscan/workflow/page/page.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/pseudo_normals.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/workflow/page/encoding.hpp>
#include <turnscan/workflow/page/page_model.hpp>
#include <turnscan/workflow/page/page_sections.hpp>
#include <turnscan/workflow/page/page_style.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

constexpr const char* kNoViewer =
    "<p>The model in 3D is not in this page: the turnscan that wrote it was built without its "
    "viewer (scripts/setup page). The pictures show the model from six sides.</p>\n";

/// The bundle of web/, installed with the program's other data; empty if it was not built.
std::string viewer_script() {
  const auto data = data_folder();
  if (!data) return "";
  const fs::path file = *data / "page" / "viewer.js";
  std::error_code error;
  if (!fs::exists(file, error)) return "";
  return read_file(file).value_or("");
}

std::string content_policy(const std::string& script) {
  std::string policy = "default-src 'none'; img-src data:; base-uri 'none'; form-action 'none'; ";
  policy += fmt::format("style-src '{}'", page::csp_hash(page::style()));
  // The decoder of the model's streams is WebAssembly.
  if (!script.empty())
    policy += fmt::format("; script-src '{}' 'wasm-unsafe-eval'", page::csp_hash(script));
  return policy;
}

Result<> check_input(const PageInput& input) {
  if (input.objects.empty())
    return fail(ErrorCode::kTooFewPoints, "page: there is no object to show; check the mesh");
  for (const PageObject& object : input.objects) {
    TURNSCAN_TRY(validate_mesh(object.mesh));
    if (object.mesh.empty())
      return fail(ErrorCode::kTooFewPoints, "page: an object has no triangles; check the mesh");
    const std::size_t n = object.mesh.vertices.size();
    for (const std::size_t size : {object.expected_error_m.size(), object.deviation_m.size(),
                                   object.seen_by.size(), object.invented.size()}) {
      if (size != 0 && size != n)
        return fail(ErrorCode::kFormat,
                    "page: {} values for {} vertices; give the mesh that they are of", size, n);
    }
  }
  return {};
}

/// Uses arrays of the report if the object has none; those of another mesh are ignored.
void take_arrays(const page::ReportedObject& reported, PageObject& object) {
  const auto take = [&](const char* key, auto& out, double most) {
    const auto found = reported.per_vertex.find(key);
    if (!out.empty() || found == reported.per_vertex.end() ||
        found->second.size() != object.mesh.vertices.size())
      return;
    using Value = typename std::decay_t<decltype(out)>::value_type;
    const auto unknown = std::numeric_limits<Value>::quiet_NaN();  // 0 for integers
    for (const double v : found->second)
      out.push_back(std::isfinite(v) ? static_cast<Value>(std::clamp(v, 0.0, most)) : unknown);
  };
  take("expected_error_m", object.expected_error_m, 1e3);
  take("seen_by", object.seen_by, 65534.0);
  take("invented", object.invented, 1.0);
}

std::string head(const PageInput& input, const std::string& script) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"turnscan {}\">\n"
      "<title>{} - turnscan report</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<a class=\"skip\" href=\"#content\">Skip to the report</a>\n<header>\n<h1>{}</h1>\n"
      "<p class=\"soft\">Report of a 3D scan</p>\n</header>\n<main id=\"content\">\n",
      content_policy(script), version(), page::escaped(input.title), page::style(),
      page::escaped(input.title));
}

std::string foot(const page::ReportFacts& facts, const std::string& script) {
  std::string html = "</main>\n<footer class=\"soft\">\n";
  if (!facts.version.empty() && facts.version != version())
    html += fmt::format("<p>Reconstructed by turnscan {}.</p>\n", page::escaped(facts.version));
  html += fmt::format("<p>Written by turnscan {}.", version());
  if (!script.empty())
    html +=
        " The 3D view is made with three.js and meshoptimizer, under the MIT licence, which stands "
        "in this file beside them.";
  return html + "</p>\n</footer>\n";
}

}  // namespace

Result<ReportPage> make_page(const PageInput& given, const RunContext& context) {
  constexpr std::uint64_t kPictures = 6;
  TURNSCAN_ASSIGN(const page::ReportFacts facts, page::facts_of(given.report));
  PageInput input = given;
  for (std::size_t i = 0; i < std::min(input.objects.size(), facts.objects.size()); ++i)
    take_arrays(facts.objects[i], input.objects[i]);
  TURNSCAN_TRY(check_input(input));
  context.begin_phase("page", kPictures);
  const std::string script = viewer_script();
  TURNSCAN_ASSIGN(const std::string pictures, page::pictures_section(input, context));
  TURNSCAN_ASSIGN(const std::string dimensions, page::dimensions_section(input, context));
  ReportPage out;
  out.has_viewer = !script.empty();
  out.html = head(input, script);
  out.html += page::verdict_section(input, facts);
  out.html += out.has_viewer ? page::view_section() : kNoViewer;
  out.html += pictures;
  out.html += dimensions;
  out.html += page::comparison_section(input);
  out.html += page::elements_section(input);
  out.html += page::plots_section(input, facts);
  out.html += page::making_section(facts);
  out.html += foot(facts, script);
  if (out.has_viewer)
    out.html += fmt::format(
        "<script type=\"application/json\" id=\"model-data\">{}</script>\n<script>{}</script>\n",
        page::in_script(page::model_json(input.objects, page::fields_of(input.objects))), script);
  out.html += "</body>\n</html>\n";
  return out;
}

Result<> compare_with(PageInput& input, const TriangleMesh& reference,
                      const EvaluateOptions& options, const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(reference, "reference"));
  TURNSCAN_ASSIGN(const MeshDistance distance, MeshDistance::create(reference, context));
  TURNSCAN_ASSIGN(const PseudoNormals normals, PseudoNormals::create(reference, context));
  for (PageObject& object : input.objects) {
    TURNSCAN_ASSIGN(object.evaluation, evaluate(object.mesh, reference, options, {}, context));
    const Pose& T_reference_mesh = object.evaluation->T_reference_mesh;
    const std::vector<Vec3f>& vertices = object.mesh.vertices;
    object.deviation_m.assign(vertices.size(), std::numeric_limits<float>::quiet_NaN());
    TURNSCAN_TRY(parallel_for(vertices.size(), 1024, context, [&](std::size_t v) {
      const Vec3d p = T_reference_mesh * vertices[v].cast<double>();
      const auto hit = distance.closest(p);
      if (hit.triangle == MeshDistance::kNone) return;
      const double side = (p - hit.point).dot(normals.at(hit.point, hit.triangle));
      object.deviation_m[v] = static_cast<float>(std::copysign(hit.distance, side));
    }));
  }
  return {};
}

}  // namespace turnscan
