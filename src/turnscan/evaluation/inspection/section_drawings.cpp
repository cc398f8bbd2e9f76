#include <turnscan/evaluation/inspection/section.hpp>

#include <fmt/format.h>

#include <iterator>

namespace turnscan {

namespace {

/// Millimetres along the axes of the drawing.
struct FlatContour {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
};

Result<std::vector<FlatContour>> flatten(const Section& section) {
  if (section.contours.empty()) {
    return fail(ErrorCode::kTooFewPoints,
                "section: the plane does not meet the model; move it before it is drawn");
  }
  const auto [right, up] = drawing_axes(section.normal);
  std::vector<FlatContour> flat;
  for (const Contour& contour : section.contours) {
    FlatContour& out = flat.emplace_back();
    out.closed = contour.closed;
    for (const Vec3d& p : contour.points)
      out.points.emplace_back(1e3 * right.dot(p), 1e3 * up.dot(p));
  }
  return flat;
}

}  // namespace

Result<std::string> section_dxf(const Section& section) {
  TURNSCAN_ASSIGN(const auto contours, flatten(section));
  std::string text =
      "999\nsection of a mesh, millimetres\n0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n"
      "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  const auto out = std::back_inserter(text);
  for (const FlatContour& contour : contours) {
    fmt::format_to(out, "0\nPOLYLINE\n8\n0\n66\n1\n10\n0.0\n20\n0.0\n30\n0.0\n70\n{}\n",
                   contour.closed ? 1 : 0);
    for (const auto& p : contour.points)
      fmt::format_to(out, "0\nVERTEX\n8\n0\n10\n{:.5f}\n20\n{:.5f}\n30\n0.0\n", p.x(), p.y());
    text += "0\nSEQEND\n8\n0\n";
  }
  return text + "0\nENDSEC\n0\nEOF\n";
}

Result<std::string> section_svg(const Section& section) {
  constexpr double kMarginMm = 2.0;
  TURNSCAN_ASSIGN(const auto contours, flatten(section));
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = -low;
  for (const FlatContour& contour : contours)
    for (const auto& p : contour.points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const Eigen::Vector2d size = high - low + Eigen::Vector2d::Constant(2.0 * kMarginMm);
  std::string enclosed, open;
  for (const FlatContour& contour : contours) {
    std::string& path = contour.closed ? enclosed : open;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      const auto& p = contour.points[i];
      // Positive is downwards there.
      fmt::format_to(std::back_inserter(path), "{}{:.4f} {:.4f} ", i == 0 ? "M" : "L",
                     p.x() - low.x() + kMarginMm, high.y() - p.y() + kMarginMm);
    }
    if (contour.closed) path += "Z ";
  }
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.4f}mm\" height=\"{1:.4f}mm\" "
      "viewBox=\"0 0 {0:.4f} {1:.4f}\">\n",
      size.x(), size.y());
  const char* stroke = "stroke=\"#000000\" stroke-width=\"0.1\"";
  if (!enclosed.empty())
    text += fmt::format("<path d=\"{}\" fill=\"#c8c8c8\" fill-rule=\"evenodd\" {}/>\n", enclosed,
                        stroke);
  if (!open.empty()) text += fmt::format("<path d=\"{}\" fill=\"none\" {}/>\n", open, stroke);
  return text + "</svg>\n";
}

}  // namespace turnscan
