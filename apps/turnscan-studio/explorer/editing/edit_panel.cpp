#include "explorer/editing/edit_panel.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include "explorer/editing/selection_tool.hpp"
#include "explorer/inspection/plane_box.hpp"
#include "explorer/inspection/tool_buttons.hpp"
#include "explorer/model_list.hpp"
#include "view/scene_view.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

namespace {

QWidget* grid_box(QGridLayout*& grid, QWidget* parent) {
  auto* box = new QWidget(parent);
  grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  return box;
}

QPushButton* named_button(const QString& name, const QString& text, const QString& tip,
                          QWidget* parent) {
  auto* made = button(text, tip, parent);
  made->setObjectName(name);
  return made;
}

}  // namespace

EditPanel::EditPanel(const ExplorerParts& parts, QWidget* parent) : QWidget(parent), parts_(parts) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(make_tools());
  count_ = quiet_label({}, this);
  count_->setObjectName("selection_count");
  layout->addWidget(count_);
  layout->addWidget(make_changes());
  layout->addWidget(make_edits());
  layout->addWidget(make_cut());
  error_ = new MessageLabel(this);
  layout->addWidget(error_);
  connect(&parts_.list, &ModelList::selection_changed, this, &EditPanel::follow_model);
  connect(&parts_.store, &ModelStore::changed, this, &EditPanel::follow_model);
  follow_model();
}

EditPanel::~EditPanel() = default;

QWidget* EditPanel::make_tools() {
  QGridLayout* grid = nullptr;
  QWidget* box = grid_box(grid, this);
  const std::array<std::array<QString, 3>, 3> texts{{
      {"select_rectangle", tr("Rectangle"), tr("Select what a rectangle on the screen encloses")},
      {"select_lasso", tr("Lasso"), tr("Select what an outline on the screen encloses")},
      {"select_brush", tr("Brush"), tr("Select what is painted over")},
  }};
  for (int i = 0; i < 3; ++i) {
    const auto& [name, text, tip] = texts[std::size_t(i)];
    auto* made = named_button(name, text,
                              tip + tr("; with Shift it is added, with Ctrl subtracted, with Alt "
                                       "the mouse turns the camera"),
                              box);
    grid->addWidget(made, 0, i);
    of_any_.push_back(made);
    add_tool(made, i);
  }
  how_ = new QComboBox(box);
  how_->setObjectName("select_how");
  how_->addItems({tr("Select"), tr("Add"), tr("Subtract")});
  how_->setToolTip(tr("What the tool does with what was selected before"));
  leave_wheel_to_panel(how_);
  through_ = new QCheckBox(tr("Through"), box);
  through_->setObjectName("select_through");
  through_->setToolTip(tr("Select what is hidden behind other parts, too"));
  radius_ = new QSpinBox(box);
  radius_->setObjectName("brush_radius");
  radius_->setRange(2, 200);
  radius_->setValue(12);
  radius_->setPrefix("r ");
  radius_->setSuffix(" px");
  radius_->setToolTip(tr("Radius of the brush on the screen"));
  leave_wheel_to_panel(radius_);
  connect(radius_, qOverload<int>(&QSpinBox::valueChanged), this, [this](int pixels) {
    for (const auto& tool : tools_) tool->set_radius(pixels);
  });
  grid->addWidget(how_, 1, 0);
  grid->addWidget(through_, 1, 1);
  grid->addWidget(radius_, 1, 2);
  return box;
}

void EditPanel::add_tool(QPushButton* button, int shape) {
  tools_.push_back(std::make_unique<SelectionTool>(
      parts_.view, SelectionTool::Shape(shape),
      [this](const ScreenRegion& region, std::optional<SelectHow> how) { pick(region, how); }));
  parts_.tools.add(button, tools_.back().get());
}

QWidget* EditPanel::make_changes() {
  QGridLayout* grid = nullptr;
  QWidget* box = grid_box(grid, this);
  const auto reach = [](const ModelData& of) { return usual_reach(of.cloud.points); };
  const auto add = [&](const QString& name, const QString& text, const QString& tip, int place,
                       const Change& made) {
    auto* each = named_button(name, text, tip, box);
    grid->addWidget(each, place / 3, place % 3);
    connect(each, &QPushButton::clicked, this, [this, text, made] { change(text, made); });
    return each;
  };
  of_any_.push_back(
      add("select_all", tr("All"), tr("Select the whole model"), 0,
          [](const ModelData&, const Selection& s) { return Selection(s.size(), 1); }));
  of_any_.push_back(add("select_invert", tr("Invert"), tr("Select what is not selected"), 1,
                        [](const ModelData&, const Selection& s) { return inverted(s); }));
  of_selection_.push_back(
      add("select_none", tr("Nothing"), tr("Forget the selection"), 2,
          [](const ModelData&, const Selection& s) { return Selection(s.size(), 0); }));
  of_selection_.push_back(
      add("select_grow", tr("Grow"), tr("Add the neighbours of what is selected"), 3,
          [reach](const ModelData& of, const Selection& s) {
            return of.kind == ModelKind::kMesh ? grown(of.mesh, s)
                                               : grown(of.cloud.points, s, reach(of));
          }));
  of_selection_.push_back(
      add("select_shrink", tr("Shrink"), tr("Leave out the rim of the selection"), 4,
          [reach](const ModelData& of, const Selection& s) {
            return of.kind == ModelKind::kMesh ? shrunk(of.mesh, s)
                                               : shrunk(of.cloud.points, s, reach(of));
          }));
  of_selection_.push_back(add(
      "select_connected", tr("Connected"), tr("Add everything that is connected to the selection"),
      5, [reach](const ModelData& of, const Selection& s) {
        return of.kind == ModelKind::kMesh ? connected(of.mesh, s)
                                           : connected(of.cloud.points, s, reach(of));
      }));
  auto* small =
      named_button("select_small", tr("Small pieces"),
                   tr("Select every separate piece below a twentieth of the largest one"), box);
  grid->addWidget(small, 2, 0, 1, 3);
  of_any_.push_back(small);
  connect(small, &QPushButton::clicked, this, &EditPanel::select_small_pieces);
  return box;
}

