#pragma once

namespace turnscan::studio {

class JobRunner;
class ModelList;
class ModelStore;
class SceneView;
class ToolButtons;

/// What inspection and editing work with; all outlive them.
struct ExplorerParts {
  ModelStore& store;
  ModelList& list;
  SceneView& view;
  JobRunner& jobs;
  ToolButtons& tools;
};

}  // namespace turnscan::studio
