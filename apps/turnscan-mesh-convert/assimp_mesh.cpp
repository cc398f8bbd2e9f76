#include "assimp_mesh.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/DefaultIOSystem.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <system_error>
#include <turnscan/io/file/read_budget.hpp>
#include <utility>

using turnscan::ErrorCode;
using turnscan::fail;
using turnscan::Result;
using turnscan::TriangleMesh;

namespace {

/// Knows nothing but regular files: a reference to a pipe would wait for its writer. The default
/// opens a file to see whether it exists.
class RegularFiles : public Assimp::DefaultIOSystem {
 public:
  bool Exists(const char* file) const override {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return Exists(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }
};

constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                            aiProcess_SortByPType | aiProcess_RemoveComponent;
constexpr int kDropped = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                         aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                         aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS;

std::uint8_t byte_from(float value) {
  return value > 0.0F ? static_cast<std::uint8_t>(std::min(value, 1.0F) * 255.0F + 0.5F)
                      : std::uint8_t(0);
}

void add_vertices(const aiMesh& source, const aiMatrix4x4& transform, TriangleMesh& target) {
  const bool colors = source.HasVertexColors(0) && target.colors.size() == target.vertices.size();
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const aiVector3D p = transform * source.mVertices[i];
    target.vertices.emplace_back(p.x, p.y, p.z);
    if (!colors) continue;
    const aiColor4D& c = source.mColors[0][i];
    target.colors.push_back({byte_from(c.r), byte_from(c.g), byte_from(c.b)});
  }
}

bool add_mesh(const aiMesh& source, const aiMatrix4x4& transform, TriangleMesh& target) {
  const std::size_t first = target.vertices.size();
  const bool mirrored = aiMatrix3x3(transform).Determinant() < 0.0F;
  add_vertices(source, transform, target);
  for (unsigned f = 0; f < source.mNumFaces; ++f) {
    const aiFace& face = source.mFaces[f];
    if (face.mNumIndices != 3) continue;
    std::array<std::uint32_t, 3> triangle{};
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= source.mNumVertices) return false;
      triangle[k] = static_cast<std::uint32_t>(first) + face.mIndices[k];
    }
    if (mirrored) std::swap(triangle[1], triangle[2]);
    target.triangles.push_back(triangle);
  }
  return true;
}

tl::unexpected<turnscan::Error> out_of_range() {
  return fail(ErrorCode::kFormat, "damaged file: an index is out of range");
}

/// budget: any number of nodes may place the same mesh.
Result<> add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent,
                  const turnscan::file::ReadBudget& budget, std::vector<TriangleMesh>& meshes) {
  const aiMatrix4x4 transform = parent * node.mTransformation;
  TriangleMesh mesh;
  mesh.name = node.mName.C_Str();
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    if (node.mMeshes[i] >= scene.mNumMeshes) return out_of_range();
    const aiMesh& source = *scene.mMeshes[node.mMeshes[i]];
    TURNSCAN_TRY(budget.hold(sizeof(turnscan::Vec3f) * source.mNumVertices +
                             sizeof(std::array<std::uint32_t, 3>) * source.mNumFaces));
    if (!add_mesh(source, transform, mesh)) return out_of_range();
  }
  if (mesh.colors.size() != mesh.vertices.size()) mesh.colors.clear();
  if (!mesh.empty()) meshes.push_back(std::move(mesh));
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    TURNSCAN_TRY(add_node(scene, *node.mChildren[i], transform, budget, meshes));
  return {};
}

/// FBX says how many centimetres its unit has; other formats are scaled by assimp itself.
double unit_of(const aiScene& scene) {
  double centimetres = 0.0;
  if (scene.mMetaData != nullptr && scene.mMetaData->Get("UnitScaleFactor", centimetres) &&
      centimetres > 0.0)
    return centimetres / 100.0;
  return 1.0;
}

tl::unexpected<turnscan::Error> refused(const std::string& why) {
  if (why.find("bad_alloc") != std::string::npos)
    return fail(ErrorCode::kResourceLimit, "reading it takes too much memory");
  if (why.find("No suitable reader") != std::string::npos)
    return fail(ErrorCode::kUnsupported, "no reader knows this kind of file");
  return fail(ErrorCode::kFormat, "damaged file: {}", why);
}

}  // namespace

Result<AssimpMeshes> read_with_assimp(const std::filesystem::path& path) {
  Assimp::Importer importer;
  importer.SetIOHandler(new RegularFiles);  // owned by the importer
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, kDropped);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(path.string(), kSteps);
  if (scene == nullptr || scene->mRootNode == nullptr) return refused(importer.GetErrorString());
  AssimpMeshes read;
  read.metres_per_unit = unit_of(*scene);
  std::error_code error;
  const turnscan::file::ReadBudget budget(std::filesystem::file_size(path, error));
  TURNSCAN_TRY(add_node(*scene, *scene->mRootNode, aiMatrix4x4(), budget, read.meshes));
  return read;
}
