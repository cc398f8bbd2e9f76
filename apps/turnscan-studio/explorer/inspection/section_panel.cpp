#include "explorer/inspection/section_panel.hpp"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QPushButton>
#include <turnscan/io/file/atomic_file.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "explorer/inspection/plane_box.hpp"
#include "explorer/inspection/tool_buttons.hpp"
#include "explorer/model_list.hpp"
#include "view/scene_view.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

constexpr int kRestMs = 120;
const QColor kCapColor(0xe0a43a), kContourColor(0x7a3a00);

DrawablePtr contour_drawable(const turnscan::Section& section) {
  Segments lines;
  for (const Contour& contour : section.contours) {
    const std::size_t n = contour.points.size();
    for (std::size_t i = 0; i + (contour.closed ? 0 : 1) < n; ++i)
      lines.add(contour.points[i], contour.points[(i + 1) % n]);
  }
  return make_drawable(lines);
}

}  // namespace

SectionPanel::SectionPanel(const ExplorerParts& parts, QWidget* parent)
    : QWidget(parent),
      parts_(parts),
      // The cut faces a user who looks from above.
      plane_(new PlaneBox("section", PlaneBox::kBelow, this)),
      on_(button(tr("Section"), tr("Cut all models open by a plane, and close the selected one"),
                 this)),
      dxf_(button(tr("Export DXF…"), tr("The contours as a drawing in millimetres"), this)),
      svg_(button(tr("Export SVG…"), tr("The contours as a drawing in millimetres"), this)),
      figures_(new ParagraphLabel(this)),
      error_(new MessageLabel(this)) {
  on_->setObjectName("section_on");
  dxf_->setObjectName("section_dxf");
  svg_->setObjectName("section_svg");
  figures_->setObjectName("section_figures");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(on_);
  layout->addWidget(plane_);
  layout->addWidget(figures_);
  layout->addWidget(error_);
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  row->addWidget(dxf_, 1);
  row->addWidget(svg_, 1);
  layout->addLayout(row);
  later_.setSingleShot(true);
  parts_.tools.add(on_, nullptr, [this](bool on) { show_plane(on); });
  connect(plane_, &PlaneBox::changed, this, [this] {
    if (on_->isChecked()) show_plane(true);
  });
  connect(&later_, &QTimer::timeout, this, &SectionPanel::update_section);
  connect(dxf_, &QPushButton::clicked, this,
          [this] { export_dialog("dxf", tr("Drawing (*.dxf)")); });
  connect(svg_, &QPushButton::clicked, this,
          [this] { export_dialog("svg", tr("Drawing (*.svg)")); });
  connect(&parts_.list, &ModelList::selection_changed, this, &SectionPanel::follow_model);
  connect(&parts_.store, &ModelStore::changed, this, &SectionPanel::follow_model);
  connect(&parts_.jobs, &JobRunner::cancelled, this, [this] { running_ = false; });
  follow_model();
  show_plane(false);
}

SectionPanel::~SectionPanel() = default;

const Model* SectionPanel::target() const {
  const Model* model = parts_.store.find(parts_.list.selected());
  return model && model->data->kind != ModelKind::kRecording ? model : nullptr;
}

void SectionPanel::follow_model() {
  const Model* model = target();
  on_->setEnabled(model != nullptr);
  plane_->set_box(model ? box_of(*model->data->drawable) : Box());
  if (!model && on_->isChecked()) on_->setChecked(false);
  if (on_->isChecked() && model->data != of_) show_plane(true);
}

/// The view is clipped at once; contours and cap follow when the plane stops moving.
void SectionPanel::show_plane(bool on) {
  plane_->setEnabled(on);
  if (on) {
    const auto [normal, offset] = plane_->plane();
    parts_.view.set_clip(normal, offset);
    later_.start(kRestMs);
    return;
  }
  later_.stop();
  parts_.view.set_clip(Vec3d::Zero(), 0.0);
  section_.reset();
  of_.reset();
  clear_drawn();
  figures_->setVisible(false);
  dxf_->setEnabled(false);
  svg_->setEnabled(false);
}

