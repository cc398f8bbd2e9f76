// Display of a simulated scan: samples as they arrive, coverage, holes.

#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/paths.hpp"
#include "simulator/simulator_parts.hpp"
#include "simulator/simulator_runs.hpp"
#include "view/scene_view.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"
#include "widgets/theme.hpp"

namespace turnscan::studio {

namespace {

constexpr std::size_t kShownSamples = 600000;
const QColor kHoleColor(0xff0090);
constexpr double kSmallestShare = 5e-4;  // of the surface; smaller reasons get no line

/// "Missed  12.3 %"
template <class Category>
Legend::Entry share_entry(Category category, double percent) {
  return {to_color(color_of(category)), QString("%1  %2 %")
                                            .arg(translated_title(std::string(name_of(category))))
                                            .arg(percent, 0, 'f', 1)};
}

Legend state_legend(const CoverageMap& map) {
  const double area = std::max(1e-12, map.area_m2);
  Legend legend;
  legend.title = QObject::tr("Share of the surface");
  for (std::size_t s = 0; s < kCoverageStateCount; ++s)
    legend.entries.push_back(
        share_entry(static_cast<CoverageState>(s), 100.0 * map.state_m2[s] / area));
  return legend;
}

Legend density_legend(double thin_per_mm2) {
  Legend legend;
  legend.title = QObject::tr("Samples per mm²");
  legend.continuous = true;
  const QColor colors[] = {QColor(38, 70, 160), QColor(60, 160, 110), QColor(240, 220, 70)};
  for (int i = 0; i < 3; ++i)
    legend.entries.push_back(
        {colors[i], QString::number(thin_per_mm2 * std::pow(16.0, i), 'g', 3)});
  return legend;
}

Legend reason_legend(const CoverageMap& map) {
  const double area = std::max(1e-12, map.area_m2);
  Legend legend;
  legend.title = QObject::tr("Without a sample");
  for (int m = 1; m < kMissCount; ++m) {
    const double share = map.reason_m2[std::size_t(m)] / area;
    if (share < kSmallestShare) continue;
    legend.entries.push_back(share_entry(static_cast<Miss>(m), 100.0 * share));
  }
  legend.entries.push_back({to_color(color_of(Miss::kNone)), QObject::tr("Has samples")});
  return legend;
}

}  // namespace

void SimulatorMode::build_coverage() {
  auto* section = new Section(tr("What was covered"), true, this);
  coverage_box_ = section;
  coloring_ = new QComboBox(section);
  coloring_->setObjectName("coverage_coloring");
  coloring_->setAccessibleName(tr("What the colours show"));
  coloring_->addItems(
      {tr("Coverage"), tr("Density of samples"), tr("Why it was missed"), tr("The samples only")});
  holes_ = new QTableWidget(0, 3, section);
  holes_->setObjectName("holes");
  holes_->setAccessibleName(tr("The largest holes"));
  holes_->setHorizontalHeaderLabels({tr("Hole"), tr("Size, mm"), tr("Reason")});
  holes_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  holes_->horizontalHeader()->setStretchLastSection(true);
  holes_->verticalHeader()->hide();
  holes_->setSelectionBehavior(QAbstractItemView::SelectRows);
  holes_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  holes_->setShowGrid(false);
  holes_->setMinimumHeight(190);
  section->body()->addWidget(coloring_);
  section->body()->addWidget(
      quiet_label(tr("The largest holes; click one to fly there."), section));
  section->body()->addWidget(holes_);
  connect(coloring_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &SimulatorMode::show_coloring);
  connect(holes_, &QTableWidget::cellClicked, this, [this](int row, int) { fly_to_hole(row); });
  section->setVisible(false);
  panel()->addWidget(section);
}

void SimulatorMode::show_samples() {
  if (!stream_) return;
  PointCloud cloud;
  {
    const std::lock_guard lock(stream_->mutex);
    cloud.points.swap(stream_->points);
  }
  if (cloud.empty() || samples_shown_ > kShownSamples) return;
  samples_shown_ += cloud.size();
  ItemStyle style;
  style.color = QColor(0x12708f);
  style.boxed = false;
  style.in_view = false;
  sample_items_.push_back(view().add(make_drawable(cloud), style));
}

void SimulatorMode::clear_samples() {
  for (const int item : sample_items_) view().remove(item);
  sample_items_.clear();
  samples_shown_ = 0;
}

void SimulatorMode::show_result(std::shared_ptr<SimulationResult> result) {
  result_ = std::move(result);
  send_->setEnabled(true);
  reconstruct_->setEnabled(true);
  Q_EMIT status(tr("Wrote %1").arg(shown_path(QString::fromStdString(result_->folder))));
  if (result_->coverage_error && result_->coverage_error->code != ErrorCode::kCancelled)
    error_->show_text(QString::fromStdString(result_->coverage_error->text()));
  if (!result_->colored[0]) return;
  coverage_box_->setVisible(true);
  fill_holes();
  show_coloring(coloring_->currentIndex());
  reveal(coverage_box_);
}

void SimulatorMode::show_coloring(int index) {
  if (!result_ || !result_->colored[0]) return;
  const bool samples = index == 3;
  for (const int item : sample_items_) {
    ItemStyle style;
    style.color = QColor(0x12708f);
    style.boxed = style.in_view = false;
    style.visible = samples;
    view().set_style(item, style);
  }
  ItemStyle object;
  object.color = model_color(0);
  object.visible = samples;
  view().set_style(object_item_, object);
  view().remove(coverage_item_);
  view().remove(hole_item_);
  coverage_item_ = hole_item_ = 0;
  if (!samples) {
    ItemStyle style;
    style.boxed = false;
    coverage_item_ = view().add(result_->colored[std::size_t(index)], style);
  }
  view().set_legend(index == 0   ? state_legend(result_->map)
                    : index == 1 ? density_legend(coverage_->thin_per_mm2)
                    : index == 2 ? reason_legend(result_->map)
                                 : Legend());
}

void SimulatorMode::fill_holes() {
  const auto& holes = result_->map.holes;
  holes_->setRowCount(int(holes.size()));
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const CoverageHole& hole = holes[i];
    const Vec3d size = 1e3 * hole.size_m;
    const QString texts[] = {tr("%1 cm²").arg(1e4 * hole.area_m2, 0, 'f', 1),
                             QString("%1 × %2 × %3")
                                 .arg(size.x(), 0, 'f', 0)
                                 .arg(size.y(), 0, 'f', 0)
                                 .arg(size.z(), 0, 'f', 0),
                             translated_title(std::string(name_of(hole.reason)))};
    for (int c = 0; c < 3; ++c) holes_->setItem(int(i), c, new QTableWidgetItem(texts[c]));
  }
}

/// The camera looks along the normal of the hole's surface, which is drawn over the object.
void SimulatorMode::fly_to_hole(int row) {
  if (!result_ || row < 0 || row >= int(result_->map.holes.size())) return;
  const CoverageHole& hole = result_->map.holes[std::size_t(row)];
  const HoleSurface surface =
      surface_of_hole(result_->map, std::size_t(row), result_->T_world_table);
  view().remove(hole_item_);
  ItemStyle style;
  style.color = kHoleColor;
  style.lit = style.boxed = style.in_view = false;
  hole_item_ = view().add(make_drawable(surface.mesh, Shading::kFlat), style);
  view().fly_to(surface.middle, std::max(0.05, 2.5 * hole.size_m.norm()), surface.from);
}

}  // namespace turnscan::studio
