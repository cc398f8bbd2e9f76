#include <algorithm>
#include <turnscan/reconstruction/method.hpp>
#include <turnscan/reconstruction/options.hpp>

namespace turnscan {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<OptionGroup> describe_stages(ReconstructOptions& o) {
  OptionTable merge = describe(o.merge);
  merge.flag("colour", o.color, "Carry colour to the vertices when the recording has any");
  return {{"crop", describe(o.crop)},
          {"outliers", describe(o.outliers)},
          {"merge", std::move(merge)},
          {"voxels", describe(o.voxels)},
          {"candidates", describe(o.candidates)},
          {"components", describe(o.components)},
          {"normals", describe(o.normals)},
          {"refine", describe(o.refine)},
          {"base", describe(o.base)},
          {"surface", describe(o.surface)},
          {"volumetric", describe(o.volumetric)},
          {"finish", describe(o.finish)}};
}

OptionTable describe(ReconstructOptions& options) {
  OptionTable table;
  for (OptionGroup& stage : describe_stages(options)) table.append(std::move(stage.table));
  return table;
}

std::vector<std::string> unused_options(const ReconstructOptions& options) {
  const MethodEntry& method = method_entry(options.surface.method);
  ReconstructOptions given = options, standard;
  const auto stages = describe_stages(given), defaults = describe_stages(standard);
  std::vector<std::string> names;
  for (std::size_t s = 0; s < stages.size(); ++s) {
    if (contains(method.option_stages, stages[s].name)) continue;
    for (std::size_t f = 0; f < stages[s].table.fields().size(); ++f) {
      const OptionField& field = stages[s].table.fields()[f];
      if (!contains(method.options, field.name) &&
          field.get() != defaults[s].table.fields()[f].get())
        names.push_back(field.name);
    }
  }
  return names;
}

const std::vector<std::string>& saveable_stages() {
  static const std::vector<std::string> stages = [] {
    std::vector<std::string> all;
    for (const MethodEntry& method : methods()) {
      for (const std::string& stage : method.saveable_stages)
        if (!contains(all, stage)) all.push_back(stage);
    }
    return all;
  }();
  return stages;
}

std::vector<std::string> saveable_stages(SurfaceMethod method) {
  return method_entry(method).saveable_stages;
}

}  // namespace turnscan
