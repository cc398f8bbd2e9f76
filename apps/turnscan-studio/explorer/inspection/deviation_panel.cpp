#include "explorer/inspection/deviation_panel.hpp"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/evaluation/inspection/alignment.hpp>
#include <turnscan/geometry/search/sample.hpp>
#include <turnscan/io/file/atomic_file.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "explorer/loading.hpp"
#include "explorer/model_list.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

constexpr std::size_t kAlignPoints = 20000;
constexpr std::size_t kHistogramBins = 48;

QDoubleSpinBox* length_box(const QString& name, const QString& tip, double mm, QWidget* parent) {
  auto* box = new QDoubleSpinBox(parent);
  box->setObjectName(name);
  box->setDecimals(3);
  box->setRange(0.0, 10000.0);
  box->setSingleStep(0.1);
  box->setSuffix(" mm");
  box->setValue(mm);
  box->setKeyboardTracking(false);
  box->setToolTip(tip);
  leave_wheel_to_panel(box);
  return box;
}

const std::vector<Vec3f>& points_of(const ModelData& data) {
  return data.kind == ModelKind::kMesh ? data.mesh.vertices : data.cloud.points;
}

/// Start points for the search of pairs: uniformly dense on a mesh, every n-th point of a cloud.
Result<std::vector<Vec3f>> alignment_points(const ModelData& data, const RunContext& context) {
  if (data.kind == ModelKind::kMesh) {
    TURNSCAN_ASSIGN(SurfaceSamples samples, sample_surface(data.mesh, kAlignPoints, 1, context));
    return std::move(samples.points);
  }
  std::vector<Vec3f> out;
  const std::size_t step = std::max<std::size_t>(1, data.cloud.size() / kAlignPoints);
  for (std::size_t i = 0; i < data.cloud.size(); i += step) out.push_back(data.cloud.points[i]);
  return out;
}

ModelDataPtr moved_model(const ModelData& data, const Pose& pose) {
  if (data.kind == ModelKind::kMesh)
    return mesh_model(transformed(data.mesh, pose), data.source, {}, data.confidence);
  std::vector<Viewpoint> viewpoints;
  for (const Viewpoint& each : data.viewpoints) viewpoints.push_back(each.transformed(pose));
  return cloud_model(moved(data.cloud, pose), data.source, {}, viewpoints);
}

QString mm_text(double metres) { return QString::number(1e3 * metres, 'f', 3); }

}  // namespace

DeviationPanel::DeviationPanel(const ExplorerParts& parts, QWidget* parent)
    : QWidget(parent),
      parts_(parts),
      reference_(new QComboBox(this)),
      tolerance_(length_box("deviation_tolerance",
                            tr("What deviates by less is grey: it is in tolerance"), 0.1, this)),
      range_(length_box("deviation_range",
                        tr("The deviation of the darkest colours; automatic: 95 of 100 vertices "
                           "deviate less"),
                        0.0, this)),
      run_(primary_button(tr("Deviations"),
                          tr("Colour the selected model by its signed distance to the reference: "
                             "red outside of it, blue inside"),
                          this)),
      align_(button(tr("Align to it"),
                    tr("Move the selected model rigidly onto the reference, from where it lies"),
                    this)),
      hide_(button(tr("Hide"), tr("Show the model in its own colours again"), this)),
      export_(button(tr("Export CSV…"), tr("The deviation of each vertex or point"), this)),
      figures_(new ParagraphLabel(this)),
      error_(new MessageLabel(this)) {
  reference_->setObjectName("deviation_reference");
  reference_->setAccessibleName(tr("Reference of deviations"));
  reference_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  leave_wheel_to_panel(reference_);
  run_->setObjectName("deviation_run");
  align_->setObjectName("deviation_align");
  export_->setObjectName("deviation_export");
  figures_->setObjectName("deviation_figures");
  range_->setSpecialValueText(tr("automatic"));
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(6);
  grid->setColumnStretch(1, 1);
  grid->addWidget(new QLabel(tr("Reference"), this), 0, 0);
  grid->addWidget(reference_, 0, 1);
  grid->addWidget(new QLabel(tr("Tolerance"), this), 1, 0);
  grid->addWidget(tolerance_, 1, 1);
  grid->addWidget(new QLabel(tr("Range of colours"), this), 2, 0);
  grid->addWidget(range_, 2, 1);
  const auto add_row = [&](int row, QPushButton* left, QPushButton* right) {
    auto* pair = new QHBoxLayout;
    pair->setSpacing(6);
    pair->addWidget(left, 1);
    pair->addWidget(right, 1);
    grid->addLayout(pair, row, 0, 1, 2);
  };
  add_row(3, run_, align_);
  grid->addWidget(error_, 4, 0, 1, 2);
  grid->addWidget(figures_, 5, 0, 1, 2);
  add_row(6, export_, hide_);
  connect(run_, &QPushButton::clicked, this, &DeviationPanel::run);
  connect(align_, &QPushButton::clicked, this, &DeviationPanel::align);
  connect(hide_, &QPushButton::clicked, this, &DeviationPanel::hide_colors);
  connect(export_, &QPushButton::clicked, this, &DeviationPanel::export_dialog);
  for (QDoubleSpinBox* each : {tolerance_, range_})
    connect(each, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &DeviationPanel::recolor);
  connect(reference_, qOverload<int>(&QComboBox::activated), this, &DeviationPanel::enable);
  connect(&parts_.list, &ModelList::selection_changed, this, &DeviationPanel::enable);
  connect(&parts_.store, &ModelStore::changed, this, &DeviationPanel::fill);
  figures_->setVisible(false);
  fill();
}

