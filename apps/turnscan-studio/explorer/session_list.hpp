#pragma once
// The models of a session as stored in its file.

#include <QByteArray>
#include <QColor>
#include <QString>
#include <optional>
#include <turnscan/geometry/selection/selection.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <vector>

#include "view/scene_view.hpp"

namespace turnscan::studio {

/// What made a model; see MadeWith.
struct KeptOrigin {
  int input = 0;  ///< id of a model of the same state; 0: it was not made from one
  std::string stage;
  std::vector<ResolvedParameter> changed, chosen;
};

/// A model as stored in a session.
struct KeptModel {
  int id = 0;
  QString name, file;
  bool in_own_file = false;  ///< a file of the user; else one of the session
  int place_in_file = 0;     ///< index among several models in a file
  bool visible = true, own_colors = true;
  QColor color;
  double opacity = 1.0;
  std::optional<double> metres_per_unit = std::nullopt;  ///< of its own file, if specified
  KeptOrigin made = {};
  bool own = false;  ///< as of Model
};

/// A state of the models, and the next action.
struct KeptState {
  QString what;
  std::vector<KeptModel> models;
  int selected_model = -1;  ///< index of the model with a selected part
  Selection selected;
};

/// All undo and redo states.
struct KeptList {
  std::vector<KeptState> states;
  std::size_t place = 0;  ///< index of the current state
  int chosen = 0;         ///< id of the selected model
  std::optional<CameraPlace> camera;
};

QByteArray list_text(const KeptList& list);
/// Reads the list in a session's folder. Has no states if it is damaged or missing; damaged parts
/// of a state are skipped.
KeptList read_list(const QString& folder);

inline constexpr const char* kSessionList = "session.json";

}  // namespace turnscan::studio
