#pragma once

namespace turnscan::studio {

class JobRunner;
class ModelList;
class ModelStore;
class SceneView;
class ToolButtons;

/// Services used by the inspection and editing panels; they must outlive the panels.
struct ExplorerParts {
  ModelStore& store;
  ModelList& list;
  SceneView& view;
  JobRunner& jobs;
  ToolButtons& tools;
};

}  // namespace turnscan::studio
