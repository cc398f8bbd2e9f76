#include <cmath>
#include <turnscan/simulator/rendering/picture.hpp>
#include <turnscan/workflow/next_pass/next_pass_picture.hpp>

namespace turnscan {

namespace {

constexpr Rgb kSeen{204, 196, 184}, kUnseen{255, 0, 144};
constexpr int kSide = 640;

/// Triangles with individual colours.
TriangleMesh painted(const ObjectResult& object, const Pose& T_table_mesh) {
  TriangleMesh out;
  const TriangleMesh& mesh = object.mesh;
  out.vertices.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Evidence evidence = object.evidence[i];
    const bool unseen = evidence == Evidence::kInvented || evidence == Evidence::kBase;
    const auto first = std::uint32_t(out.vertices.size());
    for (const std::uint32_t v : mesh.triangles[i]) {
      out.vertices.push_back((T_table_mesh * mesh.vertices[v].cast<double>()).cast<float>());
      out.colors.push_back(unseen ? kUnseen : kSeen);
    }
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

}  // namespace

Result<ColorImage> next_pass_picture(const ObjectResult& object, const PassViews& pass,
                                     const NextPassAdvice& advice, const RunContext& context) {
  const CoverageView& first = pass.views.front();
  const Viewpoint viewpoint = first.viewpoint.transformed(first.T_table_sensor);
  PictureOptions options;
  options.width = options.height = kSide;
  options.smooth = false;
  options.azimuth_rad = std::atan2(viewpoint.value.x(), viewpoint.value.z());
  std::vector<Pose> poses{pass.T_mesh_table.inverse()};
  if (!advice.poses.empty()) poses.push_back(advice.poses.front().T_table_mesh);
  std::vector<ColorImage> pictures;
  for (const Pose& pose : poses) {
    const TriangleMesh mesh = painted(object, pose);
    TURNSCAN_ASSIGN(ColorImage picture, render_picture(std::span(&mesh, 1), options, context));
    pictures.push_back(std::move(picture));
  }
  return side_by_side(pictures);
}

}  // namespace turnscan
