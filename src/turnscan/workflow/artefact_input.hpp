#pragma once

#include <optional>
#include <string>
#include <turnscan/evaluation/artefact.hpp>

namespace turnscan {

/// Reads the scan of an artefact for measure_artefact(): samples of a mesh, or the points of a
/// cloud (.pcd, or .ply without triangles). Without metres_per_unit the unit is the format's, or
/// metres for clouds. Fails as read_mesh(), artefact_points() and read_cloud() do.
Result<PointCloud> read_artefact(const std::string& path, std::optional<double> metres_per_unit,
                                 const RunContext& context);

}  // namespace turnscan
