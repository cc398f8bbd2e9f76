#pragma once
// A mesh's texture on its way from the process that reads foreign files.

#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/io/file/atomic_file.hpp>

namespace turnscan::mesh_io {

/// "texture WIDTH HEIGHT\n", the corners as floats, the pixels. Nothing of a mesh without texture.
Result<> write_texture_block(FileSink& sink, const TriangleMesh& mesh);

/// Takes such a block from the beginning of bytes, if there is one, and gives it to the mesh. Fails
/// with kFormat when the bytes do not hold it.
Result<> take_texture_block(std::string_view& bytes, TriangleMesh& mesh);

}  // namespace turnscan::mesh_io
