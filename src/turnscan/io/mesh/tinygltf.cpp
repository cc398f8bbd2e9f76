#define TINYGLTF_IMPLEMENTATION
#include <nlohmann/json.hpp>
#include <turnscan/io/mesh/tinygltf.hpp>

namespace turnscan::mesh_io {

bool load_glb(tinygltf::TinyGLTF& loader, std::string_view bytes, tinygltf::Model& model,
              std::string& error) {
  std::string warning;
  try {
    return loader.LoadBinaryFromMemory(&model, &error, &warning,
                                       reinterpret_cast<const unsigned char*>(bytes.data()),
                                       static_cast<unsigned>(bytes.size()));
  } catch (const nlohmann::json::exception& thrown) {
    error = thrown.what();
    return false;
  }
}

}  // namespace turnscan::mesh_io