QWidget* EditPanel::make_edits() {
  QGridLayout* grid = nullptr;
  QWidget* box = grid_box(grid, this);
  auto* remove =
      named_button("edit_delete", tr("Delete selected"), tr("Delete what is selected (Del)"), box);
  auto* fill = named_button("edit_fill", tr("Fill holes"),
                            tr("Close the holes beside the selection; without one, all"), box);
  auto* smoother = named_button(
      "edit_smooth", tr("Smooth"),
      tr("Smooth waves shorter than this in the selection; without one, in the whole mesh"), box);
  auto* fewer = named_button("edit_reduce", tr("Reduce to"),
                             tr("Reduce to this number by merging triangles of the selection; "
                                "without one, of the whole mesh"),
                             box);
  wavelength_ = new QDoubleSpinBox(box);
  wavelength_->setObjectName("smooth_wavelength");
  wavelength_->setDecimals(2);
  wavelength_->setRange(0.01, 1000.0);
  wavelength_->setValue(3.0);
  wavelength_->setSuffix(" mm");
  wavelength_->setToolTip(tr("Waves of this length lose half of their height"));
  triangles_ = new QSpinBox(box);
  triangles_->setObjectName("reduce_triangles");
  triangles_->setRange(4, 2000000000);
  triangles_->setSingleStep(1000);
  triangles_->setValue(10000);
  triangles_->setToolTip(tr("Triangles of the whole mesh afterwards"));
  for (QWidget* each : std::initializer_list<QWidget*>{wavelength_, triangles_})
    leave_wheel_to_panel(each);
  grid->addWidget(remove, 0, 0);
  grid->addWidget(fill, 0, 1);
  grid->addWidget(smoother, 1, 0);
  grid->addWidget(wavelength_, 1, 1);
  grid->addWidget(fewer, 2, 0);
  grid->addWidget(triangles_, 2, 1);
  of_selection_.push_back(remove);
  for (QPushButton* each : {fill, smoother, fewer}) of_mesh_.push_back(each);
  connect(remove, &QPushButton::clicked, this, &EditPanel::delete_selected);
  connect(fill, &QPushButton::clicked, this, &EditPanel::fill_holes_beside);
  connect(smoother, &QPushButton::clicked, this, &EditPanel::smooth);
  connect(fewer, &QPushButton::clicked, this, &EditPanel::reduce);
  return box;
}

QWidget* EditPanel::make_cut() {
  auto* box = new QWidget(this);
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  cut_on_ =
      named_button("cut_on", tr("Flat cut"),
                   tr("Take away one side of a plane; the cut of a closed mesh is closed"), box);
  plane_row_ = new QWidget(box);
  auto* row = new QVBoxLayout(plane_row_);
  row->setContentsMargins(0, 0, 0, 0);
  plane_ = new PlaneBox("cut", PlaneBox::kAbove, plane_row_);
  auto* apply = named_button("plane_cut", tr("Cut off what is not shown"), {}, plane_row_);
  row->addWidget(plane_);
  row->addWidget(apply);
  plane_row_->setVisible(false);
  layout->addWidget(cut_on_);
  layout->addWidget(plane_row_);
  of_any_.push_back(cut_on_);
  parts_.tools.add(cut_on_, nullptr, [this](bool on) { show_plane(on); });
  connect(plane_, &PlaneBox::changed, this, [this] {
    if (cut_on_->isChecked()) show_plane(true);
  });
  connect(apply, &QPushButton::clicked, this, &EditPanel::cut);
  return box;
}

const Model* EditPanel::target() const {
  const Model* model = parts_.store.find(parts_.list.selected());
  return model && model->data->kind != ModelKind::kRecording ? model : nullptr;
}

void EditPanel::show_count() {
  const Model* model = target();
  const bool mesh = model && model->data->kind == ModelKind::kMesh;
  const std::size_t chosen = selected();
  count_->setText(
      !model        ? tr("Choose a mesh or cloud above")
      : chosen == 0 ? tr("Nothing selected")
      : mesh ? tr("%1 of %2 triangles selected").arg(grouped(chosen), grouped(selection().size()))
             : tr("%1 of %2 points selected").arg(grouped(chosen), grouped(selection().size())));
  for (QPushButton* each : of_any_) each->setEnabled(model != nullptr);
  for (QPushButton* each : of_mesh_) each->setEnabled(mesh);
  for (QPushButton* each : of_selection_) each->setEnabled(chosen > 0);
}

void EditPanel::show_plane(bool on) {
  plane_row_->setVisible(on);
  const auto [normal, offset] = plane_->plane();
  parts_.view.set_clip(on ? normal : Vec3d::Zero(), on ? offset : 0.0);
}

}  // namespace turnscan::studio
