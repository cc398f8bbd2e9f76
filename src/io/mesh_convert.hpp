#pragma once
// Reading a mesh in a process of its own. Not installed.

#include <filesystem>
#include <optional>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::detail {

inline constexpr const char* kMeshConverter = "turnscan-mesh-convert";
inline constexpr double kMaxConvertSeconds = 60.0;

/// Meshes in metres, as the program turnscan-mesh-convert reads them: it may crash, hang or run
/// out of memory, and then this fails with kFormat or kResourceLimit. The program is looked for in
/// the folder that the environment names (TURNSCAN_LIBEXEC), then near the running executable
/// (libexec/turnscan of the installation, or the build tree), then where it was to be installed;
/// fails with kMissingData where it is in none of them.
Result<std::vector<TriangleMesh>> read_in_child(const std::filesystem::path& path,
                                                std::optional<double> metres_per_unit,
                                                const RunContext& ctx,
                                                double seconds = kMaxConvertSeconds);

}  // namespace turnscan::detail
