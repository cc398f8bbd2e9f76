#include <cmath>
#include <limits>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/file/read_budget.hpp>
#include <turnscan/io/mesh/lib3mf_handle.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/texture_budget.hpp>
#include <utility>

namespace turnscan::mesh_io {

namespace {

constexpr int kMaxDepth = 32;  // of nested objects
// An object may be placed any number of times, including one composed of others: the result may
// grow as a power of the file's length.
constexpr std::size_t kMaxPlaced = 100000;
constexpr std::uint64_t kMaxPictureBytes = std::uint64_t(256) << 20;

double metres_of(unsigned unit) {
  switch (unit) {
    case NMR::MODELUNIT_MICROMETER:
      return 1e-6;
    case NMR::MODELUNIT_CENTIMETER:
      return 1e-2;
    case NMR::MODELUNIT_INCH:
      return 0.0254;
    case NMR::MODELUNIT_FOOT:
      return 0.3048;
    case NMR::MODELUNIT_METER:
      return 1.0;
    default:
      return 1e-3;
  }
}

/// The fields are the upper three rows; their last column is the translation.
Eigen::Affine3d transform_from(const NMR::MODELTRANSFORM& fields) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      transform.matrix()(row, column) = static_cast<double>(fields.m_fFields[row][column]);
  return transform;
}

class ThreemfReader {
 public:
  explicit ThreemfReader(std::string_view bytes) : budget_(bytes.size()) {
    require(NMR::lib3mf_createmodel(model_.out()), model_);
    Lib3mfHandle reader;
    require(NMR::lib3mf_model_queryreader(model_.get(), "3mf", reader.out()), model_);
    // The buffer is only read; the interface merely lacks a const.
    auto* buffer = reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.data()));
    require(NMR::lib3mf_reader_readfrombuffer(reader.get(), buffer, bytes.size()), reader);
  }

  double metres_per_unit() const {
    DWORD unit = 0;
    require(NMR::lib3mf_model_getunit(model_.get(), &unit), model_);
    return metres_of(unit);
  }

  std::vector<TriangleMesh> meshes() {
    Lib3mfHandle items;
    require(NMR::lib3mf_model_getbuilditems(model_.get(), items.out()), model_);
    for (;;) {
      BOOL more = 0;
      require(NMR::lib3mf_builditemiterator_movenext(items.get(), &more), items);
      if (more == 0) break;
      Lib3mfHandle item;
      require(NMR::lib3mf_builditemiterator_getcurrent(items.get(), item.out()), items);
      add_item(item);
    }
    const file::FileFrame frame = frame_in_metadata();
    for (TriangleMesh& mesh : meshes_) file::from_file(frame, mesh.vertices, mesh.normals);
    return std::move(meshes_);
  }

 private:
  file::FileFrame frame_in_metadata() const {
    DWORD count = 0;
    require(NMR::lib3mf_model_getmetadatacount(model_.get(), &count), model_);
    for (DWORD i = 0; i < count; ++i) {
      const auto key = text_of([&](char* to, ULONG size, ULONG* needed) {
        return NMR::lib3mf_model_getmetadatakeyutf8(model_.get(), i, to, size, needed);
      });
      if (key != kApplication) continue;
      const auto value = text_of([&](char* to, ULONG size, ULONG* needed) {
        return NMR::lib3mf_model_getmetadatavalueutf8(model_.get(), i, to, size, needed);
      });
      if (value.starts_with(kByTurnscan))
        return file::frame_of_mark(std::string_view(value).substr(kByTurnscan.size()));
    }
    return {};
  }

  /// get(buffer, size, needed) queries a text from lib3mf. Empty if it fails or the text is too
  /// long.
  template <class Get>
  static std::string text_of(const Get& get) {
    ULONG needed = 0;
    if (get(nullptr, 0, &needed) != LIB3MF_OK || needed > 10000) return {};
    std::string text(needed + 1, '\0');
    if (get(text.data(), needed + 1, &needed) != LIB3MF_OK) return {};
    return text.substr(0, text.find('\0'));
  }

  void add_item(const Lib3mfHandle& item) {
    Lib3mfHandle object;
    require(NMR::lib3mf_builditem_getobjectresource(item.get(), object.out()), item);
    NMR::MODELTRANSFORM fields{};
    require(NMR::lib3mf_builditem_getobjecttransform(item.get(), &fields), item);
    TriangleMesh mesh;
    mesh.name = name_of(object);
    add_object(object, transform_from(fields), 0, mesh);
    if (mesh.colors.size() != mesh.vertices.size()) mesh.colors.clear();
    add_texture(mesh);
    meshes_.push_back(std::move(mesh));
  }

  static std::string name_of(const Lib3mfHandle& object) {
    return text_of([&](char* to, ULONG size, ULONG* needed) {
      return NMR::lib3mf_object_getnameutf8(object.get(), to, size, needed);
    });
  }

  void add_object(const Lib3mfHandle& object, const Eigen::Affine3d& transform, int depth,
                  TriangleMesh& target) {
    if (depth > kMaxDepth) throw Lib3mfFailure("objects are nested too deeply");
    if (++placed_ > kMaxPlaced)
      throw Lib3mfFailure(fmt::format("it places more than {} objects", kMaxPlaced));
    BOOL is_mesh = 0;
    require(NMR::lib3mf_object_ismeshobject(object.get(), &is_mesh), object);
    if (is_mesh != 0) return add_mesh(object, transform, target);
    DWORD count = 0;
    require(NMR::lib3mf_componentsobject_getcomponentcount(object.get(), &count), object);
    for (DWORD i = 0; i < count; ++i) {
      Lib3mfHandle component;
      require(NMR::lib3mf_componentsobject_getcomponent(object.get(), i, component.out()), object);
      add_component(component, transform, depth, target);
    }
  }

  void add_component(const Lib3mfHandle& component, const Eigen::Affine3d& transform, int depth,
                     TriangleMesh& target) {
    Lib3mfHandle object;
    require(NMR::lib3mf_component_getobjectresource(component.get(), object.out()), component);
    NMR::MODELTRANSFORM fields{};
    require(NMR::lib3mf_component_gettransform(component.get(), &fields), component);
    add_object(object, transform * transform_from(fields), depth + 1, target);
  }

  void add_mesh(const Lib3mfHandle& object, const Eigen::Affine3d& transform,
                TriangleMesh& target) {
    DWORD vertex_count = 0;
    DWORD triangle_count = 0;
    require(NMR::lib3mf_meshobject_getvertexcount(object.get(), &vertex_count), object);
    require(NMR::lib3mf_meshobject_gettrianglecount(object.get(), &triangle_count), object);
    if (vertex_count == 0 || triangle_count == 0) return;
    const std::size_t first = target.vertices.size();
    if (!budget_.hold(sizeof(Vec3f) * std::uint64_t(vertex_count) +
                      sizeof(std::array<std::uint32_t, 3>) * std::uint64_t(triangle_count)))
      throw Lib3mfFailure("it places its meshes so often that they are out of proportion to it");
    if (first + vertex_count > std::numeric_limits<std::int32_t>::max()) throw std::bad_alloc();
    std::vector<NMR::MODELMESHVERTEX> vertices(vertex_count);
    std::vector<NMR::MODELMESHTRIANGLE> triangles(triangle_count);
    require(
        NMR::lib3mf_meshobject_getvertices(object.get(), vertices.data(), vertex_count, nullptr),
        object);
    require(NMR::lib3mf_meshobject_gettriangleindices(object.get(), triangles.data(),
                                                      triangle_count, nullptr),
            object);
    for (const NMR::MODELMESHVERTEX& v : vertices)
      target.vertices.push_back(
          (transform * Vec3f(v.m_fPosition[0], v.m_fPosition[1], v.m_fPosition[2]).cast<double>())
              .cast<float>());
    add_triangles(triangles, first, vertex_count, transform.linear().determinant() < 0.0, target);
    add_uvs(object, triangle_count, transform.linear().determinant() < 0.0);
    if (target.colors.size() == first) add_colors(object, triangles, vertex_count, target);
  }

  /// Texture coordinates of an object's triangles, if all have them in the same image.
  void add_uvs(const Lib3mfHandle& object, std::size_t count, bool mirrored) {
    Lib3mfHandle handler;
    std::vector<NMR::MODELMESHTEXTURE2D> uvs(count);
    if (NMR::lib3mf_meshobject_createpropertyhandler(object.get(), handler.out()) != LIB3MF_OK ||
        NMR::lib3mf_propertyhandler_gettexturearray(handler.get(), uvs.data()) != LIB3MF_OK)
      return;
    for (const NMR::MODELMESHTEXTURE2D& place : uvs) {
      if (place.m_nTextureID == 0) return;
      if (texture_id_ != 0 && texture_id_ != place.m_nTextureID) return;
      texture_id_ = place.m_nTextureID;
      auto& corners = uvs_.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t from = mirrored ? 2 - k : k;
        corners[k] = {place.m_fU[from], 1.0F - place.m_fV[from]};
      }
    }
  }

  /// Adds the texture to the item just read. An invalid image costs it its texture, not its shape.
  void add_texture(TriangleMesh& mesh) {
    auto corners = std::exchange(uvs_, {});
    const DWORD id = std::exchange(texture_id_, 0);
    if (id == 0 || corners.size() != mesh.triangles.size()) return;
    Lib3mfHandle texture, attachment;
    ULONG64 size = 0;
    if (NMR::lib3mf_model_gettexture2dbyid(model_.get(), id, texture.out()) != LIB3MF_OK ||
        NMR::lib3mf_texture2d_getattachment(texture.get(), attachment.out()) != LIB3MF_OK ||
        NMR::lib3mf_attachment_getstreamsize(attachment.get(), &size) != LIB3MF_OK ||
        size > kMaxPictureBytes)
      return;
    std::string bytes(size, '\0');
    if (NMR::lib3mf_attachment_writetobuffer(
            attachment.get(), reinterpret_cast<unsigned char*>(bytes.data()), size) != LIB3MF_OK)
      return;
    auto image = pictures_.decode(bytes);
    if (!image) return;
    auto made = std::make_shared<MeshTexture>();
    made->image = std::move(*image);
    made->corners = std::move(corners);
    mesh.texture = std::move(made);
  }

  static void add_triangles(const std::vector<NMR::MODELMESHTRIANGLE>& triangles, std::size_t first,
                            std::size_t vertex_count, bool mirrored, TriangleMesh& target) {
    for (const NMR::MODELMESHTRIANGLE& t : triangles) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t index = t.m_nIndices[mirrored ? 2 - k : k];
        if (index >= vertex_count) throw Lib3mfFailure("the index of a vertex is out of range");
        triangle[k] = static_cast<std::uint32_t>(first) + index;
      }
      target.triangles.push_back(triangle);
    }
  }

  /// Only if all corners have one, and the same at each vertex; transparent counts as none.
  static void add_colors(const Lib3mfHandle& object,
                         const std::vector<NMR::MODELMESHTRIANGLE>& triangles,
                         std::size_t vertex_count, TriangleMesh& target) {
    Lib3mfHandle handler;
    std::vector<NMR::MODELMESH_TRIANGLECOLOR_SRGB> corners(triangles.size());
    if (NMR::lib3mf_meshobject_createpropertyhandler(object.get(), handler.out()) != LIB3MF_OK ||
        NMR::lib3mf_propertyhandler_getcolorarray(handler.get(), corners.data()) != LIB3MF_OK)
      return;
    std::vector<Rgb> colors(vertex_count);
    std::vector<std::uint8_t> known(vertex_count, 0);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const NMR::MODELMESHCOLOR_SRGB& c = corners[i].m_Colors[k];
        const Rgb color{c.m_Red, c.m_Green, c.m_Blue};
        const std::uint32_t v = triangles[i].m_nIndices[k];
        if (c.m_Alpha == 0 || (known[v] != 0 && colors[v] != color)) return;
        colors[v] = color;
        known[v] = 1;
      }
    target.colors.insert(target.colors.end(), colors.begin(), colors.end());
  }

  Lib3mfHandle model_;
  std::vector<TriangleMesh> meshes_;
  std::size_t placed_ = 0;
  std::vector<std::array<Eigen::Vector2f, 3>> uvs_;  // of the item being read
  DWORD texture_id_ = 0;
  file::ReadBudget budget_;
  TextureBudget pictures_;
};

}  // namespace

Result<MeshesWithUnit> decode_3mf(std::string_view bytes) {
  try {
    ThreemfReader reader(bytes);
    const double unit = reader.metres_per_unit();
    return MeshesWithUnit{reader.meshes(), unit};
  } catch (const Lib3mfFailure& failure) {
    return fail(ErrorCode::kFormat, "damaged 3MF file: {}", failure.what());
  }
}

}  // namespace turnscan::mesh_io
