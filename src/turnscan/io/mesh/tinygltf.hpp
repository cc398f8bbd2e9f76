#pragma once
// tinygltf without image decoding and without file access. For the sources of GLB only.

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON
#include <fstream>
#include <string>
#include <string_view>
// tinygltf requires the includes above.
#include <tiny_gltf.h>

namespace turnscan::mesh_io {

/// False, with an error message, if the bytes are not a complete GLB file.
bool load_glb(tinygltf::TinyGLTF& loader, std::string_view bytes, tinygltf::Model& model,
              std::string& error);

}  // namespace turnscan::mesh_io
