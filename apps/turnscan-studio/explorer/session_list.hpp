#pragma once
// What a session keeps of its models, as it stands in its file.

#include <QByteArray>
#include <QColor>
#include <QString>
#include <optional>
#include <turnscan/geometry/selection/selection.hpp>
#include <vector>

#include "view/scene_view.hpp"

namespace turnscan::studio {

/// A model as a session keeps it.
struct KeptModel {
  int id = 0;
  QString name, file;
  bool in_own_file = false;  ///< a file of the person's; else one of the session's
  int place_in_file = 0;     ///< of several models in a file
  bool visible = true, own_colors = true;
  QColor color;
  double opacity = 1.0;
  std::optional<double> metres_per_unit = std::nullopt;  ///< of its own file, if it was told
};

/// A state of the models, and what was done next.
struct KeptState {
  QString what;
  std::vector<KeptModel> models;
  int selected_model = -1;  ///< of them, of which a part is selected
  Selection selected;
};

/// All states that undo and redo lead to.
struct KeptList {
  std::vector<KeptState> states;
  std::size_t place = 0;  ///< of the state that the models were in
  int chosen = 0;         ///< id of the model that was chosen
  std::optional<CameraPlace> camera;
};

QByteArray list_text(const KeptList& list);
/// Of a session's folder. Without states where it is damaged or missing; what is damaged in a state
/// is left out.
KeptList read_list(const QString& folder);

inline constexpr const char* kSessionList = "session.json";

}  // namespace turnscan::studio