DeviationPanel::~DeviationPanel() = default;

double DeviationPanel::tolerance_m() const { return 1e-3 * tolerance_->value(); }

const Model* DeviationPanel::reference() const {
  return parts_.store.find(reference_->currentData().toInt());
}

/// The selected model, if it can be compared with the reference.
const Model* DeviationPanel::target() const {
  const Model* model = parts_.store.find(parts_.list.selected());
  const Model* to = reference();
  if (!model || !to || model->id == to->id || model->data->kind == ModelKind::kRecording)
    return nullptr;
  return model;
}

const Model* DeviationPanel::shown_model() const {
  for (const Model& model : parts_.store.models())
    if (shown_.of && model.data == shown_.of) return &model;
  return nullptr;
}

void DeviationPanel::fill() {
  const int before = reference_->currentData().toInt();
  {
    const QSignalBlocker quiet(reference_);
    reference_->clear();
    for (const Model& model : parts_.store.models())
      if (model.data->kind == ModelKind::kMesh) reference_->addItem(model.name, model.id);
    reference_->setCurrentIndex(std::max(0, reference_->findData(before)));
  }
  // An edit made new data, or the model was removed; an undo may restore it, but not these colours.
  if (shown_.of && !shown_model()) {
    shown_ = {};
    show_figures();
  }
  enable();
}

void DeviationPanel::enable() {
  const bool possible = target() != nullptr;
  for (QPushButton* each : {run_, align_}) {
    each->setEnabled(possible);
  }
  export_->setEnabled(shown_.of != nullptr);
  hide_->setEnabled(shown_.of != nullptr);
}

DrawablePtr DeviationPanel::drawable_of(const Model& model) const {
  return shown_.of && model.data == shown_.of ? shown_.drawable : nullptr;
}

bool DeviationPanel::hides(int id) const {
  const Model* model = shown_model();
  return model && model->visible && shown_.reference == id;
}

std::shared_ptr<const SignedDistance> DeviationPanel::distance_of(const Model& model) const {
  return shown_.of && model.data == shown_.of ? shown_.distance : nullptr;
}

std::optional<Legend> DeviationPanel::legend() const {
  const Model* model = shown_model();
  if (!model || !model->visible) return std::nullopt;
  constexpr int kSteps = 8, kFine = 200;
  Legend legend;
  legend.title = tr("Deviation from %1").arg(shown_.reference_name);
  legend.continuous = true;
  legend.histogram =
      deviation_histogram(shown_.values, shown_.weights, shown_.range_m, kHistogramBins);
  const auto at = [this](int step, int steps) {
    return shown_.range_m * (2.0 * step / steps - 1.0);
  };
  for (int i = 0; i <= kSteps; ++i) {
    const double value = at(i, kSteps);
    legend.entries.push_back(
        {to_color(deviation_color(value, tolerance_m(), shown_.range_m)),
         QString("%1%2 mm").arg(value > 0.0 ? "+" : "").arg(1e3 * value, 0, 'g', 3)});
  }
  for (int i = 0; i <= kFine; ++i)
    legend.bar.push_back(to_color(deviation_color(at(i, kFine), tolerance_m(), shown_.range_m)));
  return legend;
}

double DeviationPanel::range_of(const std::vector<float>& values, double wanted_m) {
  if (wanted_m > 0.0) return wanted_m;
  std::vector<float> away;
  for (const float value : values)
    if (std::isfinite(value)) away.push_back(std::abs(value));
  if (away.empty()) return 1e-3;
  const auto rank = away.begin() + std::ptrdiff_t(0.95 * double(away.size() - 1));
  std::nth_element(away.begin(), rank, away.end());
  return std::max(1e-6, double(*rank));
}

DrawablePtr DeviationPanel::color(const ModelData& data, const std::vector<float>& values,
                                  double tolerance_m, double range_m) {
  std::vector<Rgb> colors;
  colors.reserve(values.size());
  for (const float value : values) colors.push_back(deviation_color(value, tolerance_m, range_m));
  if (data.kind == ModelKind::kCloud) {
    PointCloud cloud = data.cloud;
    cloud.colors = std::move(colors);
    return make_drawable(cloud);
  }
  TriangleMesh mesh = data.mesh;
  mesh.texture = nullptr;
  mesh.colors = std::move(colors);
  return make_drawable(mesh);
}