void SectionPanel::update_section() {
  const Model* model = target();
  if (!on_->isChecked() || !model) return;
  of_ = model->data;
  if (model->data->kind != ModelKind::kMesh) {
    clear_drawn();
    return;
  }
  again_ = running_;
  if (running_) return;
  running_ = true;
  const auto [normal, offset] = plane_->plane();
  parts_.jobs.start(
      tr("Section"), this,
      [this, data = model->data,
       plane = HalfSpace{normal, offset}](const RunContext& context) -> Result<Finish> {
        context.begin_phase("section", 0);
        TURNSCAN_ASSIGN(turnscan::Section made, cross_section(data->mesh, plane));
        const auto cap = section_cap(made);
        const QString problem = cap ? QString() : QString::fromStdString(cap.error().text());
        return Finish(
            [this, made, problem, contour = contour_drawable(made),
             closed = cap && !cap->empty() ? make_drawable(*cap, Shading::kFlat) : nullptr] {
              running_ = false;
              take(made, contour, closed, problem);
            });
      },
      [this](const QString& text) {
        running_ = false;
        error_->show_text(text);
      });
}

void SectionPanel::take(const turnscan::Section& made, DrawablePtr contour, DrawablePtr cap,
                        const QString& problem) {
  if (!on_->isChecked()) return;
  section_ = made;
  error_->show_text(problem);
  clear_drawn();
  ItemStyle style;
  style.own_colors = style.boxed = style.in_view = false;
  if (!made.contours.empty()) {
    style.color = kContourColor;
    style.line_width = 2.0;
    contour_item_ = parts_.view.add(contour, style);
  }
  if (cap) {
    style.color = kCapColor;
    style.lit = false;
    cap_item_ = parts_.view.add(cap, style);
  }
  const QString open =
      made.open > 0 ? tr(", %1 of them open: the mesh has holes there").arg(made.open) : QString();
  figures_->setVisible(true);
  figures_->show_text(made.contours.empty() ? tr("The plane does not meet the selected model")
                                            : tr("%1 contours%2, area %3 cm², length %4 mm")
                                                  .arg(made.contours.size())
                                                  .arg(open)
                                                  .arg(1e4 * made.area_m2, 0, 'f', 3)
                                                  .arg(1e3 * made.length_m, 0, 'f', 2));
  dxf_->setEnabled(!made.contours.empty());
  svg_->setEnabled(!made.contours.empty());
  if (again_) update_section();
}

void SectionPanel::clear_drawn() {
  for (int* item : {&contour_item_, &cap_item_}) {
    if (*item != 0) parts_.view.remove(*item);
    *item = 0;
  }
}

void SectionPanel::export_dialog(const QString& ending, const QString& filter) {
  const Model* model = target();
  const QString path =
      ask_save_path(this, tr("Export the section"),
                    QString("%1-section.%2").arg(model ? model->name : QString(), ending), filter);
  if (path.isEmpty()) return;
  export_drawing(path);
}

void SectionPanel::export_drawing(const QString& path) {
  if (!section_ || !of_) return;
  error_->show_text({});
  parts_.jobs.start(
      tr("Export %1").arg(QFileInfo(path).fileName()), this,
      [this, of = of_, plane = HalfSpace{-section_->normal, -section_->offset_m},
       path](const RunContext& context) -> Result<Finish> {
        context.begin_phase("write", 0);
        const bool dxf = path.endsWith(".dxf", Qt::CaseInsensitive);
        // As seen by the user, who looks at the cut against its normal.
        TURNSCAN_ASSIGN(const turnscan::Section section, cross_section(of->mesh, plane));
        TURNSCAN_ASSIGN(const std::string text, dxf ? section_dxf(section) : section_svg(section));
        TURNSCAN_TRY(write_file_atomically(path.toStdString(), text));
        return Finish([this, path] { Q_EMIT said(tr("Wrote %1").arg(shown_path(path))); });
      },
      [this](const QString& text) { error_->show_text(text); });
}

}  // namespace turnscan::studio
