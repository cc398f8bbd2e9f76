#pragma once
// Transfers a mesh's texture from the child process that reads files of other programs.

#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/io/file/atomic_file.hpp>

namespace turnscan::mesh_io {

/// Writes "texture WIDTH HEIGHT\n", the corners as floats, and the pixels; nothing for a mesh
/// without texture.
Result<> write_texture_block(FileSink& sink, const TriangleMesh& mesh);

/// Removes a texture block from the beginning of bytes, if there is one, and assigns it to the
/// mesh. Fails with kFormat if the bytes are too few.
Result<> take_texture_block(std::string_view& bytes, TriangleMesh& mesh);

}  // namespace turnscan::mesh_io
