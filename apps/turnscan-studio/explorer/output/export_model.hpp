#pragma once
// Models written the way another program wants them. Nothing here touches a widget.

#include <QString>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/file/up_axis.hpp>

#include "explorer/models.hpp"

namespace turnscan::studio {

/// The mesh with the colours of its texture at its vertices, where several places of the texture
/// meet their mean, and without the texture. Precondition: has_texture(mesh).
TriangleMesh with_vertex_colors(const TriangleMesh& mesh);

enum class ExportColors { kTexture, kVertices, kNone };

struct ExportOptions {
  /// Length of the file's unit. Only where units_are_free(); else the format's.
  double metres_per_unit = 1.0;
  UpAxis up = UpAxis::kFormat;
  std::size_t triangles = 0;  ///< of a mesh, at most; 0: all. Fewer than it has: no texture
  ExportColors colors = ExportColors::kTexture;  ///< of these what mesh and format have
};

/// Whether a format does not say its unit: ply, obj, stl.
bool units_are_free(const std::string& ending);
/// The unit in which write_mesh() and write_cloud() write an ending.
double unit_of_format(const std::string& ending);

/// Fails as simplify(), write_mesh(), write_cloud(); with kUnsupported for a recording; kCancelled.
Result<> export_model(const ModelData& data, const ExportOptions& options, const std::string& path,
                      const RunContext& context);

}  // namespace turnscan::studio
