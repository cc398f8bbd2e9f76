#include <algorithm>
#include <limits>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/file/read_budget.hpp>
#include <turnscan/io/mesh/glb_accessor.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/srgb.hpp>
#include <turnscan/io/mesh/texture_budget.hpp>
#include <utility>

namespace turnscan::mesh_io {

namespace {

constexpr int kMaxNesting = 64;
constexpr const char* kTooMuch =
    "it places its meshes so often that they are out of proportion to it";

/// tinygltf copies nested values recursively.
bool nested_too_deeply(std::string_view bytes) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 20; i < bytes.size(); ++i) {
    const char c = bytes[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
    if (depth > kMaxNesting) return true;
    if (depth <= 0 && c == '}') return false;  // the binary part follows
  }
  return false;
}

/// Newer versions of tinygltf keep their own callbacks unless this one is set, too.
template <class Callbacks>
void forbid_file_sizes(Callbacks& callbacks) {
  if constexpr (requires { callbacks.GetFileSizeInBytes; })
    callbacks.GetFileSizeInBytes = [](std::size_t*, std::string*, const std::string&, void*) {
      return false;
    };
}

/// Images are decoded later, by our own reader, and a GLB file is self-contained.
void forbid_files_and_images(tinygltf::TinyGLTF& loader) {
  loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                           const unsigned char*, int, void*) { return true; },
                        nullptr);
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return false; };
  callbacks.ExpandFilePath = [](const std::string&, void*) { return std::string(); };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&,
                               void*) { return false; };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                void*) { return false; };
  forbid_file_sizes(callbacks);
  loader.SetFsCallbacks(callbacks);
}

Result<tinygltf::Model> parse(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return fail(ErrorCode::kUnsupported, "not a GLB file");
  if (bytes.size() > std::numeric_limits<unsigned>::max() || nested_too_deeply(bytes))
    return fail(ErrorCode::kUnsupported, "a GLB file too large or too deeply nested");
  tinygltf::TinyGLTF loader;
  forbid_files_and_images(loader);
  tinygltf::Model model;
  std::string error;
  if (load_glb(loader, bytes, model, error)) return model;
  error = error.substr(0, error.find('\n'));
  return fail(ErrorCode::kFormat, "damaged GLB file: {}", error);
}

Eigen::Affine3d transform_of(const tinygltf::Node& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 12; ++i)
      transform.matrix()(i % 3, i / 3) = node.matrix[static_cast<std::size_t>(i / 3 * 4 + i % 3)];
    return transform;
  }
  if (node.translation.size() == 3)
    transform.translate(Vec3d(node.translation[0], node.translation[1], node.translation[2]));
  if (node.rotation.size() == 4) {
    const Eigen::Quaterniond q(node.rotation[3], node.rotation[0], node.rotation[1],
                               node.rotation[2]);
    if (q.norm() > 0.0) transform.rotate(q.normalized());
  }
  if (node.scale.size() == 3) transform.scale(Vec3d(node.scale[0], node.scale[1], node.scale[2]));
  return transform;
}

class SceneReader {
 public:
  SceneReader(const tinygltf::Model& model, std::size_t file_bytes)
      : model_(model), visited_(model.nodes.size(), 0), budget_(file_bytes) {}

  Meshes read() {
    for (const int root : roots()) open_.push_back({root, Eigen::Affine3d::Identity()});
    while (!open_.empty()) {
      const Open next = open_.back();
      open_.pop_back();
      if (const char* why = visit(next))
        return fail(ErrorCode::kFormat, "damaged GLB file: {}", why);
    }
    return std::move(meshes_);
  }

 private:
  struct Open {
    int node;
    Eigen::Affine3d transform;
  };

  /// In reverse, because the last element is visited first.
  std::vector<int> roots() const {
    const auto scene = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
    if (scene >= model_.scenes.size()) return {};
    return {model_.scenes[scene].nodes.rbegin(), model_.scenes[scene].nodes.rend()};
  }