void DeviationPanel::run() {
  const Model* model = target();
  const Model* to = reference();
  error_->show_text({});
  if (!model || !to) return;
  parts_.jobs.start(
      tr("Deviations"), this,
      [this, a = *model, b = *to, tolerance = tolerance_m(),
       wanted = 1e-3 * range_->value()](const RunContext& context) -> Result<Finish> {
        Shown made{a.data, b.id, a.name, b.name, nullptr, {}, {}, 0.0, nullptr};
        context.begin_phase("prepare the reference", 0);
        TURNSCAN_ASSIGN(SignedDistance distance, SignedDistance::to(b.data->mesh, context));
        TURNSCAN_ASSIGN(made.values, deviations_from(distance, points_of(*a.data), context));
        made.distance = std::make_shared<const SignedDistance>(std::move(distance));
        if (a.data->kind == ModelKind::kMesh) made.weights = surface_shares(a.data->mesh);
        made.range_m = range_of(made.values, wanted);
        made.drawable = color(*a.data, made.values, tolerance, made.range_m);
        return Finish([this, made = std::move(made)] {
          shown_ = made;
          show_figures();
          enable();
          Q_EMIT changed();
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

void DeviationPanel::recolor() {
  if (!shown_.of) return;
  parts_.jobs.start(
      tr("Colour the deviations"), this,
      [this, of = shown_.of, values = shown_.values, tolerance = tolerance_m(),
       wanted = 1e-3 * range_->value()](const RunContext& context) -> Result<Finish> {
        context.begin_phase("prepare the view", 0);
        const double range = range_of(values, wanted);
        return Finish([this, of, range, made = color(*of, values, tolerance, range)] {
          if (shown_.of != of) return;  // another one is shown meanwhile
          shown_.drawable = made;
          shown_.range_m = range;
          show_figures();
          Q_EMIT changed();
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

void DeviationPanel::hide_colors() {
  shown_ = {};
  show_figures();
  enable();
  Q_EMIT changed();
}

void DeviationPanel::show_figures() {
  figures_->setVisible(shown_.of != nullptr);
  if (!shown_.of) return;
  const DeviationFigures f = deviation_figures(shown_.values, shown_.weights, tolerance_m());
  const auto percent = [](double share) { return QString::number(100.0 * share, 'f', 1); };
  figures_->show_text(
      tr("%1 to %2: mean %3, rms %4, from %5 to %6 mm. Within ±%7 mm %8 %, above %9 %, below %10 "
         "%. The reference is not drawn meanwhile.")
          .arg(shown_.name, shown_.reference_name, mm_text(f.mean_m), mm_text(f.rms_m),
               mm_text(f.lowest_m), mm_text(f.highest_m))
          .arg(tolerance_->value())
          .arg(percent(f.within), percent(f.above), percent(f.below)));
}

void DeviationPanel::align() {
  const Model* model = target();
  const Model* to = reference();
  error_->show_text({});
  if (!model || !to) return;
  parts_.jobs.start(
      tr("Align"), this,
      [this, a = *model, b = *to](const RunContext& context) -> Result<Finish> {
        context.begin_phase("align", 0);
        TURNSCAN_ASSIGN(const auto points, alignment_points(*a.data, context));
        TURNSCAN_ASSIGN(const Alignment made, align_to(points, b.data->mesh, context));
        const ModelDataPtr aligned = moved_model(*a.data, made.icp.T_target_source);
        return Finish([this, a, b, made, aligned] {
          parts_.store.set_data(a.id, aligned, tr("align %1").arg(a.name));
          const QString text =
              tr("%1 to %2: ").arg(a.name, b.name) + QString::fromStdString(alignment_text(made));
          figures_->setVisible(true);
          figures_->show_text(text);
          Q_EMIT said(text);
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

void DeviationPanel::export_dialog() {
  const QString path = ask_save_path(this, tr("Export deviations"), shown_.name + "-deviations.csv",
                                     tr("Table (*.csv)"));
  if (path.isEmpty()) return;
  export_csv(path);
}

void DeviationPanel::export_csv(const QString& path) {
  if (!shown_.of) return;
  error_->show_text({});
  parts_.jobs.start(
      tr("Export %1").arg(QFileInfo(path).fileName()), this,
      [this, of = shown_.of, values = shown_.values,
       path](const RunContext& context) -> Result<Finish> {
        context.begin_phase("write", 0);
        TURNSCAN_TRY(
            write_file_atomically(path.toStdString(), deviations_csv(points_of(*of), values)));
        return Finish([this, path] { Q_EMIT said(tr("Wrote %1").arg(shown_path(path))); });
      },
      [this](const QString& text) { error_->show_text(text); });
}

}  // namespace turnscan::studio
