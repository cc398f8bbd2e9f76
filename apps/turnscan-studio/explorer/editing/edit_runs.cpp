// What the panel of edits starts on the worker's thread.

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QSpinBox>
#include <turnscan/geometry/mesh/clip.hpp>
#include <turnscan/geometry/mesh/edit_selected.hpp>

#include "app/jobs.hpp"
#include "explorer/editing/edit_panel.hpp"
#include "explorer/editing/edits.hpp"
#include "explorer/editing/selection_tool.hpp"
#include "explorer/inspection/plane_box.hpp"
#include "explorer/inspection/tool_buttons.hpp"
#include "explorer/loading.hpp"
#include "explorer/model_list.hpp"
#include "view/scene_view.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

namespace {

const QColor kSelectedColor(0xff8a00);

std::size_t parts_of(const ModelData& data) {
  return data.kind == ModelKind::kMesh ? data.mesh.triangles.size() : data.cloud.size();
}

/// Of a mesh a little off it on both sides, so that it covers it.
DrawablePtr selection_drawable(const ModelData& data, const Selection& selection) {
  if (count_selected(selection) == 0) return nullptr;
  if (data.kind == ModelKind::kCloud) {
    PointCloud part;
    for (std::size_t i = 0; i < selection.size(); ++i)
      if (selection[i] != 0) part.points.push_back(data.cloud.points[i]);
    return make_drawable(part);
  }
  const TriangleMesh& mesh = data.mesh;
  const auto off = float(0.0006 * bounds(mesh.vertices).size().norm());
  TriangleMesh part;
  for (std::size_t t = 0; t < selection.size(); ++t) {
    if (selection[t] == 0) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3f normal = (mesh.vertices[b] - mesh.vertices[a])
                             .cross(mesh.vertices[c] - mesh.vertices[a])
                             .normalized();
    for (const float side : {off, -off}) {
      const auto first = std::uint32_t(part.vertices.size());
      for (const std::uint32_t v : {a, b, c}) {
        part.vertices.push_back(mesh.vertices[v] + side * normal);
        part.normals.push_back(normal);
      }
      part.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return make_drawable(part);
}

}  // namespace

void EditPanel::pick(const ScreenRegion& region, std::optional<SelectHow> keys) {
  const Model* model = target();
  if (!model) return;
  const auto how = keys.value_or(static_cast<SelectHow>(how_->currentIndex()));
  error_->show_text({});
  parts_.jobs.start(
      tr("Select"), this,
      [this, data = model->data, before = of_ == model->data ? selection_ : Selection(), region,
       how, screen = screen_of(parts_.view),
       visible = !through_->isChecked()](const RunContext& context) -> Result<Finish> {
        context.begin_phase("select", 0);
        TURNSCAN_ASSIGN(
            const Selection picked,
            data->kind == ModelKind::kMesh
                ? select_on_screen(data->mesh, region, screen, visible, context)
                : select_on_screen(data->cloud.points, region, screen, visible, context));
        Selection made = before;
        change_selection(made, picked, how);
        return Finish([this, data, made, shown = selection_drawable(*data, made)] {
          take_selection(data, made, shown);
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

void EditPanel::change(const QString& what, const Change& made) {
  const Model* model = target();
  if (!model) return;
  error_->show_text({});
  parts_.jobs.start(
      what, this,
      [this, data = model->data, made,
       before = of_ == model->data ? selection_ : Selection(parts_of(*model->data), 0)](
          const RunContext& context) -> Result<Finish> {
        context.begin_phase("select", 0);
        const Selection now = made(*data, before);
        return Finish([this, data, now, shown = selection_drawable(*data, now)] {
          take_selection(data, now, shown);
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

void EditPanel::take_selection(const ModelDataPtr& of, Selection made, DrawablePtr drawable) {
  const Model* model = target();
  if (!model || model->data != of) return;  // another one is selected by now
  clear_selection();
  of_ = of;
  selection_ = std::move(made);
  if (drawable) {
    ItemStyle style;
    style.color = kSelectedColor;
    style.own_colors = style.in_view = false;
    style.point_scale = 1.6;
    item_ = parts_.view.add(drawable, style);
  }
  show_count();
}

void EditPanel::clear_selection() {
  if (item_ != 0) parts_.view.remove(item_);
  item_ = 0;
  of_.reset();
  selection_.clear();
}

void EditPanel::follow_model() {
  const Model* model = target();
  if (of_ && (!model || model->data != of_ || !model->visible)) clear_selection();
  plane_->set_box(model ? box_of(*model->data->drawable) : Box());
  if (!model) parts_.tools.stop();
  if (cut_on_->isChecked()) show_plane(true);
  show_count();
}

/// One step of undo; the selection ends with the data that it belongs to.
void EditPanel::edit(const QString& what, const Edit& made) {
  const Model* model = target();
  if (!model) return;
  error_->show_text({});
  parts_.jobs.start(
      what, this,
      [this, what, made, model = *model, selection = of_ == model->data ? selection_ : Selection()](
          const RunContext& context) -> Result<Finish> {
        context.begin_phase(what.toStdString(), 0);
        TURNSCAN_ASSIGN(const Edited edited, made(*model.data, selection, context));
        if (parts_of(*edited.data) == 0) {
          return fail(ErrorCode::kTooFewPoints,
                      "{}: nothing would be left of '{}'; delete it instead", what.toStdString(),
                      model.name.toStdString());
        }
        return Finish([this, what, id = model.id, edited] {
          parts_.store.set_data(id, edited.data, what.toLower());
          Q_EMIT said(QString("%1: %2").arg(what, edited.text));
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

bool EditPanel::delete_selected() {
  if (selected() == 0) return false;
  edit(tr("Delete selected"),
       [](const ModelData& from, const Selection& selection, const RunContext&) -> Result<Edited> {
         const QString text =
             tr("%1 of %2").arg(grouped(count_selected(selection)), grouped(selection.size()));
         if (from.kind == ModelKind::kMesh) {
           TURNSCAN_ASSIGN(TriangleMesh rest, without_selected(from.mesh, selection));
           return Edited{mesh_model(std::move(rest), from.source), text};
         }
         return Edited{
             cloud_model(points_where(from.cloud, [&](std::size_t i) { return selection[i] == 0; }),
                         from.source, {}, from.viewpoints),
             text};
       });
  return true;
}

void EditPanel::fill_holes_beside() {
  edit(tr("Fill holes"),
       [](const ModelData& from, const Selection& selection,
          const RunContext& context) -> Result<Edited> {
         const bool some = count_selected(selection) > 0;
         TURNSCAN_ASSIGN(HolesFilled made,
                         fill_selected_holes(from.mesh, some ? selection : Selection(), context));
         if (made.holes == 0) {
           return fail(ErrorCode::kTooFewPoints, "fill holes: {}",
                       some ? "there is none beside the selection; grow it, or select nothing"
                            : "the mesh has none");
         }
         const QString text = tr("%1 closed").arg(made.holes);
         return Edited{mesh_model(std::move(made.mesh), from.source), text};
       });
}

void EditPanel::smooth() {
  edit(tr("Smooth"),
       [wavelength = 1e-3 * wavelength_->value()](const ModelData& from, const Selection& selection,
                                                  const RunContext& context) -> Result<Edited> {
         const bool some = count_selected(selection) > 0;
         TURNSCAN_ASSIGN(
             TriangleMesh made,
             smooth_selected(from.mesh, some ? selection : Selection(), wavelength, context));
         const QString text = tr("waves below %1 mm").arg(1e3 * wavelength);
         return Edited{mesh_model(std::move(made), from.source), text};
       });
}

void EditPanel::reduce() {
  edit(tr("Reduce"),
       [goal = std::size_t(triangles_->value())](const ModelData& from, const Selection& selection,
                                                 const RunContext&) -> Result<Edited> {
         const bool some = count_selected(selection) > 0;
         TURNSCAN_ASSIGN(TriangleMesh made,
                         reduce_selected(from.mesh, some ? selection : Selection(), goal));
         const QString text =
             tr("%1 triangles, before %2")
                 .arg(grouped(made.triangles.size()), grouped(from.mesh.triangles.size()));
         return Edited{mesh_model(std::move(made), from.source), text};
       });
}

void EditPanel::cut() {
  const auto [normal, offset] = plane_->plane();
  cut_on_->setChecked(false);
  edit(tr("Cut"),
       [normal = normal, offset = offset](const ModelData& from, const Selection&,
                                          const RunContext&) -> Result<Edited> {
         if (from.kind == ModelKind::kCloud)
           return Edited{cloud_model(turnscan::studio::cut(from.cloud, normal, offset), from.source,
                                     {}, from.viewpoints),
                         tr("one side of the plane is left")};
         TURNSCAN_ASSIGN(ClippedMesh made, clip(from.mesh, {normal, offset}));
         const QString text =
             made.cut_area_m2 > 0.0
                 ? tr("closed by a face of %1 cm²").arg(1e4 * made.cut_area_m2, 0, 'f', 2)
                 : tr("the cut is open, as the mesh was not closed");
         made.mesh.texture = nullptr;
         return Edited{mesh_model(std::move(made.mesh), from.source), text};
       });
}

}  // namespace turnscan::studio
