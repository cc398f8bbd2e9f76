#include "explorer/explorer.hpp"

#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>
#include <QVBoxLayout>
#include <algorithm>

#include "app/paths.hpp"
#include "explorer/compare_panel.hpp"
#include "explorer/editing/edit_panel.hpp"
#include "explorer/editing/history_panel.hpp"
#include "explorer/inspection/deviation_panel.hpp"
#include "explorer/inspection/explorer_parts.hpp"
#include "explorer/inspection/measure_panel.hpp"
#include "explorer/inspection/section_panel.hpp"
#include "explorer/inspection/tool_buttons.hpp"
#include "explorer/loading.hpp"
#include "explorer/looking/frame_panel.hpp"
#include "explorer/looking/look_panel.hpp"
#include "explorer/looking/voxel_panel.hpp"
#include "explorer/model_list.hpp"
#include "explorer/passes/join_panel.hpp"
#include "explorer/session.hpp"
#include "explorer/side_panel.hpp"
#include "explorer/stage_panel.hpp"
#include "explorer/verdict_panel.hpp"
#include "view/scene_view.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

const QColor kMissingColor(0xff0090);

Legend missing_legend() {
  Legend legend;
  legend.title = QObject::tr("Not measured");
  legend.entries = {{kMissingColor, QObject::tr("no view saw it")}};
  return legend;
}

Section* section_with(QWidget* content, const QString& title, bool open, QWidget* parent) {
  auto* section = new Section(title, open, parent);
  section->body()->addWidget(content);
  return section;
}

}  // namespace

ExplorerMode::ExplorerMode(const Services& services, QWidget* parent)
    : Mode(services, parent),
      store_(new ModelStore(this)),
      list_(new ModelList(*store_, this)),
      stages_(new StagePanel(this)),
      compare_(new ComparePanel(*store_, this)),
      tools_(new ToolButtons(view(), this)),
      side_(new SidePanel(this)),
      verdict_(new VerdictPanel(this)),
      look_(new LookPanel(view(), *store_, this)),
      voxels_(new VoxelPanel(*store_, this)),
      frames_(new FramePanel(this)),
      frames_section_(section_with(frames_, tr("Frames"), true, this)),
      voxels_section_(section_with(voxels_, tr("Voxels"), true, this)),
      verdict_section_(section_with(verdict_, tr("Verdict"), true, this)),
      side_section_(section_with(side_, tr("Another side"), true, this)),
      session_(new SessionKeeper(*store_, SessionKeeper::default_root(), this)),
      ask_unit_([this](const DoubtfulUnit& doubt) { return ask_unit(doubt, this); }) {
  const ExplorerParts parts{*store_, *list_, view(), jobs(), *tools_};
  deviations_ = new DeviationPanel(parts, this);
  measure_ = new MeasurePanel(
      parts, [this](const Model& model) { return deviations_->distance_of(model); }, this);
  section_ = new SectionPanel(parts, this);
  edits_ = new EditPanel(parts, this);
  join_ = new JoinPanel(
      parts,
      [this]() -> Result<ReconstructOptions> {
        const QString problem = stages_->first_error();
        if (!problem.isEmpty()) return fail(ErrorCode::kInvalidOption, "{}", problem.toStdString());
        return stages_->options();
      },
      this);
  add_sections();
  set_footer({stages_->error(), stages_->notice(), stages_->action()});
  view().set_empty_text(tr("Nothing loaded yet"),
                        tr("Drop meshes, point clouds or recordings here, or begin with a scan."));
  view().set_empty_actions({{tr("Open…"), [this] { open_dialog(); }},
                            {tr("Scan an object"), [this] { Q_EMIT scan_wanted(); }},
                            {tr("Simulate a scan"), [this] { Q_EMIT mode_wanted("simulator"); }}});
  connect_panels();
  on_selection(0);
}

