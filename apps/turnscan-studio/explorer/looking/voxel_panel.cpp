#include "explorer/looking/voxel_panel.hpp"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <algorithm>
#include <turnscan/evaluation/colormap.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/workflow/cloud_cubes.hpp>
#include <utility>

#include "app/jobs.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"
#include "widgets/theme.hpp"

namespace turnscan::studio {

namespace {

constexpr int kSteps = 1000;

/// Empty if the weights of a cloud are no counts, such as qualities from 0 to 1.
std::vector<float> ascending_counts(const ModelData& data) {
  if (data.kind != ModelKind::kCloud) return {};
  constexpr float kMost = 1e9f;
  std::vector<float> out;
  for (const float weight : data.cloud.weights)
    if (weight > 0.0f && weight <= kMost) out.push_back(weight);
  std::sort(out.begin(), out.end());
  if (out.empty() || out.back() < 2.0f) return {};
  return out;
}

/// Sub-voxels count the lines of sight that cross them.
bool made_of_lines(const ModelData& data) { return data.source.startsWith("sub-voxels "); }

bool made_by_voxels(const ModelData& data) {
  return data.source.startsWith("voxels ") || made_of_lines(data);
}

}  // namespace

VoxelPanel::VoxelPanel(ModelStore& store, QWidget* parent)
    : QWidget(parent),
      store_(store),
      quick_(new JobRunner(this)),
      on_(new QCheckBox(tr("As cubes"), this)),
      least_(new QSpinBox(this)),
      slider_(new QSlider(Qt::Horizontal, this)),
      kept_(quiet_label({}, this)),
      use_(button(tr("Use for Voxelise"),
                  tr("Make this the option voxel-min-points of the next runs"), this)) {
  build();
  connect(&store_, &ModelStore::changed, this, &VoxelPanel::forget_removed);
  connect(on_, &QCheckBox::toggled, this, &VoxelPanel::set_on);
  connect(least_, qOverload<int>(&QSpinBox::valueChanged), this, &VoxelPanel::set_least);
  // Each step keeps about as many cells more or less as any other.
  connect(slider_, &QSlider::valueChanged, this, [this](int step) {
    if (!counts_.empty())
      least_->setValue(int(counts_[(counts_.size() - 1) * std::size_t(step) / kSteps]));
  });
  connect(use_, &QPushButton::clicked, this, [this] { Q_EMIT threshold_wanted(least_->value()); });
  connect(quick_, &JobRunner::finished, this, [this] {
    if (std::exchange(again_, false)) rebuild();
  });
}

VoxelPanel::~VoxelPanel() { delete quick_; }

void VoxelPanel::build() {
  on_->setObjectName("voxel_cubes");
  least_->setObjectName("voxel_least");
  least_->setAccessibleName(tr("Least count of a cell that is shown"));
  least_->setToolTip(tr("Least count of a cell that is shown"));
  leave_wheel_to_panel(least_);
  slider_->setObjectName("voxel_threshold");
  slider_->setAccessibleName(least_->accessibleName());
  slider_->setRange(0, kSteps);
  leave_wheel_to_panel(slider_);
  kept_->setObjectName("voxel_kept");
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setColumnStretch(1, 1);
  auto* label = new QLabel(tr("At least"), this);
  label->setBuddy(least_);
  grid->addWidget(on_, 0, 0, 1, 2);
  grid->addWidget(use_, 0, 2);
  grid->addWidget(label, 1, 0);
  grid->addWidget(slider_, 1, 1);
  grid->addWidget(least_, 1, 2);
  grid->addWidget(kept_, 2, 0, 1, 3);
}

const ModelDataPtr& VoxelPanel::data() const {
  static const ModelDataPtr none;
  const Model* model = store_.find(model_);
  return model ? model->data : none;
}

bool VoxelPanel::applies() const { return !counts_.empty(); }

void VoxelPanel::show_model(int id) {
  model_ = id;
  counts_ = data() ? ascending_counts(*data()) : std::vector<float>();
  if (!applies()) return;
  const bool known = cubes_.count(data()) > 0;
  Cubes& cubes = cubes_[data()];
  if (!known) cubes.least = int(counts_.front());
  {
    const QSignalBlocker a(on_), b(least_);
    on_->setChecked(cubes.on);
    least_->setRange(int(counts_.front()), int(counts_.back()));
    least_->setValue(cubes.least);
  }
  use_->setEnabled(data()->source.startsWith("voxels "));
  show_kept();
  if (!known && made_by_voxels(*data())) on_->setChecked(true);
  // Its job may have waited for one of another model that was shown then.
  if (known && cubes.on && !cubes.drawable) rebuild();
}

void VoxelPanel::set_on(bool on) {
  cubes_[data()].on = on;
  show_kept();
  on ? rebuild() : Q_EMIT changed();
}

void VoxelPanel::set_least(int least) {
  cubes_[data()].least = least;
  show_kept();
  rebuild();
}

void VoxelPanel::show_kept() {
  const int least = least_->value();
  const auto from = std::lower_bound(counts_.begin(), counts_.end(), float(least));
  kept_->setText((made_of_lines(*data()) ? tr("%1 of %2 cells have at least %3 lines")
                                         : tr("%1 of %2 cells have at least %3 points"))
                     .arg(grouped(std::size_t(counts_.end() - from)), grouped(counts_.size()),
                          grouped(std::size_t(least))));
  const QSignalBlocker quiet(slider_);
  if (!slider_->isSliderDown())
    slider_->setValue(int(std::size_t(kSteps) * std::size_t(from - counts_.begin()) /
                          std::max<std::size_t>(1, counts_.size() - 1)));
  for (QWidget* each : {static_cast<QWidget*>(slider_), static_cast<QWidget*>(least_)})
    each->setEnabled(on_->isChecked());
}

void VoxelPanel::rebuild() {
  if (!applies() || !cubes_[data()].on) return;
  again_ = quick_->busy();
  if (again_) return;
  quick_->start(
      tr("Cubes"), this,
      [this, of = data(), least = cubes_[data()].least,
       cubes = cubes_[data()].cubes](const RunContext&) -> Result<Finish> {
        const auto made = cubes ? cubes : std::make_shared<const CloudCubes>(of->cloud);
        TURNSCAN_ASSIGN(TriangleMesh mesh, made->mesh(least));
        TriangleMesh moving = made->coarser(least);
        // Faces share no corners.
        for (TriangleMesh* each : {&mesh, &moving}) each->normals = vertex_normals(*each);
        return Finish([this, of, made, drawable = make_drawable(mesh, moving)] {
          const auto at = cubes_.find(of);
          if (at == cubes_.end()) return;
          at->second.cubes = made;
          at->second.drawable = drawable;
          Q_EMIT changed();
        });
      },
      [this](const QString& text) { kept_->setText(text); });
}

void VoxelPanel::forget_removed() {
  std::erase_if(cubes_, [this](const auto& entry) {
    return std::none_of(store_.models().begin(), store_.models().end(),
                        [&](const Model& model) { return model.data == entry.first; });
  });
}

int VoxelPanel::least_of(const Model& model) const {
  const auto at = cubes_.find(model.data);
  return at != cubes_.end() && at->second.on ? at->second.least : 0;
}

DrawablePtr VoxelPanel::drawable_of(const Model& model) const {
  const auto at = cubes_.find(model.data);
  return at != cubes_.end() && at->second.on ? at->second.drawable : nullptr;
}

std::optional<Legend> VoxelPanel::legend() const {
  const Model* model = store_.find(model_);
  if (!model || !model->visible || !drawable_of(*model)) return std::nullopt;
  const double brightest = cubes_.at(model->data).cubes->brightest();
  if (!(brightest > 0.0)) return std::nullopt;
  Legend legend;
  legend.title = made_of_lines(*model->data) ? tr("Lines through a cell") : tr("Points in a cell");
  legend.continuous = true;
  constexpr int kLabels = 4;
  for (int i = 0; i <= kLabels; ++i)
    legend.entries.push_back(
        {to_color(viridis(double(i) / kLabels)),
         QString::number(brightest * i / kLabels, 'g', 3) + (i == kLabels ? tr(" and more") : "")});
  return legend;
}

}  // namespace turnscan::studio
