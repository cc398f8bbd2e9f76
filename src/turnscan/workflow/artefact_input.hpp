#pragma once

#include <optional>
#include <string>
#include <turnscan/evaluation/artefact.hpp>

namespace turnscan {

/// The scan of an artefact as measure_artefact() takes it: samples of a mesh, or the points of a
/// cloud (.pcd, or .ply without triangles). Without metres_per_unit the unit is that of the format,
/// of clouds the metre. Fails as read_mesh(), artefact_points() and read_cloud() do.
Result<PointCloud> read_artefact(const std::string& path, std::optional<double> metres_per_unit,
                                 const RunContext& context);

}  // namespace turnscan