void ExplorerMode::add_sections() {
  set_tree(list_);
  join_section_ = new Section(tr("Join by points"), false, this, Section::kNested);
  join_section_->body()->addWidget(join_);
  side_section_->body()->addWidget(join_section_);
  QVBoxLayout* inspect = add_tab(tr("Inspect"));
  for (Section* each : {frames_section_, voxels_section_, verdict_section_, side_section_,
                        section_with(deviations_, tr("Deviations"), false, this),
                        section_with(measure_, tr("Measure"), false, this),
                        section_with(section_, tr("Section"), false, this),
                        section_with(compare_, tr("Compare"), false, this)})
    inspect->addWidget(each);
  inspect->addStretch();
  QVBoxLayout* edit = add_tab(tr("Edit"));
  edit->addWidget(section_with(edits_, tr("Editing"), true, this));
  edit->addWidget(section_with(new HistoryPanel(*store_, this), tr("History"), true, this), 1);
  QVBoxLayout* look = add_tab(tr("View"));
  view_panel()->layout()->setContentsMargins(4, 6, 4, 12);
  look->addWidget(view_panel());
  look->addSpacing(10);
  look->addWidget(look_);
  look->addStretch();
  QVBoxLayout* process = add_tab(tr("Process"));
  process->addWidget(stages_);
  process->addStretch();
}

void ExplorerMode::connect_panels() {
  connect(store_, &ModelStore::changed, this, &ExplorerMode::sync);
  connect(store_, &ModelStore::changed, this, &Mode::undo_changed);
  for (const auto ends : {&JobRunner::failed, &JobRunner::cancelled})
    connect(&jobs(), ends, this, [this] {
      if (preview_ != 0) show_until_mesh(nullptr);
    });
  connect(session_, &SessionKeeper::failed, this, &Mode::status);
  session_->set_look([this] { return std::pair(view().camera(), list_->selected()); });
  connect(&view(), &SceneView::camera_changed, session_, &SessionKeeper::look_changed);
  connect(list_, &ModelList::selection_changed, session_, &SessionKeeper::look_changed);
  connect(list_, &ModelList::selection_changed, this, &ExplorerMode::on_selection);
  connect(list_, &ModelList::open_wanted, this, &ExplorerMode::open_dialog);
  connect(list_, &ModelList::save_wanted, this, &ExplorerMode::save);
  connect(list_, &ModelList::settings_wanted, this, [this](const MadeWithPtr& made) {
    stages_->use(*made);
    reveal(stages_);
  });
  connect(stages_, &StagePanel::run, this, &ExplorerMode::run_stage);
  connect(stages_, &StagePanel::save_preset, this, &ExplorerMode::save_preset);
  connect(stages_, &StagePanel::filter, this, &ExplorerMode::run_filter);
  connect(compare_, &ComparePanel::changed, this, &ExplorerMode::sync);
  connect(compare_, &ComparePanel::distance_wanted, this, &ExplorerMode::run_comparison);
  // Colours selected in the verdict panel are restored when those of the deviations are removed.
  connect(deviations_, &DeviationPanel::changed, this, &ExplorerMode::color_selected);
  connect(deviations_, &DeviationPanel::said, this, &Mode::status);
  connect(measure_, &MeasurePanel::said, this, &Mode::status);
  connect(section_, &SectionPanel::said, this, &Mode::status);
  connect(edits_, &EditPanel::said, this, &Mode::status);
  connect(join_, &JoinPanel::said, this, &Mode::status);
  connect(join_, &JoinPanel::changed, this, &ExplorerMode::sync);
  connect(side_, &SidePanel::drawn_changed, this, [this] {
    draw_missing();
    draw_colored();
  });
  connect(verdict_, &VerdictPanel::color_way_changed, this, &ExplorerMode::color_selected);
  connect(verdict_, &VerdictPanel::report_wanted, this, &ExplorerMode::report_dialog);
  connect(look_, &LookPanel::isolation_changed, this, &ExplorerMode::sync);
  connect(look_, &LookPanel::stages_wanted, this, &ExplorerMode::show_stages);
  connect(voxels_, &VoxelPanel::changed, this, &ExplorerMode::sync);
  connect(voxels_, &VoxelPanel::threshold_wanted, this, [this](int least) {
    stages_->set_option("voxels", "voxel-min-points", QString::number(least));
    Q_EMIT status(tr("Voxelise keeps voxels with %1 points or more from now on").arg(least));
  });
  connect(look_, &LookPanel::movie_wanted, this, &ExplorerMode::movie_dialog);
  connect(side_, &SidePanel::scan_wanted, this, [this] {
    const Model* model = store_->find(list_->selected());
    if (model && model->data->missing) Q_EMIT another_side_wanted(model->data->missing->side);
  });
}

