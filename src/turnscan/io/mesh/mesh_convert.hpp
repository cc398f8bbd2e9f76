#pragma once
// Reads a mesh in a separate process.

#include <filesystem>
#include <optional>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::mesh_io {

inline constexpr const char* kMeshConverter = "turnscan-mesh-convert";
inline constexpr double kMaxConvertSeconds = 60.0;

/// Reads meshes in metres through the program turnscan-mesh-convert: if it crashes, hangs or runs
/// out of memory, this fails with kFormat or kResourceLimit. Fails with kMissingData if
/// find_helper_program() does not find the program.
Result<std::vector<TriangleMesh>> read_in_child(const std::filesystem::path& path,
                                                std::optional<double> metres_per_unit,
                                                const RunContext& ctx,
                                                double seconds = kMaxConvertSeconds);

}  // namespace turnscan::mesh_io
