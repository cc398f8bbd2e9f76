#pragma once
// Writes models with the conventions of other programs. Nothing here touches a widget.

#include <QString>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/file/up_axis.hpp>

#include "explorer/models.hpp"

namespace turnscan::studio {

/// The mesh without its texture but with the texture's colours at its vertices, averaged where a
/// vertex has several texture coordinates. Precondition: has_texture(mesh).
TriangleMesh with_vertex_colors(const TriangleMesh& mesh);

enum class ExportColors { kTexture, kVertices, kNone };

struct ExportOptions {
  /// Length of the file's unit. Only used if units_are_free(); else the format's.
  double metres_per_unit = 1.0;
  UpAxis up = UpAxis::kFormat;
  std::size_t triangles = 0;  ///< maximum for a mesh; 0: all. A reduced mesh has no texture
  ExportColors colors = ExportColors::kTexture;  ///< limited to those that mesh and format have
};

/// Whether a format does not define its unit: ply, obj, stl.
bool units_are_free(const std::string& ending);
/// The unit that write_mesh() and write_cloud() use for a format.
double unit_of_format(const std::string& ending);

/// Fails as simplify(), write_mesh(), write_cloud(); with kUnsupported for a recording; kCancelled.
Result<> export_model(const ModelData& data, const ExportOptions& options, const std::string& path,
                      const RunContext& context);

}  // namespace turnscan::studio