  const char* visit(const Open& open) {
    const auto index = static_cast<std::size_t>(open.node);
    if (open.node < 0 || index >= model_.nodes.size()) return "a node does not exist";
    if (visited_[index]++ != 0) return "a node has two parents";
    const tinygltf::Node& node = model_.nodes[index];
    const Eigen::Affine3d transform = open.transform * transform_of(node);
    const auto old = static_cast<std::ptrdiff_t>(open_.size());
    for (const int child : node.children) open_.push_back({child, transform});
    std::reverse(open_.begin() + old, open_.end());  // the last one is visited first
    if (node.mesh < 0) return nullptr;
    if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size()) return "a mesh does not exist";
    const tinygltf::Mesh& source = model_.meshes[static_cast<std::size_t>(node.mesh)];
    if (!budget_.hold(sizeof(TriangleMesh))) return kTooMuch;
    TriangleMesh& mesh = meshes_.emplace_back();
    mesh.name = node.name.empty() ? source.name : node.name;
    for (const tinygltf::Primitive& primitive : source.primitives)
      if (const char* why = add(primitive, transform, mesh)) return why;
    if (mesh.normals.size() != mesh.vertices.size()) mesh.normals.clear();
    if (mesh.colors.size() != mesh.vertices.size()) mesh.colors.clear();
    add_texture(source, mesh);
    return nullptr;
  }

  /// If all parts of the mesh have texture coordinates in the same image. An invalid image costs
  /// the mesh its texture, not its shape.
  void add_texture(const tinygltf::Mesh& source, TriangleMesh& mesh) {
    const auto uvs = std::exchange(uvs_, {});
    if (uvs.size() != mesh.vertices.size() || source.primitives.empty()) return;
    int picture = -1;
    for (const tinygltf::Primitive& primitive : source.primitives) {
      const int own = picture_of(primitive);
      if (own < 0 || (picture >= 0 && picture != own)) return;
      picture = own;
    }
    auto image = pictures_.decode(bytes_of_picture(picture));
    if (!image) return;
    auto texture = std::make_shared<MeshTexture>();
    texture->image = std::move(*image);
    for (const auto& t : mesh.triangles)
      texture->corners.push_back({uvs[t[0]], uvs[t[1]], uvs[t[2]]});
    mesh.texture = std::move(texture);
    if (has_texture(mesh)) weld_seams(mesh);
  }

  /// The base colour image that uses the first set of texture coordinates; -1 if there is none.
  int picture_of(const tinygltf::Primitive& primitive) const {
    if (primitive.material < 0 ||
        static_cast<std::size_t>(primitive.material) >= model_.materials.size())
      return -1;
    const auto& info = model_.materials[static_cast<std::size_t>(primitive.material)]
                           .pbrMetallicRoughness.baseColorTexture;
    if (info.index < 0 || info.texCoord != 0 ||
        static_cast<std::size_t>(info.index) >= model_.textures.size())
      return -1;
    const int source = model_.textures[static_cast<std::size_t>(info.index)].source;
    return source >= 0 && static_cast<std::size_t>(source) < model_.images.size() ? source : -1;
  }

  std::string_view bytes_of_picture(int picture) const {
    const int index = model_.images[static_cast<std::size_t>(picture)].bufferView;
    if (index < 0 || static_cast<std::size_t>(index) >= model_.bufferViews.size()) return {};
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model_.buffers.size())
      return {};
    const auto& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) return {};
    return {reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength};
  }

  std::optional<GlbAccessor> attribute(const tinygltf::Primitive& primitive,
                                       const char* name) const {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? std::nullopt
                                               : GlbAccessor::open(model_, found->second);
  }

  const char* add(const tinygltf::Primitive& primitive, const Eigen::Affine3d& transform,
                  TriangleMesh& mesh) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        mode != TINYGLTF_MODE_TRIANGLE_FAN)
      return nullptr;  // points and lines
    const auto positions = attribute(primitive, "POSITION");
    if (!positions || positions->components() != 3) return "a mesh has no valid positions";
    const std::size_t first = mesh.vertices.size();
    if (first + positions->count() > std::numeric_limits<std::int32_t>::max())
      return "it has too many vertices";
    // Any number of nodes may place the same mesh.
    if (!budget_.hold(sizeof(Vec3f) * positions->count())) return kTooMuch;
    add_vertices(primitive, *positions, transform, mesh);
    return add_triangles(primitive, mode, first, transform.linear().determinant() < 0.0, mesh);
  }

  void add_vertices(const tinygltf::Primitive& primitive, const GlbAccessor& positions,
                    const Eigen::Affine3d& transform, TriangleMesh& mesh) {
    const std::size_t n = positions.count();
    const auto vector = [](const GlbAccessor& a, std::size_t i) {
      return Vec3d(a.at(i, 0), a.at(i, 1), a.at(i, 2));
    };
    if (const auto uvs = attribute(primitive, "TEXCOORD_0");
        uvs && uvs->count() == n && uvs->components() == 2 && uvs_.size() == mesh.vertices.size())
      for (std::size_t i = 0; i < n; ++i)
        uvs_.emplace_back(float(uvs->at(i, 0)), float(uvs->at(i, 1)));
    const bool all_normals = mesh.normals.size() == mesh.vertices.size();
    const bool all_colors = mesh.colors.size() == mesh.vertices.size();
    for (std::size_t i = 0; i < n; ++i)
      mesh.vertices.push_back((transform * vector(positions, i)).cast<float>());
    const auto normals = attribute(primitive, "NORMAL");
    if (all_normals && normals && normals->count() == n && normals->components() == 3) {
      const Eigen::Matrix3d linear = transform.linear();
      for (std::size_t i = 0; i < n; ++i)
        mesh.normals.push_back(turned(vector(*normals, i), linear));
    }
    const auto colors = attribute(primitive, "COLOR_0");
    if (all_colors && colors && colors->count() == n && colors->components() >= 3)
      for (std::size_t i = 0; i < n; ++i)
        mesh.colors.push_back({srgb_from_linear(colors->at(i, 0)),
                               srgb_from_linear(colors->at(i, 1)),
                               srgb_from_linear(colors->at(i, 2))});
  }

  /// Leaves normals bitwise unchanged if there is no rotation.
  static Vec3f turned(const Vec3d& normal, const Eigen::Matrix3d& linear) {
    if (linear.isIdentity(0.0)) return normal.cast<float>();
    // The cofactor matrix is the inverse transpose times the determinant; it always exists.
    Eigen::Matrix3d cofactors;
    for (int i = 0; i < 3; ++i)
      cofactors.col(i) = linear.col((i + 1) % 3).cross(linear.col((i + 2) % 3));
    const double sign = linear.determinant() < 0.0 ? -1.0 : 1.0;
    return (sign * (cofactors * normal)).normalized().cast<float>();
  }

  const char* add_triangles(const tinygltf::Primitive& primitive, int mode, std::size_t first,
                            bool mirrored, TriangleMesh& mesh) const {
    const std::size_t vertices = mesh.vertices.size() - first;
    std::optional<GlbAccessor> indices;
    if (primitive.indices >= 0) {
      indices = GlbAccessor::open(model_, primitive.indices);
      if (!indices || indices->components() != 1 || !indices->is_unsigned())
        return "a mesh has no valid indices";
    }
    const std::size_t n = indices ? indices->count() : vertices;
    const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    if (!budget_.hold(sizeof(std::array<std::uint32_t, 3>) * (n / step))) return kTooMuch;
    for (std::size_t i = 0; i + 2 < n; i += step) {
      std::array<std::size_t, 3> place{mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : i, i + 1, i + 2};
      const bool odd = mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1;
      if (odd != mirrored) std::swap(place[1], place[2]);
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t index = indices ? indices->index_at(place[k]) : place[k];
        if (index >= vertices) return "the index of a vertex is out of range";
        triangle[k] = static_cast<std::uint32_t>(first + index);
      }
      mesh.triangles.push_back(triangle);
    }
    return nullptr;
  }

  const tinygltf::Model& model_;
  std::vector<std::uint8_t> visited_;
  std::vector<Open> open_;
  std::vector<TriangleMesh> meshes_;
  file::ReadBudget budget_;
  TextureBudget pictures_;
  std::vector<Eigen::Vector2f> uvs_;  // in the image, for the vertices of the mesh being read
};

}  // namespace

Meshes decode_glb(std::string_view bytes) {
  TURNSCAN_ASSIGN(const tinygltf::Model model, parse(bytes));
  return SceneReader(model, bytes.size()).read();
}

}  // namespace turnscan::mesh_io
