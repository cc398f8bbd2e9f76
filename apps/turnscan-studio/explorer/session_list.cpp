#include "explorer/session_list.hpp"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>

namespace turnscan::studio {

namespace {

QJsonArray json_of(const std::vector<ResolvedParameter>& options) {
  QJsonArray out;
  for (const ResolvedParameter& option : options)
    out.append(QJsonArray{QString::fromStdString(option.option),
                          QString::fromStdString(option.value),
                          QString::fromStdString(option.reason)});
  return out;
}

std::vector<ResolvedParameter> options_of(const QJsonValue& value) {
  std::vector<ResolvedParameter> out;
  for (const QJsonValue& each : value.toArray()) {
    const QJsonArray option = each.toArray();
    out.push_back({option.at(0).toString().toStdString(), option.at(1).toString().toStdString(),
                   option.at(2).toString().toStdString()});
  }
  return out;
}

QJsonObject json_of(const KeptModel& model) {
  QJsonObject entry{{"id", model.id},
                    {"name", model.name},
                    {"file", model.file},
                    {"in_own_file", model.in_own_file},
                    {"place_in_file", model.place_in_file},
                    {"visible", model.visible},
                    {"own_colors", model.own_colors},
                    {"color", model.color.name()},
                    {"opacity", model.opacity}};
  if (model.metres_per_unit) entry["metres_per_unit"] = *model.metres_per_unit;
  if (model.own) entry["own"] = true;
  if (model.made.input != 0)
    entry["made"] = QJsonObject{{"input", model.made.input},
                                {"stage", QString::fromStdString(model.made.stage)},
                                {"changed", json_of(model.made.changed)},
                                {"chosen", json_of(model.made.chosen)}};
  return entry;
}

KeptModel model_of(const QJsonObject& entry, const QString& folder) {
  KeptModel model;
  model.id = entry.value("id").toInt();
  model.name = entry.value("name").toString();
  model.file = entry.value("file").toString();
  model.in_own_file = entry.value("in_own_file").toBool();
  // The session's own files are in its folder.
  if (!model.in_own_file) model.file = QDir(folder).filePath(QFileInfo(model.file).fileName());
  model.place_in_file = std::max(0, entry.value("place_in_file").toInt());
  model.visible = entry.value("visible").toBool(true);
  model.own_colors = entry.value("own_colors").toBool(true);
  model.color = QColor(entry.value("color").toString());
  model.opacity = std::clamp(entry.value("opacity").toDouble(1.0), 0.0, 1.0);
  if (const double unit = entry.value("metres_per_unit").toDouble(); unit > 0.0)
    model.metres_per_unit = unit;
  model.own = entry.value("own").toBool();
  const QJsonObject made = entry.value("made").toObject();
  model.made = {made.value("input").toInt(), made.value("stage").toString().toStdString(),
                options_of(made.value("changed")), options_of(made.value("chosen"))};
  return model;
}

/// One byte per triangle, most of them equal to the previous one.
QString packed(const Selection& selection) {
  const QByteArray bytes(reinterpret_cast<const char*>(selection.data()), int(selection.size()));
  return QString::fromLatin1(qCompress(bytes).toBase64());
}

Selection unpacked(const QString& text) {
  const QByteArray bytes = qUncompress(QByteArray::fromBase64(text.toLatin1()));
  return Selection(bytes.begin(), bytes.end());
}

QJsonObject json_of(const KeptState& state) {
  QJsonArray models;
  for (const KeptModel& model : state.models) models.append(json_of(model));
  QJsonObject entry{{"what", state.what}, {"models", models}};
  if (state.selected_model >= 0) {
    entry["selected_model"] = state.selected_model;
    entry["selected"] = packed(state.selected);
  }
  return entry;
}

KeptState state_of(const QJsonObject& entry, const QString& folder) {
  KeptState state;
  state.what = entry.value("what").toString();
  for (const QJsonValue& model : entry.value("models").toArray())
    state.models.push_back(model_of(model.toObject(), folder));
  state.selected_model = entry.value("selected_model").toInt(-1);
  if (state.selected_model >= int(state.models.size())) state.selected_model = -1;
  if (state.selected_model >= 0) state.selected = unpacked(entry.value("selected").toString());
  return state;
}

QJsonArray json_of(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

Vec3d vector_of(const QJsonValue& value) {
  const QJsonArray list = value.toArray();
  return {list.at(0).toDouble(), list.at(1).toDouble(), list.at(2).toDouble()};
}

}  // namespace

QByteArray list_text(const KeptList& list) {
  QJsonArray states;
  for (const KeptState& state : list.states) states.append(json_of(state));
  QJsonObject all{{"states", states}, {"place", int(list.place)}, {"chosen", list.chosen}};
  if (list.camera)
    all["camera"] = QJsonArray{json_of(list.camera->position), json_of(list.camera->focus),
                               json_of(list.camera->up)};
  return QJsonDocument(all).toJson(QJsonDocument::Compact);
}

KeptList read_list(const QString& folder) {
  KeptList out;
  QFile file(QDir(folder).filePath(kSessionList));
  if (!file.open(QIODevice::ReadOnly)) return out;
  const QJsonObject all = QJsonDocument::fromJson(file.readAll()).object();
  for (const QJsonValue& state : all.value("states").toArray())
    out.states.push_back(state_of(state.toObject(), folder));
  const int place = all.value("place").toInt(-1);
  if (place < 0 || place >= int(out.states.size())) return {};
  out.place = std::size_t(place);
  out.chosen = all.value("chosen").toInt();
  if (const QJsonArray camera = all.value("camera").toArray(); camera.size() == 3) {
    const CameraPlace at{vector_of(camera[0]), vector_of(camera[1]), vector_of(camera[2])};
    if ((at.position - at.focus).norm() > 1e-6 && at.up.norm() > 1e-6) out.camera = at;
  }
  return out;
}

}  // namespace turnscan::studio
