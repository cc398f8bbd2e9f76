#include <turnscan/workflow/simulation/coverage_file.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/io/file/atomic_file.hpp>

#include <turnscan/core/angles.hpp>
#include <turnscan/workflow/simulation/ply_row.hpp>
#include <turnscan/workflow/simulation/reason_list.hpp>
#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {

namespace {

constexpr double kHoleToMention = 1e-3;  // share of the total area

constexpr std::string_view kCoverageHeader =
    "ply\nformat binary_little_endian 1.0\ncomment coverage by a virtual scan; metres\n"
    "comment state: 0 covered, 1 thin, 2 missed, 3 unreachable\n"
    "comment reason: {}\n"
    "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face {}\nproperty list uchar int vertex_indices\n"
    "property uint samples\nproperty float density_per_mm2\nproperty float best_incidence_deg\n"
    "property uint views\nproperty float sigma_mm\nproperty uchar state\nproperty uchar reason\n"
    "property uint object\nproperty uint face\nend_header\n";

Result<> write_vertices(const TriangleMesh& mesh, FileSink& sink) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3f& p = mesh.vertices[v];
    const Rgb& c = mesh.colors[v];
    TURNSCAN_TRY(sink.write(workflow::PlyRow(p.x(), p.y(), p.z(), c.r, c.g, c.b).bytes()));
  }
  return {};
}

Result<> write_faces(const CoverageMap& map, const TriangleMesh& mesh, FileSink& sink) {
  for (std::size_t p = 0; p < map.patches.size(); ++p) {
    const CoveragePatch& patch = map.patches[p];
    const CoverageCell& cell = map.cells[patch.cell];
    const auto& t = mesh.triangles[p];
    TURNSCAN_TRY(
        sink.write(workflow::PlyRow(std::uint8_t(3), t[0], t[1], t[2], patch.samples,
                                    float(cell.density_per_mm2()),
                                    float(cell.best_incidence_rad / kRadiansPerDegree), cell.views,
                                    float(1e3 * cell.best_sigma_m), std::uint8_t(cell.state),
                                    std::uint8_t(cell.reason), patch.object, patch.face)
                       .bytes()));
  }
  return {};
}

nlohmann::json vector_json(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::json hole_json(const CoverageHole& hole) {
  return {{"area_m2", hole.area_m2},
          {"center_m", vector_json(hole.center)},
          {"size_m", vector_json(hole.size_m)},
          {"reason", name_of(hole.reason)},
          {"unreachable_m2", hole.unreachable_m2}};
}

std::string mm(double metres) { return fmt::format("{:.0f}", 1e3 * metres); }

std::string hole_sentence(const CoverageHole& hole) {
  const Vec3d &c = hole.center, &s = hole.size_m;
  const bool mostly_unreachable = 2.0 * hole.unreachable_m2 > hole.area_m2;
  return fmt::format("  {:8.1f} cm2 at ({}, {}, {}) mm, {} x {} x {} mm: {}{}\n",
                     1e4 * hole.area_m2, mm(c.x()), mm(c.y()), mm(c.z()), mm(s.x()), mm(s.y()),
                     mm(s.z()), name_of(hole.reason), mostly_unreachable ? ", unreachable" : "");
}

}  // namespace

Result<CoverageMap> coverage_of(const VirtualPasses& scan, const std::vector<PlacedObject>& placed,
                                const VirtualScanOptions& options, CoverageMapOptions coverage,
                                const RunContext& context) {
  std::vector<ScannerModel> scanners;
  for (const VirtualScanner& scanner : options.scanners) scanners.push_back(scanner.model);
  const auto T_table_object = [&](std::size_t k) {
    return scan.pass(k).T_table_given() * placed.at(k).T_table_object;
  };
  std::vector<CoveragePass> further;
  for (std::size_t k = 1; k < scan.count(); ++k)
    further.push_back({&scan.pass(k).scene(), T_table_object(0) * T_table_object(k).inverse()});
  std::vector<CoveragePose> poses;
  for (const std::size_t i : usable_frames(scan)) {
    const auto [k, there] = scan.place_of(i);
    poses.push_back({scan.frames()[i].sensor, scan.pass(k).T_table_sensor(there),
                     scan.pass(k).T_table_world(there), static_cast<std::uint32_t>(k)});
  }
  coverage.noise = options.measure.noise == "model" || options.measure.noise == "physics";
  const VirtualScan& first = scan.pass(0);
  return coverage_map(first.scene(), first.objects(), scanners, poses, coverage, context,
                      first.room(), further);
}

Result<> write_coverage_mesh(const std::filesystem::path& path, const CoverageMap& map,
                             const CoverageMapOptions& options) {
  const TriangleMesh mesh = coverage_mesh(map, options);
  return write_file_atomically(path, [&](FileSink& sink) -> Result<> {
    TURNSCAN_TRY(sink.write(std::string_view(fmt::format(
        kCoverageHeader, workflow::reason_list(), mesh.vertices.size(), mesh.triangles.size()))));
    TURNSCAN_TRY(write_vertices(mesh, sink));
    return write_faces(map, mesh, sink);
  });
}

std::string coverage_json(const CoverageMap& map, const CoverageMapOptions& options) {
  nlohmann::json areas, reasons, holes = nlohmann::json::array();
  for (std::size_t s = 0; s < kCoverageStateCount; ++s)
    areas[std::string(name_of(static_cast<CoverageState>(s)))] = map.state_m2[s];
  for (std::size_t m = 1; m < map.reason_m2.size(); ++m)
    if (map.reason_m2[m] > 0.0)
      reasons[std::string(name_of(static_cast<Miss>(m)))] = map.reason_m2[m];
  for (const CoverageHole& hole : map.holes) holes.push_back(hole_json(hole));
  const nlohmann::json out = {{"area_m2", map.area_m2},
                              {"covered", map.covered()},
                              {"covered_of_reachable", map.covered_of_reachable()},
                              {"samples", map.samples},
                              {"cell_m", map.cell_m},
                              {"thin_per_mm2", options.thin_per_mm2},
                              {"state_m2", areas},
                              {"reason_m2", reasons},
                              {"hole_count", map.hole_count},
                              {"holes", holes}};
  return out.dump(2) + "\n";
}

std::string coverage_text(const CoverageMap& map, const CoverageMapOptions& options) {
  const auto percent = [&](CoverageState state) {
    return 100.0 * map.state_m2[static_cast<std::size_t>(state)] / map.area_m2;
  };
  std::string out = fmt::format(
      "Covered: {:.1f} % of the surface ({:.1f} % of what can be reached); {:.1f} % with less than "
      "{} samples/mm2\nMissed: {:.1f} %; unreachable at this height: {:.1f} %\n",
      100.0 * map.covered(), 100.0 * map.covered_of_reachable(), percent(CoverageState::kThin),
      options.thin_per_mm2, percent(CoverageState::kMissed), percent(CoverageState::kUnreachable));
  workflow::TextTable table({0});
  for (std::size_t m = 1; m < map.reason_m2.size(); ++m)
    if (map.reason_m2[m] >= 0.0005 * map.area_m2)
      table.add({std::string(name_of(static_cast<Miss>(m))),
                 fmt::format("{:.1f} %", 100.0 * map.reason_m2[m] / map.area_m2)});
  if (!table.empty()) out += "Without a sample, by reason:\n" + table.text(2);
  std::string holes;
  for (const CoverageHole& hole : map.holes)
    if (hole.area_m2 >= kHoleToMention * map.area_m2) holes += hole_sentence(hole);
  if (!holes.empty()) out += "Largest holes:\n" + holes;
  return out;
}

}  // namespace turnscan
