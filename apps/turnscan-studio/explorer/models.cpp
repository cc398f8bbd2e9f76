#include "explorer/models.hpp"

#include <QFileInfo>
#include <algorithm>

#include "widgets/text.hpp"
#include "widgets/theme.hpp"

namespace turnscan::studio {

namespace {

constexpr std::size_t kModelUndoSteps = 100;

/// Also of a recording that was read again because it got another pass.
bool is_same_input(const ModelData& one, const ModelData& other) {
  return &one == &other ||
         (one.kind == ModelKind::kRecording && other.kind == ModelKind::kRecording &&
          QFileInfo(one.source) == QFileInfo(other.source));
}

}  // namespace

QString count_text(const ModelData& data) {
  switch (data.kind) {
    case ModelKind::kMesh:
      return QObject::tr("%1 triangles").arg(grouped(data.mesh.triangles.size()));
    case ModelKind::kCloud:
      return QObject::tr("%1 points").arg(grouped(data.cloud.size()));
    case ModelKind::kRecording:
      break;
  }
  // Written and dropped frames, counted as in the Scanner.
  std::size_t written = 0, dropped = 0;
  if (data.recording)
    for (const FrameInfo& info : data.recording->frames())
      ++(info.status == FrameStatus::kDropped ? dropped : written);
  const QString text = QObject::tr("%1 frames").arg(grouped(written));
  return dropped == 0 ? text : QObject::tr("%1, %2 dropped").arg(text, grouped(dropped));
}

std::optional<std::uint32_t> only_pass(const ModelData& data) {
  if (!data.passes || data.passes->T_mesh_table.size() != 1) return std::nullopt;
  return data.passes->T_mesh_table.begin()->first;
}

const Model* input_of(const Model& model, const std::vector<Model>& among) {
  if (!model.made) return nullptr;
  const auto find_if = [&](auto is_it) {
    const auto at = std::find_if(among.begin(), among.end(), is_it);
    return at == among.end() ? nullptr : &*at;
  };
  const auto* same = find_if([&](const Model& m) { return m.data == model.made->input; });
  return same ? same : find_if([&](const Model& m) {
    return !m.made && is_same_input(*m.data, *model.made->input);
  });
}

const Model* ModelStore::find(int id) const {
  const auto at =
      std::find_if(models_.begin(), models_.end(), [&](const Model& m) { return m.id == id; });
  return at == models_.end() ? nullptr : &*at;
}

Model* ModelStore::mutable_find(int id) { return const_cast<Model*>(find(id)); }

QString ModelStore::free_name(const QString& wanted) const {
  const auto taken = [&](const QString& name) {
    return std::any_of(models_.begin(), models_.end(),
                       [&](const Model& m) { return m.name == name; });
  };
  QString name = wanted;
  for (int i = 2; taken(name); ++i) name = QString("%1 (%2)").arg(wanted).arg(i);
  return name;
}

void ModelStore::step(const QString& what) {
  undo_.push_back({what, models_, selected_});
  if (undo_.size() > kModelUndoSteps) undo_.erase(undo_.begin());
  redo_.clear();
}

int ModelStore::add(const QString& name, ModelDataPtr data) {
  return add_all({{name, std::move(data)}}, tr("add %1").arg(name)).front();
}

std::vector<Model> ModelStore::as_models(
    const std::vector<std::pair<QString, ModelDataPtr>>& made) {
  std::vector<Model> models;
  for (const auto& [name, data] : made) {
    Model model;
    model.name = name;
    model.data = data;
    model.color = model_color(next_color_++);
    models.push_back(std::move(model));
  }
  return models;
}

std::vector<int> ModelStore::add_all(const std::vector<std::pair<QString, ModelDataPtr>>& made,
                                     const QString& what) {
  return add_models(as_models(made), what);
}

std::vector<int> ModelStore::append(std::vector<Model> models) {
  std::vector<int> ids;
  for (Model& model : models) {
    model.id = next_id_++;
    model.name = free_name(model.name);
    ids.push_back(model.id);
    models_.push_back(std::move(model));
  }
  return ids;
}

std::vector<int> ModelStore::add_models(std::vector<Model> models, const QString& what) {
  step(what);
  const std::vector<int> ids = append(std::move(models));
  Q_EMIT changed();
  return ids;
}

std::vector<int> ModelStore::add_instead(const std::vector<std::pair<QString, ModelDataPtr>>& made,
                                         const std::vector<int>& hidden, const QString& what) {
  step(what);
  const std::vector<int> ids = append(as_models(made));
  for (const int id : hidden)
    if (Model* model = mutable_find(id)) model->visible = false;
  Q_EMIT changed();
  return ids;
}

std::vector<int> ModelStore::add_made(const std::vector<std::pair<QString, ModelDataPtr>>& results,
                                      const MadeWithPtr& made, const QString& what) {
  step(what);
  std::vector<int> ids, before;
  for (Model& model : models_) {
    if (model.data != made->input &&
        !(model.made && is_same_input(*model.made->input, *made->input)))
      continue;
    model.visible = false;
    if (model.made && model.made->stage == made->stage && !model.own) before.push_back(model.id);
  }
  for (Model& model : as_models(results)) {
    const auto same = std::find_if(before.begin(), before.end(), [&](int id) {
      return only_pass(*find(id)->data) == only_pass(*model.data);
    });
    model.made = made;
    if (same == before.end()) {
      ids.push_back(append({model}).front());
      continue;
    }
    Model& replaced = *mutable_find(*same);
    replaced.data = model.data;
    replaced.made = made;
    replaced.visible = true;
    ids.push_back(*same);
    before.erase(same);
  }
  // A run before may have made more objects.
  std::erase_if(models_, [&](const Model& model) {
    return std::find(before.begin(), before.end(), model.id) != before.end() &&
           std::any_of(results.begin(), results.end(), [&](const auto& result) {
             return only_pass(*result.second) == only_pass(*model.data);
           });
  });
  drop_stale_selection();
  Q_EMIT changed();
  return ids;
}

void ModelStore::rename(int id, const QString& name) {
  const Model* model = find(id);
  const QString wanted = name.trimmed();
  if (!model || wanted.isEmpty() || model->name == wanted) return;
  step(tr("rename"));
  mutable_find(id)->name = free_name(wanted);
  Q_EMIT changed();
}

void ModelStore::set_visible(int id, bool visible) {
  const Model* model = find(id);
  if (!model || model->visible == visible) return;
  step(visible ? tr("show") : tr("hide"));
  mutable_find(id)->visible = visible;
  Q_EMIT changed();
}

void ModelStore::set_color(int id, const QColor& color, bool own_colors) {
  if (!find(id)) return;
  step(tr("colour"));
  Model* model = mutable_find(id);
  model->color = color;
  model->own_colors = own_colors;
  Q_EMIT changed();
}

void ModelStore::set_opacity(int id, double opacity) {
  const Model* model = find(id);
  if (!model || model->opacity == opacity) return;
  const QString what = tr("opacity of %1").arg(model->name);
  if (undo_.empty() || undo_.back().what != what || !redo_.empty()) step(what);
  mutable_find(id)->opacity = opacity;
  Q_EMIT changed();
}

void ModelStore::set_data(int id, ModelDataPtr data, const QString& what) {
  if (!find(id)) return;
  step(what);
  mutable_find(id)->data = std::move(data);
  mutable_find(id)->own = true;
  drop_stale_selection();
  Q_EMIT changed();
}

void ModelStore::renew(int id, ModelDataPtr data, const std::vector<int>& hidden,
                       const QString& what) {
  if (!find(id)) return;
  step(what);
  for (const int other : hidden)
    if (Model* model = mutable_find(other)) model->visible = false;
  Model& renewed = *mutable_find(id);
  renewed.data = std::move(data);
  renewed.visible = true;
  drop_stale_selection();
  Q_EMIT changed();
}

void ModelStore::drop_stale_selection() {
  const auto is_of = [&](const Model& model) { return model.data == selected_.of; };
  if (std::none_of(models_.begin(), models_.end(), is_of)) selected_ = {};
}

void ModelStore::select_parts(SelectedParts selected, const QString& what) {
  if (!selected.drawable && !selected_.drawable) return;
  step(what);
  selected_ = std::move(selected);
  Q_EMIT changed();
}

void ModelStore::duplicate(int id) {
  const Model* model = find(id);
  if (!model) return;
  Model copy = *model;
  step(tr("duplicate"));
  copy.own = true;
  copy.id = next_id_++;
  copy.name = free_name(copy.name);
  copy.color = model_color(next_color_++);
  models_.push_back(std::move(copy));
  Q_EMIT changed();
}

void ModelStore::remove(int id) {
  if (!find(id)) return;
  step(tr("delete"));
  std::erase_if(models_, [&](const Model& m) { return m.id == id; });
  drop_stale_selection();
  Q_EMIT changed();
}

void ModelStore::set_file(const ModelDataPtr& data, const QString& file) {
  std::erase_if(files_, [&](const auto& known) {
    const auto there = known.first.lock();
    return !there || there == data;
  });
  files_.emplace_back(data, file);
  Q_EMIT changed();
}

QString ModelStore::file_of(const ModelData& data) const {
  if (data.kind == ModelKind::kRecording) return data.source;
  for (const auto& [known, file] : files_)
    if (known.lock().get() == &data) return file;
  return {};
}

QStringList ModelStore::unsaved() const {
  QStringList out;
  for (const Model& model : models_)
    if (file_of(*model.data).isEmpty()) out << model.name;
  return out;
}

void ModelStore::step_back() {
  redo_.push_back({undo_.back().what, std::move(models_), std::move(selected_)});
  models_ = std::move(undo_.back().models);
  selected_ = std::move(undo_.back().selected);
  undo_.pop_back();
}

void ModelStore::step_forward() {
  undo_.push_back({redo_.back().what, std::move(models_), std::move(selected_)});
  models_ = std::move(redo_.back().models);
  selected_ = std::move(redo_.back().selected);
  redo_.pop_back();
}

void ModelStore::undo() {
  if (undo_.empty()) return;
  step_back();
  Q_EMIT changed();
}

void ModelStore::redo() {
  if (redo_.empty()) return;
  step_forward();
  Q_EMIT changed();
}

QStringList ModelStore::history() const {
  QStringList out;
  for (const ModelState& state : undo_) out << state.what;
  for (auto state = redo_.rbegin(); state != redo_.rend(); ++state) out << state->what;
  return out;
}

void ModelStore::go_to(std::size_t place) {
  const std::size_t before = undo_.size();
  while (undo_.size() > place) step_back();
  while (undo_.size() < place && !redo_.empty()) step_forward();
  if (undo_.size() != before) Q_EMIT changed();
}

std::vector<ModelState> ModelStore::states() const {
  std::vector<ModelState> out = undo_;
  // A redo step is named by what leads to it; a state, by what leads away from it.
  QString next = redo_.empty() ? QString() : redo_.back().what;
  out.push_back({next, models_, selected_});
  for (auto state = redo_.rbegin(); state != redo_.rend(); ++state) {
    next = state + 1 == redo_.rend() ? QString() : (state + 1)->what;
    out.push_back({next, state->models, state->selected});
  }
  return out;
}

void ModelStore::set_states(std::vector<ModelState> states, std::size_t place) {
  undo_.assign(states.begin(), states.begin() + std::ptrdiff_t(place));
  redo_.clear();
  for (std::size_t i = states.size() - 1; i > place; --i) {
    states[i].what = states[i - 1].what;
    redo_.push_back(std::move(states[i]));
  }
  models_ = std::move(states[place].models);
  selected_ = std::move(states[place].selected);
  for (const ModelState& state : this->states())
    for (const Model& model : state.models) next_id_ = std::max(next_id_, model.id + 1);
  next_color_ = next_id_ - 1;
  Q_EMIT changed();
}

}  // namespace turnscan::studio