ExplorerMode::~ExplorerMode() {
  delete session_;  // before the store that it uses
}

void ExplorerMode::shut_down() { stages_->store(); }

bool ExplorerMode::open_file(const QString& path) {
  load(path, {});
  return true;
}

void ExplorerMode::open_dialog() {
  QSettings settings;
  const QStringList files = QFileDialog::getOpenFileNames(
      this, tr("Open meshes, clouds or recordings"), settings.value("files/folder").toString(),
      tr("Meshes, clouds and recordings (*.ply *.pcd *.stl *.obj *.off *.3mf *.glb *.dae *.fbx "
         "recording.json *.bag *.mcap *.db3 *.mkv *.r3d *.sens *.conf *.json);;All files (*)"));
  for (const QString& file : files) {
    settings.setValue("files/folder", QFileInfo(file).absolutePath());
    load(file, {});
  }
}

void ExplorerMode::save() {
  const Model* model = store_->find(list_->selected());
  if (!model) return;
  const bool mesh = model->data->kind == ModelKind::kMesh;
  const QString path = ask_save_path(
      this, tr("Save %1").arg(model->name), model->name + ".ply",
      mesh ? tr("PLY (*.ply);;STL, millimetres (*.stl);;3MF, millimetres (*.3mf);;OBJ (*.obj);;"
                "GLB (*.glb)")
           : tr("PLY (*.ply)"));
  if (path.isEmpty()) return;
  save_as(model->id, path);
}

/// The selected part of a model, if there is one, else the model.
void ExplorerMode::remove_selected() {
  if (!edits_->delete_selected()) store_->remove(list_->selected());
}

void ExplorerMode::sync() {
  for (auto it = shown_.begin(); it != shown_.end();) {
    if (store_->find(it->first)) {
      ++it;
    } else {
      view().remove(it->second.item);
      it = shown_.erase(it);
    }
  }
  const auto [left, right] = side_by_side();
  view().set_split(left && right, left ? left->name : QString(), right ? right->name : QString());
  for (const Model& model : store_->models()) {
    const ItemStyle style = style_of(model);
    Shown& shown = shown_[model.id];
    const DrawablePtr drawable = drawable_of(model);
    if (shown.item == 0) {
      shown.item = view().add(drawable, style);
    } else {
      if (shown.drawable != drawable) view().replace(shown.item, drawable);
      view().set_style(shown.item, style);
    }
    shown.data = model.data;
    shown.drawable = drawable;
  }
  draw_missing();
  draw_colored();
}

std::pair<const Model*, const Model*> ExplorerMode::side_by_side() const {
  if (join_->is_picking()) return {join_->fixed(), join_->moved()};
  if (compare_->way() != ComparePanel::kSideBySide) return {};
  return {store_->find(compare_->reference()), store_->find(compare_->compared())};
}

/// In its own colours, coloured by its deviations, or as cubes.
DrawablePtr ExplorerMode::drawable_of(const Model& model) const {
  for (const DrawablePtr& other : {deviations_->drawable_of(model), voxels_->drawable_of(model)})
    if (other) return other;
  return model.data->drawable;
}

/// The coloured version of the selected mesh replaces it in place.
void ExplorerMode::draw_colored() {
  const Model* model = store_->find(list_->selected());
  const bool wanted =
      model && colored_.drawable && colored_.of == model->data && !deviations_->drawable_of(*model);
  if (wanted) {
    ItemStyle style = style_of(*model);
    style.own_colors = true;
    if (colored_.item == 0) {
      colored_.item = view().add(colored_.drawable, style);
    } else {
      view().set_style(colored_.item, style);
    }
    style.visible = false;
    view().set_style(shown_[model->id].item, style);
  } else if (colored_.item != 0) {
    view().remove(colored_.item);
    colored_ = {};
  }
  const Model* compared = store_->find(legend_model_);
  const bool of_comparison = compared && style_of(*compared).visible;
  const auto deviations = deviations_->legend(), cells = voxels_->legend();
  view().set_legend(wanted && style_of(*model).visible ? colored_.legend
                    : deviations                       ? *deviations
                    : cells                            ? *cells
                    : of_comparison                    ? legend_
                    : missing_.item != 0               ? missing_legend()
                                                       : Legend());
}

