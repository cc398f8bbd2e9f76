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
          {"finish", describe(o.finish)},
          {"texture", describe(o.texture)}};
}

OptionTable describe(ReconstructOptions& options) {
  OptionTable table;
  for (OptionGroup& stage : describe_stages(options)) table.append(std::move(stage.table));
  return table;
}

std::vector<std::string> options_of_others(SurfaceMethod method) {
  const MethodEntry& entry = method_entry(method);
  ReconstructOptions standard;
  std::vector<std::string> names;
  for (const OptionGroup& stage : describe_stages(standard)) {
    if (contains(entry.option_stages, stage.name)) continue;
    for (const OptionField& field : stage.table.fields())
      if (!contains(entry.options, field.name)) names.push_back(field.name);
  }
  return names;
}

std::vector<std::string> unused_options(const ReconstructOptions& options) {
  ReconstructOptions given = options, standard;
  const OptionTable table = describe(given), defaults = describe(standard);
  std::vector<std::string> names = options_of_others(options.surface.method);
  std::erase_if(names, [&](const std::string& name) {
    return table.find(name)->get() == defaults.find(name)->get();
  });
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
