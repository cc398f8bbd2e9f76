#pragma once
// Files as models. Nothing here touches a widget.

#include <optional>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <utility>
#include <vector>

#include "explorer/models.hpp"

namespace turnscan::studio {

using NamedModels = std::vector<std::pair<QString, ModelDataPtr>>;

/// A mesh (each object a model), a cloud, a recording's folder or recording.json, or what `turnscan
/// import` reads without being told more, told apart as `turnscan info` does. metres_per_unit: of a
/// mesh or cloud; nullopt: that of its format (see read_meshes(); clouds are in metres). Fails as
/// the readers do.
Result<NamedModels> load_models(const std::string& path, const RunContext& context,
                                std::optional<double> metres_per_unit = std::nullopt);

ModelDataPtr mesh_model(TriangleMesh mesh, const QString& source, const QString& report = {},
                        std::vector<float> confidence = {});
ModelDataPtr cloud_model(PointCloud cloud, const QString& source, const QString& report = {},
                         std::vector<Viewpoint> viewpoints = {});
/// path: see open_input().
Result<ModelDataPtr> recording_model(const std::string& path, const RunContext& context);

/// Meshes in every format of write_mesh; clouds as PLY. Where a format keeps colours of vertices
/// but no texture, they take the texture's. Fails as the writers do.
Result<> save_model(const ModelData& data, const std::string& path);

}  // namespace turnscan::studio
