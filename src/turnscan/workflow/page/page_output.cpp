#include <turnscan/workflow/page/page_output.hpp>

#include <filesystem>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/workflow/output_file.hpp>

namespace turnscan {

namespace {

/// 1 if no triangle at a vertex was measured.
std::vector<std::uint8_t> invented_vertices(const ObjectResult& object) {
  if (object.evidence.size() != object.mesh.triangles.size()) return {};
  std::vector<std::uint8_t> invented(object.mesh.vertices.size(), 1);
  for (std::size_t t = 0; t < object.evidence.size(); ++t) {
    const Evidence e = object.evidence[t];
    if (e == Evidence::kInvented || e == Evidence::kBase) continue;
    for (const std::uint32_t v : object.mesh.triangles[t]) invented[v] = 0;
  }
  return invented;
}

}  // namespace

std::vector<PageObject> page_objects(const Reconstruction& reconstruction) {
  std::vector<PageObject> objects;
  for (const ObjectResult& object : reconstruction.objects) {
    PageObject shown;
    shown.mesh = object.mesh;
    shown.invented = invented_vertices(object);
    for (const VertexQuality& quality : object.quality) {
      shown.expected_error_m.push_back(quality.expected_error_m);
      shown.seen_by.push_back(quality.frames);
    }
    objects.push_back(std::move(shown));
  }
  return objects;
}

std::string page_title(const std::string& path) {
  return std::filesystem::path(path).stem().string();
}

Result<ReportFiles> sort_report_files(const std::vector<std::string>& names) {
  ReportFiles files;
  for (const std::string& name : names) {
    const std::string ending = ending_of(name);
    const bool is_page = ending == ".html" || ending == ".htm";
    std::string& place = is_page ? files.page : files.json;
    if (!place.empty())
      return fail(ErrorCode::kInvalidOption,
                  "--report: {} and {} are both {}; give one .json and one .html at most", place,
                  name, is_page ? "pages" : "JSON files");
    place = name;
  }
  return files;
}

Result<> check_report_files(const ReportFiles& files) {
  TURNSCAN_TRY(check_output_file(files.json, ".json"));
  return check_output_file(files.page, ending_of(files.page) == ".htm" ? ".htm" : ".html");
}

Result<ReportPage> write_page(const std::string& path, const PageInput& input,
                              const RunContext& context) {
  TURNSCAN_ASSIGN(ReportPage page, make_page(input, context));
  TURNSCAN_TRY(write_file_atomically(path, page.html));
  return page;
}

}  // namespace turnscan