void ExplorerMode::report_dialog() {
  const Model* model = store_->find(list_->selected());
  if (!model || !model->data->quality) return;
  const QString path = ask_save_path(this, tr("Export the report of %1").arg(model->name),
                                     model->name + ".html", tr("Report page (*.html)"));
  if (path.isEmpty()) return;
  export_report(model->id, path);
}

ItemStyle ExplorerMode::style_of(const Model& model) const {
  ItemStyle style;
  style.visible = model.visible;
  style.color = model.color;
  style.own_colors = model.own_colors || deviations_->drawable_of(model);
  style.opacity = model.opacity;
  if (join_->is_picking()) {
    const auto [left, right] = side_by_side();
    style.pane = right && model.id == right->id ? 1 : 0;
    style.visible = style.pane == 1 || (left && model.id == left->id);
    return style;
  }
  if (deviations_->hides(model.id) || preview_ != 0) style.visible = false;
  if (look_->isolated() && model.id != list_->selected()) style.visible = false;
  if (compare_->way() == ComparePanel::kOff) return style;
  const bool left = model.id == compare_->reference(), right = model.id == compare_->compared();
  style.visible = left || right;
  style.pane = right && !left ? 1 : 0;
  // A smaller model inside it is visible through it.
  if (compare_->way() == ComparePanel::kOverlay && model.id == compare_->enclosing())
    style.opacity = std::min(style.opacity, 0.35);
  return style;
}

/// Drawn over the selected mesh, while that is visible.
void ExplorerMode::draw_missing() {
  const Model* model = store_->find(list_->selected());
  const bool wanted = model && model->data->missing && model->data->missing->drawable &&
                      side_->drawn() && style_of(*model).visible && verdict_->color_way().isEmpty();
  if (missing_.item != 0 && (!wanted || missing_.data != model->data)) {
    view().remove(missing_.item);
    missing_ = {};
  }
  if (!wanted || missing_.item != 0) return;
  ItemStyle style = style_of(*model);
  style.color = kMissingColor;
  style.boxed = style.in_view = false;
  missing_ = {view().add(model->data->missing->drawable, style), model->data, nullptr};
}

/// Of a recording that is selected. What its meshes were made without is marked.
void ExplorerMode::show_frames(const Model* model) {
  const bool is_recording = model && model->data->kind == ModelKind::kRecording;
  frames_section_->setVisible(is_recording);
  if (!is_recording) return frames_->show_recording(nullptr, {});
  std::set<std::size_t> left_out;
  for (const Model& other : store_->models())
    if (store_->input_of(other) == model)
      left_out.insert(other.data->left_out.begin(), other.data->left_out.end());
  frames_->show_recording(model->data->recording, left_out, list_->selected_pass());
}

void ExplorerMode::on_selection(int id) {
  const Model* model = store_->find(id);
  side_->show_missing(model ? model->data->missing : nullptr);
  verdict_->show_quality(model ? model->data->quality : nullptr);
  look_->show_model(id);
  voxels_->show_model(id);
  voxels_section_->setVisible(voxels_->applies());
  const bool is_mesh = model && model->data->kind == ModelKind::kMesh;
  verdict_section_->setVisible(is_mesh);
  side_section_->setVisible(is_mesh);
  show_frames(model);
  if (look_->isolated()) sync();
  draw_missing();
  if (model && model->data->quality && colored_.of != model->data) {
    color_selected();
  } else {
    draw_colored();
  }
  const auto input = stage_input();
  stages_->set_target(input && input->data->kind != ModelKind::kMesh,
                      model && model->data->kind == ModelKind::kCloud);
  if (model) Q_EMIT described(QString("%1: %2").arg(model->name, count_text(*model->data)));
}

}  // namespace turnscan::studio
