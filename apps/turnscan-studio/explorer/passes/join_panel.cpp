#include "explorer/passes/join_panel.hpp"

#include <QComboBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>
#include <turnscan/reconstruction/options.hpp>

#include "app/jobs.hpp"
#include "explorer/inspection/tool_buttons.hpp"
#include "explorer/model_list.hpp"
#include "explorer/passes/pair_tool.hpp"
#include "explorer/passes/pass_meshes.hpp"
#include "explorer/stage_runs.hpp"
#include "view/scene_view.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

/// Share of the mesh's diagonal: the refinement starts at a distance of at most about a twentieth
/// of the object, and clicks that are off by a millimetre rotate less widely spaced pairs by more.
constexpr double kShareOfSize = 0.05;

/// As a model on which a stage can be run.
Model recording_of(const PassesOfMesh& passes) {
  Model model;
  model.name = QFileInfo(passes.recording->source).fileName();
  model.data = passes.recording;
  return model;
}

bool has_any_of(const PassesOfMesh& passes, const PassesOfMesh& wanted) {
  return std::any_of(wanted.T_mesh_table.begin(), wanted.T_mesh_table.end(),
                     [&](const auto& pass) { return passes.T_mesh_table.count(pass.first) > 0; });
}

/// The two newest that can be joined, the one with the earliest pass first.
std::pair<const Model*, const Model*> newest_pair(const std::vector<const Model*>& meshes) {
  for (auto a = meshes.rbegin(); a != meshes.rend(); ++a)
    for (auto b = a + 1; b != meshes.rend(); ++b) {
      const PassesOfMesh &one = *(*a)->data->passes, &other = *(*b)->data->passes;
      if (!can_be_joined(one, other)) continue;
      const bool earlier = one.T_mesh_table.begin()->first < other.T_mesh_table.begin()->first;
      return earlier ? std::pair(*a, *b) : std::pair(*b, *a);
    }
  return {};
}

}  // namespace

JoinPanel::JoinPanel(const ExplorerParts& parts, Options options, QWidget* parent)
    : QWidget(parent), parts_(parts), options_(std::move(options)) {
  tool_ = std::make_unique<PairTool>(parts_.view, [this] { show_pairs(); });
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(make_choice());
  text_ = quiet_label({}, this);
  text_->setObjectName("join_text");
  layout->addWidget(text_);
  layout->addWidget(make_buttons());
  error_ = new MessageLabel(this);
  layout->addWidget(error_);
  parts_.tools.add(pick_, tool_.get(), [this](bool on) { switch_picking(on); });
  connect(undo_, &QPushButton::clicked, this, [this] { tool_->undo(); });
  connect(join_, &QPushButton::clicked, this, &JoinPanel::join);
  connect(apart_, &QPushButton::clicked, this, &JoinPanel::take_apart);
  connect(&parts_.store, &ModelStore::changed, this, &JoinPanel::fill);
  connect(&parts_.list, &ModelList::selection_changed, this, &JoinPanel::show_pairs);
  fill();
}

JoinPanel::~JoinPanel() = default;

QWidget* JoinPanel::make_choice() {
  auto* box = new QWidget(this);
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setColumnStretch(1, 1);
  fixed_ = new QComboBox(box);
  moved_ = new QComboBox(box);
  fixed_->setObjectName("join_fixed");
  moved_->setObjectName("join_moved");
  fixed_->setAccessibleName(tr("Mesh so far"));
  moved_->setAccessibleName(tr("New pass"));
  for (QComboBox* each : {fixed_, moved_}) {
    each->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    leave_wheel_to_panel(each);
    connect(each, qOverload<int>(&QComboBox::activated), this, [this] {
      parts_.tools.stop();
      show_pairs();
    });
  }
  grid->addWidget(new QLabel(tr("Mesh so far"), box), 0, 0);
  grid->addWidget(fixed_, 0, 1);
  grid->addWidget(new QLabel(tr("New pass"), box), 1, 0);
  grid->addWidget(moved_, 1, 1);
  return box;
}

QWidget* JoinPanel::make_buttons() {
  auto* box = new QWidget(this);
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  pick_ = button(tr("Pick pairs"), tr("Click at least three places, each on both meshes"), box);
  undo_ = button(tr("Undo click"), tr("Take the last click back"), box);
  join_ = button(tr("Join"),
                 tr("Bring the new pass there, refine its place by the surfaces, and make one mesh "
                    "of all passes; refused where the surfaces contradict it"),
                 box);
  apart_ =
      button(tr("Each pass by itself"),
             tr("Make a mesh of each pass of the selected joined one, to join them anew"), box);
  pick_->setObjectName("join_pick");
  undo_->setObjectName("join_undo");
  join_->setObjectName("join_run");
  apart_->setObjectName("join_apart");
  grid->addWidget(pick_, 0, 0);
  grid->addWidget(undo_, 0, 1);
  grid->addWidget(join_, 0, 2);
  grid->addWidget(apart_, 1, 0, 1, 3);
  return box;
}

const Model* JoinPanel::chosen(const QComboBox* box) const {
  const Model* model = parts_.store.find(box->currentData().toInt());
  // An edit removes the passes from a mesh before the boxes are refilled.
  return model && model->data->passes ? model : nullptr;
}

const Model* JoinPanel::fixed() const { return chosen(fixed_); }

const Model* JoinPanel::moved() const { return chosen(moved_); }

