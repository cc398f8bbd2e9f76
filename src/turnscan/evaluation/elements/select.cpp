#include <turnscan/evaluation/elements/select.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <turnscan/evaluation/inspection/deviations.hpp>
#include <turnscan/evaluation/inspection/section.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

namespace turnscan::elements {

namespace {

/// Points where the surface turns away, such as the end of a cylinder, are not of the element.
bool belongs(const Sample& s, const Shape& shape, const ElementRequest& request) {
  constexpr double kCosine = 0.70710678118654752;  // 45 deg, as for artefacts
  return std::abs(distance(shape, s.point)) <= request.within_m &&
         (s.point.array() >= request.low_m.array()).all() &&
         (s.point.array() <= request.high_m.array()).all() &&
         std::abs(gradient(shape, s.point).head<3>().dot(s.normal)) >= kCosine;
}

std::vector<Sample> selected(const std::vector<Sample>& samples, const Shape& shape,
                             const ElementRequest& request) {
  std::vector<Sample> out;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(out),
               [&](const Sample& s) { return belongs(s, shape, request); });
  return out;
}

bool same(const std::vector<Sample>& a, const std::vector<Sample>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Sample& x, const Sample& y) { return x.point == y.point; });
}

void add_contour(const Contour& contour, const Vec3d& normal, std::vector<Sample>& out) {
  const std::size_t n = contour.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i == 0 && !contour.closed, last = i + 1 == n && !contour.closed;
    const Vec3d& p = contour.points[i];
    const Vec3d before = first ? Vec3d::Zero() : Vec3d(p - contour.points[(i + n - 1) % n]);
    const Vec3d after = last ? Vec3d::Zero() : Vec3d(contour.points[(i + 1) % n] - p);
    out.push_back(
        {p, (before + after).normalized().cross(normal), 0.5 * (before.norm() + after.norm())});
  }
}

}  // namespace

Result<Surface> Surface::of(const TriangleMesh& mesh) {
  TURNSCAN_TRY(validate_mesh(mesh));
  Surface out(mesh);
  const std::vector<Vec3f> normals = vertex_normals(mesh);
  const std::vector<float> shares = surface_shares(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (shares[i] > 0.0f)
      out.vertices_.push_back(
          {mesh.vertices[i].cast<double>(), normals[i].cast<double>(), double(shares[i])});
  return out;
}

Result<std::vector<Sample>> Surface::samples_of_section(const Shape& nominal) const {
  const Vec3d& normal = nominal.section_normal;
  TURNSCAN_ASSIGN(const Section section,
                  cross_section(*mesh_, {normal, normal.dot(nominal.point)}));
  std::vector<Sample> out;
  for (const Contour& contour : section.contours) add_contour(contour, normal, out);
  return out;
}

Result<Surface::Fitted> Surface::fit(const ElementRequest& request,
                                     const RunContext& context) const {
  constexpr int kRounds = 10;
  std::vector<Sample> in_section;
  if (is_section(request.nominal.kind)) {
    TURNSCAN_ASSIGN(in_section, samples_of_section(request.nominal));
  }
  const std::vector<Sample>& all = is_section(request.nominal.kind) ? in_section : vertices_;
  Shape shape = request.nominal;
  std::vector<Sample> taken;
  for (int round = 0; round < kRounds; ++round) {
    TURNSCAN_TRY(context.check());
    std::vector<Sample> next = selected(all, shape, request);
    if (round > 0 && same(next, taken)) break;
    taken = std::move(next);
    const auto fitted = fit_shape(taken, shape);
    if (!fitted)
      return fail(ErrorCode::kTooFewPoints,
                  "element '{}': the {} points within {:g} mm do not determine a {}; check its "
                  "nominal place and size, or take more of the surface",
                  request.name, taken.size(), request.within_m * 1e3,
                  name_of(request.nominal.kind));
    shape = *fitted;
  }
  return Fitted{judged_fit(taken, shape), taken.size()};
}

}  // namespace turnscan::elements
