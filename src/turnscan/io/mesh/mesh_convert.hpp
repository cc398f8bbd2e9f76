#pragma once
// Reading a mesh in a process of its own.

#include <filesystem>
#include <optional>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::mesh_io {

inline constexpr const char* kMeshConverter = "turnscan-mesh-convert";
inline constexpr double kMaxConvertSeconds = 60.0;

/// Meshes in metres, as the program turnscan-mesh-convert reads them: it may crash, hang or run
/// out of memory, and then this fails with kFormat or kResourceLimit. Fails with kMissingData where
/// find_helper_program() does not find the program.
Result<std::vector<TriangleMesh>> read_in_child(const std::filesystem::path& path,
                                                std::optional<double> metres_per_unit,
                                                const RunContext& ctx,
                                                double seconds = kMaxConvertSeconds);

}  // namespace turnscan::mesh_io