bool JoinPanel::is_picking() const { return pick_->isChecked(); }

bool JoinPanel::is_pair() const {
  const Model *a = fixed(), *b = moved();
  return a && b && can_be_joined(*a->data->passes, *b->data->passes);
}

void JoinPanel::fill() {
  std::vector<const Model*> meshes;
  for (const Model& model : parts_.store.models())
    if (model.data->passes) meshes.push_back(&model);
  const std::pair before(fixed_->currentData().toInt(), moved_->currentData().toInt());
  for (QComboBox* box : {fixed_, moved_}) {
    box->clear();
    for (const Model* model : meshes) box->addItem(model->name, model->id);
  }
  fixed_->setCurrentIndex(fixed_->findData(before.first));
  moved_->setCurrentIndex(moved_->findData(before.second));
  if (meshes.size() > known_ || !is_pair()) {
    const auto [a, b] = newest_pair(meshes);
    fixed_->setCurrentIndex(a ? fixed_->findData(a->id) : 0);
    moved_->setCurrentIndex(b ? moved_->findData(b->id) : 0);
  }
  known_ = meshes.size();
  // The points are on meshes that no longer exist.
  if (is_picking() &&
      before != std::pair(fixed_->currentData().toInt(), moved_->currentData().toInt()))
    parts_.tools.stop();
  show_pairs();
}

void JoinPanel::switch_picking(bool on) {
  error_->show_text({});
  tool_->clear();
  Q_EMIT changed();
  if (on) parts_.view.reset_camera();
}

void JoinPanel::show_pairs() {
  const Model* selected = parts_.store.find(parts_.list.selected());
  apart_->setEnabled(selected && selected->data->passes &&
                     selected->data->passes->T_mesh_table.size() > 1);
  pick_->setEnabled(is_pair());
  undo_->setEnabled(!tool_->empty());
  fit_.reset();
  if (!is_picking() || !is_pair()) {
    text_->setText(is_pair()
                       ? tr("Where a pass was not joined, or wrongly, pairs of places on both "
                            "meshes say how it lay.")
                       : tr("Choose meshes of different passes of one recording."));
    join_->setEnabled(false);
    return;
  }
  const auto pairs = tool_->pairs();
  const std::size_t left = tool_->places(0), right = tool_->places(1);
  QString text = left == right  ? tr("Pair %1: click the same place on both.").arg(left + 1)
                 : left > right ? tr("Pair %1: click it on the right, too.").arg(right + 1)
                                : tr("Pair %1: click it on the left, too.").arg(left + 1);
  if (pairs.size() >= 3) {
    const double size = box_of(*fixed()->data->drawable).size().norm();
    auto fit = fit_point_pairs(pairs, {kShareOfSize * size, kShareOfSize * size});
    error_->show_text(fit ? QString() : QString::fromStdString(fit.error().text()));
    if (fit) {
      text = tr("%1 pairs, which fit within %2 mm (rms). Join, or click more.")
                 .arg(pairs.size())
                 .arg(1e3 * fit->rms_m, 0, 'f', 2);
      fit_ = std::move(*fit);
    }
  } else {
    error_->show_text({});
  }
  text_->setText(text);
  join_->setEnabled(fit_.has_value());
}

void JoinPanel::join() {
  const Model *onto = fixed(), *added = moved();
  auto options = options_();
  error_->show_text(options ? QString() : QString::fromStdString(options.error().text()));
  if (!onto || !added || !fit_ || !options) return;
  parts_.jobs.start(
      tr("Join"), this,
      [this, a = *onto, b = *added, T = fit_->T_target_source,
       options = std::move(*options)](const RunContext& context) -> Result<Finish> {
        const PassesOfMesh &so_far = *a.data->passes, &more = *b.data->passes;
        TURNSCAN_ASSIGN(const auto poses, poses_of_passes(so_far, more, T));
        TURNSCAN_ASSIGN(StageRun run, join_stated(recording_of(so_far), poses, options, context));
        // Passes that are still separate already have models.
        std::erase_if(run.models, [&](const auto& made) {
          const PassesPtr& passes = made.second->passes;
          return !passes || !has_any_of(*passes, so_far) || !has_any_of(*passes, more);
        });
        if (run.models.empty())
          return fail(ErrorCode::kMissingData, "{}", run.not_joined.toStdString());
        return Finish([this, a, b, run = std::move(run)] {
          parts_.tools.stop();
          parts_.list.select(
              parts_.store.add_made(run.models, run.made, tr("join by points")).front());
          Q_EMIT said(tr("%1 and %2 are one mesh now").arg(a.name, b.name));
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

void JoinPanel::take_apart() {
  const Model* selected = parts_.store.find(parts_.list.selected());
  auto options = options_();
  error_->show_text(options ? QString() : QString::fromStdString(options.error().text()));
  if (!selected || !selected->data->passes || !options) return;
  parts_.jobs.start(
      tr("Each pass by itself"), this,
      [this, from = *selected,
       options = std::move(*options)](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(StageRun run,
                        mesh_each_pass(recording_of(*from.data->passes), options, context));
        return Finish([this, run = std::move(run)] {
          parts_.list.select(
              parts_.store.add_made(run.models, run.made, tr("passes by themselves")).front());
          if (!run.not_joined.isEmpty()) error_->show_text(run.not_joined);
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

}  // namespace turnscan::studio
