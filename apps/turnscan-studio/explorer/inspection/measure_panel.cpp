#include "explorer/inspection/measure_panel.hpp"

#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QTreeWidget>
#include <algorithm>
#include <turnscan/evaluation/inspection/deviations.hpp>
#include <turnscan/io/file/atomic_file.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "explorer/inspection/measure_tool.hpp"
#include "explorer/inspection/tool_buttons.hpp"
#include "explorer/model_list.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

struct KindText {
  QString name, tip, hint;
};

KindText text_of(MeasurementKind kind) {
  switch (kind) {
    case MeasurementKind::kDeviation:
      return {QObject::tr("Probe"), QObject::tr("The deviation from the reference at a place"),
              QObject::tr("Click on a model whose deviations are shown")};
    case MeasurementKind::kDistance:
      return {QObject::tr("Distance"), QObject::tr("Distance between two places"),
              QObject::tr("Click two places on models")};
    case MeasurementKind::kAngle:
      return {QObject::tr("Angle"),
              QObject::tr("Angle at a corner between the directions to two places"),
              QObject::tr("Click a place, the corner, and another place")};
    case MeasurementKind::kCircle:
      return {QObject::tr("Circle"), QObject::tr("Diameter of the circle through three places"),
              QObject::tr("Click three places on the circle")};
    case MeasurementKind::kPlane:
      return {QObject::tr("Plane"), QObject::tr("How flat the surface around a place is"),
              QObject::tr("Click on a flat part of the selected model")};
    case MeasurementKind::kThickness:
      return {QObject::tr("Thickness"),
              QObject::tr("Thickness of the wall behind a place, perpendicular to it"),
              QObject::tr("Click on the selected model")};
  }
  return {};
}

QString text_with_number(std::size_t number, const Measurement& m) {
  return QString("%1: %2").arg(number).arg(
      QString::fromStdString(measurement_text(m)).section(',', 0, 0));
}

/// The visible model whose surface is nearest to a point picked on the screen, and the nearest
/// point on it.
struct Touched {
  const Model* model = nullptr;
  Vec3d place = Vec3d::Zero();
};
Touched touched_of(const std::vector<Model>& models, const Vec3d& picked) {
  Touched out;
  double nearest = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Model& model, const Vec3d& place) {
    if ((place - picked).norm() >= nearest) return;
    nearest = (place - picked).norm();
    out = {&model, place};
  };
  for (const Model& model : models) {
    if (!model.visible) continue;
    if (model.data->kind == ModelKind::kMesh) {
      if (const auto at = nearest_surface_point(model.data->mesh, picked)) offer(model, at->point);
    } else {
      for (const Vec3f& p : model.data->cloud.points) offer(model, p.cast<double>());
    }
  }
  return out;
}

}  // namespace

MeasurePanel::MeasurePanel(const ExplorerParts& parts, DistanceOf distance_of, QWidget* parent)
    : QWidget(parent), parts_(parts), distance_of_(std::move(distance_of)) {
  tool_ = std::make_unique<MeasureTool>(
      parts_.view, [this] { show_hint(); },
      [this](const std::vector<Vec3d>& places) { finish(places); });
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(make_kinds());
  hint_ = quiet_label({}, this);
  hint_->setVisible(false);
  error_ = new MessageLabel(this);
  layout->addWidget(hint_);
  layout->addWidget(error_);
  layout->addWidget(make_list());
  parts_.view.set_marks([this](QPainter& painter) { paint(painter); });
  fill_list();
}

// The view outlives its panels, and must no longer paint what they keep.
MeasurePanel::~MeasurePanel() = default;

QWidget* MeasurePanel::make_kinds() {
  auto* box = new QWidget(this);
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  int place = 0;
  for (const MeasurementKind kind : kMeasurementKinds) {
    const KindText text = text_of(kind);
    auto* made = button(text.name, text.tip, box);
    made->setObjectName(QString("measure_") +
                        QString::fromUtf8(name_of(kind).data(), int(name_of(kind).size())));
    grid->addWidget(made, place / 3, place % 3);
    ++place;
    kinds_.push_back(made);
    parts_.tools.add(made, tool_.get(), [this, kind](bool on) {
      if (on) begin(kind);
      show_hint();
    });
  }
  patch_ = new QDoubleSpinBox(box);
  patch_->setObjectName("measure_patch");
  patch_->setRange(0.1, 1000.0);
  patch_->setValue(5.0);
  patch_->setSuffix(" mm");
  patch_->setToolTip(tr("A plane is fitted to the surface within this distance of the click"));
  patch_->setAccessibleName(tr("Radius of the patch that a plane is fitted to"));
  leave_wheel_to_panel(patch_);
  grid->addWidget(new QLabel(tr("Plane within"), box), 2, 0, 1, 2);
  grid->addWidget(patch_, 2, 2);
  return box;
}

QWidget* MeasurePanel::make_list() {
  auto* box = new QWidget(this);
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  list_ = new QTreeWidget(box);
  list_->setObjectName("measurements");
  list_->setAccessibleName(tr("Measurements"));
  list_->setHeaderHidden(true);
  list_->setColumnCount(3);
  list_->setRootIsDecorated(false);
  list_->setIndentation(4);
  list_->setFixedHeight(110);
  list_->header()->setStretchLastSection(true);
  list_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  remove_ = button(tr("Remove"), tr("Remove the chosen measurement"), box);
  clear_ = button(tr("Clear"), tr("Remove all measurements"), box);
  export_ = button(tr("Export CSV…"), tr("All measurements as a table"), box);
  remove_->setObjectName("measure_remove");
  clear_->setObjectName("measure_clear");
  export_->setObjectName("measure_export");
  for (QPushButton* each : {remove_, clear_, export_}) row->addWidget(each, 1);
  layout->addWidget(list_);
  layout->addLayout(row);
  connect(remove_, &QPushButton::clicked, this, &MeasurePanel::remove_chosen);
  connect(clear_, &QPushButton::clicked, this, [this] {
    kept_.clear();
    fill_list();
  });
  connect(export_, &QPushButton::clicked, this, &MeasurePanel::export_dialog);
  connect(list_, &QTreeWidget::currentItemChanged, this, [this] {
    remove_->setEnabled(list_->currentItem() != nullptr);
    parts_.view.update_overlay();
  });
  return box;
}

