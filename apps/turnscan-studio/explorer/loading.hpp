#pragma once
// Loads files as models. Nothing here touches a widget.

#include <optional>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <utility>
#include <vector>

#include "explorer/models.hpp"

namespace turnscan::studio {

using NamedModels = std::vector<std::pair<QString, ModelDataPtr>>;

/// Loads a mesh (each object becomes a model), a cloud, a recording's folder or recording.json, or
/// data that `turnscan import` reads without options, distinguished as by `turnscan info`.
/// metres_per_unit: of a mesh or cloud; nullopt: that of its format (see read_meshes(); clouds are
/// in metres). Fails as the readers do.
Result<NamedModels> load_models(const std::string& path, const RunContext& context,
                                std::optional<double> metres_per_unit = std::nullopt);

ModelDataPtr mesh_model(TriangleMesh mesh, const QString& source, const QString& report = {},
                        std::vector<float> confidence = {});
ModelDataPtr cloud_model(PointCloud cloud, const QString& source, const QString& report = {},
                         std::vector<Viewpoint> viewpoints = {});
/// path: see open_input().
Result<ModelDataPtr> recording_model(const std::string& path, const RunContext& context);

/// Saves meshes in every format of write_mesh; clouds as PLY. If a format supports vertex colours
/// but no texture, vertices take the texture's colours. Fails as the writers do.
Result<> save_model(const ModelData& data, const std::string& path);

}  // namespace turnscan::studio
