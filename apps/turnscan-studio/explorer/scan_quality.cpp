#include "explorer/scan_quality.hpp"

#include <QObject>
#include <algorithm>
#include <cmath>
#include <turnscan/evaluation/colormap.hpp>
#include <turnscan/workflow/page/page_fields.hpp>

#include "explorer/looking/texture_views.hpp"

namespace turnscan::studio {

namespace {

constexpr Rgb kNotKnown{150, 150, 150};
constexpr Rgb kMeasured{0, 114, 178}, kInvented{230, 159, 0};  // blue and orange of Okabe and Ito
constexpr int kSteps = 4;
const QString kViewWay = "texture-view";

QColor to_qcolor(const Rgb& c) { return {c.r, c.g, c.b}; }

Rgb color_of_value(const page::Field& field, float value) {
  if (!std::isfinite(value)) return kNotKnown;
  if (!field.classes.empty()) return value > 0.5f ? kInvented : kMeasured;
  return viridis((double(value) - field.from) / (field.to - field.from));
}

Legend legend_of(const page::Field& field) {
  Legend legend;
  legend.title = QString::fromStdString(field.label);
  if (!field.classes.empty()) {
    for (std::size_t i = 0; i < field.classes.size(); ++i)
      legend.entries.push_back(
          {to_qcolor(i == 0 ? kMeasured : kInvented), QString::fromStdString(field.classes[i])});
    return legend;
  }
  legend.continuous = true;
  for (int i = 0; i <= kSteps; ++i) {
    const double share = double(i) / kSteps;
    legend.entries.push_back({to_qcolor(viridis(share)),
                              QString("%1 %2%3")
                                  .arg(field.from + share * (field.to - field.from), 0, 'g', 3)
                                  .arg(QString::fromStdString(field.unit),
                                       i == kSteps ? QObject::tr(" and more") : QString())});
  }
  return legend;
}

}  // namespace

std::vector<ColorWay> color_ways(const ScanQuality& quality) {
  std::vector<ColorWay> out;
  const PageObject& object = quality.page->objects.at(quality.object);
  for (const page::Field& field : page::fields_of(quality.page->objects)) {
    if (!field.values(object).empty())
      out.push_back({QString::fromStdString(field.id), QString::fromStdString(field.label)});
  }
  if (quality.texture && !quality.texture->view_of_square.empty())
    out.push_back({kViewWay, QObject::tr("View of each place")});
  return out;
}

ColoredMesh color_mesh(const ScanQuality& quality, const QString& way) {
  const PageObject& object = quality.page->objects.at(quality.object);
  if (way == kViewWay && quality.texture) return color_by_view(object.mesh, *quality.texture);
  const auto fields = page::fields_of(quality.page->objects);
  const auto field = std::find_if(fields.begin(), fields.end(),
                                  [&](const page::Field& f) { return f.id == way.toStdString(); });
  if (field == fields.end()) return {};
  const std::vector<float> values = field->values(object);
  TriangleMesh mesh = object.mesh;
  mesh.texture.reset();
  mesh.colors.resize(values.size());
  for (std::size_t v = 0; v < values.size(); ++v)
    mesh.colors[v] = color_of_value(*field, values[v]);
  return {make_drawable(mesh), legend_of(*field)};
}

QString sign_of(Level level) {
  switch (level) {
    case Level::kGood:
      return QString::fromUtf8("●");
    case Level::kFair:
      return QString::fromUtf8("▲");
    case Level::kBad:
      break;
  }
  return QString::fromUtf8("■");
}

QColor color_of(Level level) {
  switch (level) {
    case Level::kGood:
      return {0, 158, 115};
    case Level::kFair:
      return {230, 159, 0};
    case Level::kBad:
      break;
  }
  return {213, 94, 0};
}

}  // namespace turnscan::studio
