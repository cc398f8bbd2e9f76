// Edits that the panel runs on the worker thread.

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QSpinBox>
#include <turnscan/core/mesh_texture.hpp>
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
constexpr double kSmall = 0.05;  // relative to the largest piece

SmallPieces small_pieces_of(const ModelData& data) {
  return data.kind == ModelKind::kMesh
             ? small_pieces(data.mesh, kSmall)
             : small_pieces(data.cloud.points, kSmall, usual_reach(data.cloud.points));
}

}  // namespace

void EditPanel::pick(const ScreenRegion& region, std::optional<SelectHow> keys) {
  const Model* model = target();
  if (!model) return;
  const auto how = keys.value_or(static_cast<SelectHow>(how_->currentIndex()));
  error_->show_text(
      model->visible ? QString() : tr("%1 is hidden: show it in the list first").arg(model->name));
  if (!model->visible) return;
  parts_.jobs.start(
      tr("Select"), this,
      [this, data = model->data, before = selection(), region, how, screen = screen_of(parts_.view),
       visible = !through_->isChecked()](const RunContext& context) -> Result<Finish> {
        context.begin_phase("select", 0);
        TURNSCAN_ASSIGN(
            const Selection picked,
            data->kind == ModelKind::kMesh
                ? select_on_screen(data->mesh, region, screen, visible, context)
                : select_on_screen(data->cloud.points, region, screen, visible, context));
        Selection made = before;
        change_selection(made, picked, how);
        return take_selection(data, std::move(made));
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
       before = selection().empty() ? Selection(parts_of(*model->data), 0)
                                    : selection()](const RunContext& context) -> Result<Finish> {
        context.begin_phase("select", 0);
        return take_selection(data, made(*data, before));
      },
      [this](const QString& text) { error_->show_text(text); });
}

void EditPanel::select_small_pieces() {
  const Model* model = target();
  if (!model) return;
  error_->show_text({});
  parts_.jobs.start(
      tr("Small pieces"), this,
      [this, data = model->data](const RunContext& context) -> Result<Finish> {
        context.begin_phase("select", 0);
        SmallPieces found = small_pieces_of(*data);
        if (found.pieces == 0)
          return fail(ErrorCode::kTooFewPoints, "small pieces: there are none");
        return Finish([this, pieces = int(found.pieces),
                       take = take_selection(data, std::move(found.parts))] {
          take();
          Q_EMIT said(tr("%n small piece(s) selected", nullptr, pieces));
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

Finish EditPanel::take_selection(const ModelDataPtr& of, Selection made) {
  SelectedParts selected{of, nullptr, selection_drawable(*of, made)};
  selected.parts = std::make_shared<const Selection>(std::move(made));
  return [this, selected] {
    const Model* model = target();
    if (!model || model->data != selected.of) return;  // another one has been selected meanwhile
    parts_.store.select_parts(selected, tr("select"));
  };
}

const Selection& EditPanel::selection() const {
  static const Selection nothing;
  const SelectedParts& selected = parts_.store.selected_parts();
  const Model* model = target();
  return selected.parts && model && model->data == selected.of && model->visible ? *selected.parts
                                                                                 : nothing;
}

/// The selection is shown while its model is visible.
void EditPanel::draw_selection() {
  const DrawablePtr wanted = selection().empty() ? nullptr : parts_.store.selected_parts().drawable;
  if (wanted == drawn_) return;
  if (item_ != 0) parts_.view.remove(item_);
  item_ = 0;
  drawn_ = wanted;
  if (!wanted) return;
  ItemStyle style;
  style.color = kSelectedColor;
  style.own_colors = style.in_view = false;
  style.point_scale = 1.6;
  item_ = parts_.view.add(wanted, style);
}

void EditPanel::follow_model() {
  const Model* model = target();
  draw_selection();
  plane_->set_box(model ? box_of(*model->data->drawable) : Box());
  if (!model) parts_.tools.stop();
  if (cut_on_->isChecked()) show_plane(true);
  show_count();
}

/// One undo step; the selection ends with the data that it refers to.
void EditPanel::edit(const QString& what, const Edit& made) {
  const Model* model = target();
  if (!model) return;
  error_->show_text({});
  parts_.jobs.start(
      what, this,
      [this, what, made, model = *model,
       selection = selection()](const RunContext& context) -> Result<Finish> {
        context.begin_phase(what.toStdString(), 0);
        TURNSCAN_ASSIGN(const Edited edited, made(*model.data, selection, context));
        if (parts_of(*edited.data) == 0) {
          return fail(ErrorCode::kTooFewPoints,
                      "{}: nothing would be left of '{}'; delete it instead", what.toStdString(),
                      model.name.toStdString());
        }
        const bool loses_texture = has_texture(model.data->mesh) && !has_texture(edited.data->mesh);
        return Finish([this, what, id = model.id, edited, loses_texture] {
          parts_.store.set_data(id, edited.data, what.toLower());
          const QString text = loses_texture
                                   ? tr("%1; its texture does not fit any more").arg(edited.text)
                                   : edited.text;
          Q_EMIT said(QString("%1: %2").arg(what, text));
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
           // Usually debris behind the selection that is not visible from here.
           const auto before = small_pieces(from.mesh, kSmall).pieces;
           const auto after = small_pieces(rest, kSmall).pieces;
           const QString left = after > before ? tr("; %n small piece(s) left, see Small pieces",
                                                    nullptr, int(after - before))
                                               : QString();
           return Edited{mesh_model(std::move(rest), from.source), text + left};
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
