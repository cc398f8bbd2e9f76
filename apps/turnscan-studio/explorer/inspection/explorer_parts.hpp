#pragma once

namespace turnscan::studio {

class JobRunner;
class ModelList;
class ModelStore;
class SceneView;
class ToolButtons;

/// Services used by inspection and editing; they outlive all of these.
struct ExplorerParts {
  ModelStore& store;
  ModelList& list;
  SceneView& view;
  JobRunner& jobs;
  ToolButtons& tools;
};

}  // namespace turnscan::studio