void MeasurePanel::begin(MeasurementKind kind) {
  kind_ = kind;
  error_->show_text({});
  tool_->begin(places_of(kind));
}

void MeasurePanel::show_hint() {
  const bool active =
      std::any_of(kinds_.begin(), kinds_.end(), [](const auto* each) { return each->isChecked(); });
  hint_->setVisible(active);
  if (!active) return;
  const std::size_t count = places_of(kind_), clicked = tool_->clicked();
  hint_->setText(clicked == 0 ? text_of(kind_).hint
                              : tr("Place %1 of %2").arg(clicked + 1).arg(count));
}

/// Visits every triangle, which takes a while for large meshes: not on the window's thread.
void MeasurePanel::finish(const std::vector<Vec3d>& places) {
  error_->show_text({});
  std::shared_ptr<const SignedDistance> distance;
  int of_distance = 0;
  for (const Model& model : parts_.store.models())
    if (auto known = distance_of_(model)) {
      distance = std::move(known);
      of_distance = model.id;
    }
  parts_.jobs.start(
      text_of(kind_).name, this,
      [this, places, kind = kind_, models = parts_.store.models(), distance, of_distance,
       patch = 1e-3 * patch_->value()](const RunContext& context) -> Result<Finish> {
        context.begin_phase("measure", 0);
        std::vector<Vec3d> on_surface;
        const Model* model = nullptr;
        for (const Vec3d& place : places) {
          const Touched at = touched_of(models, place);
          if (!at.model) return fail(ErrorCode::kTooFewPoints, "measure: no model is shown there");
          if (!model) model = at.model;
          on_surface.push_back(at.place);
        }
        Measurement made;
        if (kind == MeasurementKind::kDeviation) {
          if (!distance || model->id != of_distance) {
            return fail(
                ErrorCode::kUnsupported,
                "probe: '{}' has no deviations yet; select it, choose a reference and press "
                "Deviations",
                model->name.toStdString());
          }
          made.kind = kind;
          made.places = on_surface;
          made.value = distance->at(on_surface[0]);
        } else {
          const ModelData& on = *model->data;
          const bool mesh = on.kind == ModelKind::kMesh;
          TURNSCAN_ASSIGN(made, measure(kind, on_surface,
                                        {mesh ? &on.mesh : nullptr,
                                         mesh ? on.mesh.vertices : on.cloud.points, patch}));
        }
        made.of = model->name.toStdString();
        return Finish([this, made] { keep(made); });
      },
      [this](const QString& text) { error_->show_text(text); });
}

void MeasurePanel::keep(const Measurement& made) {
  kept_.push_back(made);
  fill_list();
  list_->setCurrentItem(list_->topLevelItem(int(kept_.size()) - 1));
  Q_EMIT said(QString("%1: %2").arg(text_of(made.kind).name,
                                    QString::fromStdString(measurement_text(made))));
}

void MeasurePanel::fill_list() {
  list_->clear();
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const QString text = QString::fromStdString(measurement_text(kept_[i]));
    auto* item =
        new QTreeWidgetItem(list_, {QString::number(i + 1), text_of(kept_[i].kind).name, text});
    item->setToolTip(2, QString("%1 (%2)").arg(text, QString::fromStdString(kept_[i].of)));
  }
  remove_->setEnabled(list_->currentItem() != nullptr);
  clear_->setEnabled(!kept_.empty());
  export_->setEnabled(!kept_.empty());
  parts_.view.update_overlay();
}

void MeasurePanel::remove_chosen() {
  const int at = list_->indexOfTopLevelItem(list_->currentItem());
  if (at < 0) return;
  kept_.erase(kept_.begin() + at);
  fill_list();
}

void MeasurePanel::paint(QPainter& painter) const {
  const int chosen = list_->indexOfTopLevelItem(list_->currentItem());
  const auto& models = parts_.store.models();
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    // One that is gone or renamed leaves them where they were made.
    const auto of = std::find_if(models.begin(), models.end(), [&](const Model& model) {
      return model.name.toStdString() == kept_[i].of;
    });
    if (of == models.end() || of->visible)
      paint_measurement(painter, parts_.view, kept_[i], text_with_number(i + 1, kept_[i]),
                        int(i) == chosen);
  }
}

void MeasurePanel::export_dialog() {
  const QString path =
      ask_save_path(this, tr("Export measurements"), "measurements.csv", tr("Table (*.csv)"));
  if (path.isEmpty()) return;
  export_csv(path);
}

void MeasurePanel::export_csv(const QString& path) {
  error_->show_text({});
  parts_.jobs.start(
      tr("Export %1").arg(QFileInfo(path).fileName()), this,
      [this, kept = kept_, path](const RunContext& context) -> Result<Finish> {
        context.begin_phase("write", 0);
        TURNSCAN_TRY(write_file_atomically(path.toStdString(), measurements_csv(kept)));
        return Finish([this, path] { Q_EMIT said(tr("Wrote %1").arg(shown_path(path))); });
      },
      [this](const QString& text) { error_->show_text(text); });
}

}  // namespace turnscan::studio
