#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <sstream>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/srgb.hpp>
#include <turnscan/io/mesh/tinygltf.hpp>

namespace turnscan::mesh_io {

namespace {

class Builder {
 public:
  explicit Builder(std::span<const TriangleMesh> meshes) {
    model_.asset.version = "2.0";
    model_.asset.generator = "turnscan";
    model_.buffers.emplace_back();
    if (!std::all_of(meshes.begin(), meshes.end(), has_texture)) add_material(-1);
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    for (const TriangleMesh& mesh : meshes) {
      if (!has_texture(mesh)) {
        add(mesh, nullptr);
        continue;
      }
      const SplitMesh split = split_at_seams(mesh);
      add(split.mesh, &split.uvs);
      pictures_.push_back({model_.meshes.size() - 1, &mesh.texture->image});
    }
  }

  /// The images follow all arrays, whose numbers must be aligned to four bytes.
  Result<> add_pictures() {
    for (const auto& [mesh, picture] : pictures_) {
      TURNSCAN_ASSIGN(const std::string png, encode_color_png(*picture));
      std::vector<unsigned char>& buffer = model_.buffers[0].data;
      tinygltf::BufferView& view = model_.bufferViews.emplace_back();
      view.buffer = 0;
      view.byteOffset = buffer.size();
      view.byteLength = png.size();
      buffer.insert(buffer.end(), png.begin(), png.end());
      buffer.resize((buffer.size() + 3) / 4 * 4, 0);
      tinygltf::Image& image = model_.images.emplace_back();
      image.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
      image.mimeType = "image/png";
      add_sampler();
      tinygltf::Texture& texture = model_.textures.emplace_back();
      texture.source = static_cast<int>(model_.images.size()) - 1;
      texture.sampler = 0;
      add_material(static_cast<int>(model_.textures.size()) - 1);
      model_.meshes[mesh].primitives[0].material = static_cast<int>(model_.materials.size()) - 1;
    }
    return {};
  }

  const tinygltf::Model& model() const { return model_; }

 private:
  /// Without it, viewers assume a metallic surface, which looks black.
  void add_material(int texture) {
    tinygltf::Material& material = model_.materials.emplace_back();
    material.pbrMetallicRoughness.baseColorTexture.index = texture;
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;
  }

  /// Texture coordinates outside the image repeat it, as in memory.
  void add_sampler() {
    if (!model_.samplers.empty()) return;
    tinygltf::Sampler& sampler = model_.samplers.emplace_back();
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_REPEAT;
  }

  /// Vertex colours would be multiplied with the texture.
  void add(const TriangleMesh& mesh, const std::vector<Eigen::Vector2f>* uvs) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    primitive.attributes["POSITION"] = add_positions(mesh);
    if (!mesh.normals.empty()) primitive.attributes["NORMAL"] = add_vectors(mesh.normals);
    if (!mesh.colors.empty() && uvs == nullptr) primitive.attributes["COLOR_0"] = add_colors(mesh);
    if (uvs != nullptr)
      primitive.attributes["TEXCOORD_0"] = add_array(
          uvs->data(), sizeof(Eigen::Vector2f), uvs->size(), TINYGLTF_COMPONENT_TYPE_FLOAT,
          TINYGLTF_TYPE_VEC2, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.indices = add_indices(mesh);
    tinygltf::Mesh& target = model_.meshes.emplace_back();
    target.primitives.push_back(std::move(primitive));
    tinygltf::Node& node = model_.nodes.emplace_back();
    node.mesh = static_cast<int>(model_.meshes.size()) - 1;
    node.name = file::clean_name(mesh.name);
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()) - 1);
  }

  int add_vectors(const std::vector<Vec3f>& vectors) {
    static_assert(sizeof(Vec3f) == 12);
    return add_array(vectors.data(), sizeof(Vec3f), vectors.size(), TINYGLTF_COMPONENT_TYPE_FLOAT,
                     TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  }

  int add_positions(const TriangleMesh& mesh) {
    const int index = add_vectors(mesh.vertices);
    const Box box = bounds(mesh.vertices);
    tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
    accessor.minValues = {box.min.x(), box.min.y(), box.min.z()};
    accessor.maxValues = {box.max.x(), box.max.y(), box.max.z()};
    return index;
  }

  /// Linear, 16 bits: enough to restore all 8-bit sRGB values.
  int add_colors(const TriangleMesh& mesh) {
    std::array<std::uint16_t, 256> linear;
    for (std::size_t i = 0; i < 256; ++i)
      linear[i] = static_cast<std::uint16_t>(
          std::lround(65535.0 * linear_from_srgb(static_cast<std::uint8_t>(i))));
    std::vector<std::array<std::uint16_t, 4>> colors;
    colors.reserve(mesh.colors.size());
    for (const Rgb c : mesh.colors)
      colors.push_back({linear[c.r], linear[c.g], linear[c.b], 65535});
    const int index =
        add_array(colors.data(), 8, colors.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                  TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
    model_.accessors[static_cast<std::size_t>(index)].normalized = true;
    return index;
  }

  int add_indices(const TriangleMesh& mesh) {
    return add_array(mesh.triangles.data(), 4, mesh.triangles.size() * 3,
                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                     TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }

  int add_array(const void* data, std::size_t item_bytes, std::size_t count, int component,
                int type, int target) {
    static_assert(std::endian::native == std::endian::little, "glTF is little-endian");
    std::vector<unsigned char>& buffer = model_.buffers[0].data;
    tinygltf::BufferView& view = model_.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = count * item_bytes;
    view.target = target;
    const auto* bytes = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), bytes, bytes + view.byteLength);
    tinygltf::Accessor& accessor = model_.accessors.emplace_back();
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  tinygltf::Model model_;
  std::vector<std::pair<std::size_t, const ColorImage*>> pictures_;  ///< of meshes, by index
};

/// Lengths in the file are 32-bit.
bool fits(std::span<const TriangleMesh> meshes) {
  std::uint64_t bytes = 0;
  for (const TriangleMesh& mesh : meshes)
    bytes +=
        mesh.vertices.size() * 32 + mesh.triangles.size() * 12 + 2000 +
        (has_texture(mesh) ? mesh.triangles.size() * 100 + mesh.texture->image.pixels.size() * 3
                           : 0);
  return bytes < std::numeric_limits<std::uint32_t>::max();
}

}  // namespace

Result<> write_glb(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& /*frame*/) {
  if (!fits(meshes))
    return fail(ErrorCode::kUnsupported, "GLB cannot hold more than 4 GB; write PLY");
  Builder builder(meshes);
  TURNSCAN_TRY(builder.add_pictures());
  std::ostringstream stream;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&builder.model(), stream, false, true))
    return fail(ErrorCode::kLibrary, "tinygltf did not write the meshes");
  return sink.write(stream.view());
}

}  // namespace turnscan::mesh_io
