#include <fmt/format.h>

#include <algorithm>
#include <clocale>
#include <cstring>
#include <locale>
#include <optional>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/lib3mf_handle.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>

namespace turnscan::mesh_io {

namespace {

/// A file in memory: lib3mf seeks back to complete what it wrote.
struct Target {
  std::string bytes;
  std::size_t position = 0;
  bool out_of_memory = false;
};

unsigned write_chunk(const unsigned char* data, unsigned size, Target* target) {
  try {
    if (target->bytes.size() < target->position + size)
      target->bytes.resize(target->position + size);
  } catch (const std::bad_alloc&) {
    target->out_of_memory = true;
    return 1;
  }
  std::memcpy(target->bytes.data() + target->position, data, size);
  target->position += size;
  return 0;
}

unsigned seek(unsigned long long position, Target* target) {
  target->position = position;
  return 0;
}

/// lib3mf would use random ones, but the same mesh must give the same bytes.
std::string uuid(unsigned kind, std::size_t number) {
  return fmt::format("{:08x}-0000-4000-8000-{:012x}", kind, number);
}

bool is_degenerate(const std::array<std::uint32_t, 3>& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// lib3mf writes texture coordinates through streams, which use the global locale: while this
/// object lives, its decimal separator is a point. Programs that never set the locale see no
/// change.
class ClassicStreams {
 public:
  explicit ClassicStreams(std::span<const TriangleMesh> meshes) {
    const std::locale now;
    const bool commas = std::use_facet<std::numpunct<wchar_t>>(now).decimal_point() != L'.' ||
                        std::use_facet<std::numpunct<char>>(now).decimal_point() != '.';
    if (!commas || std::none_of(meshes.begin(), meshes.end(), has_texture)) return;
    c_locale_ = std::setlocale(LC_ALL, nullptr);
    before_ = std::locale::global(std::locale::classic());
  }
  ~ClassicStreams() {
    if (!before_) return;
    std::locale::global(*before_);
    std::setlocale(LC_ALL, c_locale_.c_str());
  }
  ClassicStreams(const ClassicStreams&) = delete;
  ClassicStreams& operator=(const ClassicStreams&) = delete;

 private:
  std::optional<std::locale> before_;
  std::string c_locale_;
};

class Writer {
 public:
  Writer(std::span<const TriangleMesh> meshes, const file::FileFrame& frame) {
    require(NMR::lib3mf_createmodel(model_.out()), model_);
    require(NMR::lib3mf_model_setunit(model_.get(), NMR::MODELUNIT_MILLIMETER), model_);
    require(NMR::lib3mf_model_setbuilduuidutf8(model_.get(), uuid(1, 0).c_str()), model_);
    if (frame.z_up)
      require(NMR::lib3mf_model_addmetadatautf8(
                  model_.get(), kApplication,
                  (std::string(kByTurnscan) + file::mark_of(frame, 1000.0)).c_str()),
              model_);
    for (std::size_t i = 0; i < meshes.size(); ++i) add(meshes[i], i);
  }

  std::string write() {
    Lib3mfHandle writer;
    require(NMR::lib3mf_model_querywriter(model_.get(), "3mf", writer.out()), model_);
    Target target;
    const auto result = NMR::lib3mf_writer_writetocallback(
        writer.get(), reinterpret_cast<void*>(write_chunk), reinterpret_cast<void*>(seek), &target);
    if (target.out_of_memory) throw std::bad_alloc();
    require(result, writer);
    return std::move(target.bytes);
  }

 private:
  void add(const TriangleMesh& mesh, std::size_t number) {
    Lib3mfHandle object;
    require(NMR::lib3mf_model_addmeshobject(model_.get(), object.out()), model_);
    add_geometry(object, mesh);
    if (has_texture(mesh))
      add_texture(object, mesh, number);
    else if (!mesh.colors.empty())
      add_colors(object, mesh);
    if (!mesh.name.empty())
      require(NMR::lib3mf_object_setnameutf8(object.get(), file::clean_name(mesh.name).c_str()),
              object);
    require(NMR::lib3mf_object_setuuidutf8(object.get(), uuid(2, number).c_str()), object);
    Lib3mfHandle item;
    require(NMR::lib3mf_model_addbuilditem(model_.get(), object.get(), nullptr, item.out()),
            model_);
    require(NMR::lib3mf_builditem_setuuidutf8(item.get(), uuid(3, number).c_str()), item);
  }

  void add_geometry(const Lib3mfHandle& object, const TriangleMesh& mesh) {
    std::vector<NMR::MODELMESHVERTEX> vertices(mesh.vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (int k = 0; k < 3; ++k)
        vertices[i].m_fPosition[k] =
            static_cast<float>(static_cast<double>(mesh.vertices[i][k]) * 1000.0);
    triangles_.clear();
    kept_.clear();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& t = mesh.triangles[i];
      if (is_degenerate(t)) continue;  // the format forbids it
      triangles_.push_back({{t[0], t[1], t[2]}});
      kept_.push_back(i);
    }
    if (triangles_.empty()) throw Lib3mfFailure("all triangles are degenerate");
    require(NMR::lib3mf_meshobject_setgeometry(
                object.get(), vertices.data(), static_cast<unsigned>(vertices.size()),
                triangles_.data(), static_cast<unsigned>(triangles_.size())),
            object);
  }

  /// A colour group; its first colour is the default property, which the format requires.
  void add_colors(const Lib3mfHandle& object, const TriangleMesh& mesh) {
    std::vector<NMR::MODELMESH_TRIANGLECOLOR_SRGB> colors(triangles_.size());
    for (std::size_t i = 0; i < colors.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const Rgb c = mesh.colors[triangles_[i].m_nIndices[k]];
        colors[i].m_Colors[k] = {c.r, c.g, c.b, 255};
      }
    Lib3mfHandle handler;
    require(NMR::lib3mf_meshobject_createpropertyhandler(object.get(), handler.out()), object);
    require(NMR::lib3mf_propertyhandler_setgradientcolorarray(handler.get(), colors.data()),
            handler);
    Lib3mfHandle fallback;
    require(NMR::lib3mf_object_createdefaultpropertyhandler(object.get(), fallback.out()), object);
    require(NMR::lib3mf_defaultpropertyhandler_setcolor(fallback.get(), &colors[0].m_Colors[0]),
            fallback);
  }

  /// An image in the package, whose origin is the lower left corner. The default property is the
  /// texture coordinate of the first corner.
  void add_texture(const Lib3mfHandle& object, const TriangleMesh& mesh, std::size_t number) {
    const auto png = encode_color_png(mesh.texture->image);
    if (!png) throw Lib3mfFailure(png.error().message);
    std::string path = fmt::format("/3D/Textures/texture{}.png", number + 1);
    std::string relation = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dtexture";
    Lib3mfHandle attachment, texture;
    require(NMR::lib3mf_model_addattachmentutf8(model_.get(), path.data(), relation.data(),
                                                attachment.out()),
            model_);
    auto* bytes = reinterpret_cast<unsigned char*>(const_cast<char*>(png->data()));
    require(NMR::lib3mf_attachment_readfrombuffer(attachment.get(), bytes, png->size()),
            attachment);
    require(
        NMR::lib3mf_model_addtexture2dfromattachment(model_.get(), attachment.get(), texture.out()),
        model_);
    require(NMR::lib3mf_texture2d_setcontenttype(texture.get(), NMR::MODELTEXTURETYPE_PNG),
            texture);
    DWORD id = 0;
    require(NMR::lib3mf_resource_getresourceid(texture.get(), &id), texture);
    std::vector<NMR::MODELMESHTEXTURE2D> uvs(triangles_.size());
    for (std::size_t i = 0; i < uvs.size(); ++i) {
      uvs[i].m_nTextureID = id;
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector2f& p = mesh.texture->corners[kept_[i]][k];
        uvs[i].m_fU[k] = p.x();
        uvs[i].m_fV[k] = 1.0F - p.y();
      }
    }
    Lib3mfHandle handler, fallback;
    require(NMR::lib3mf_meshobject_createpropertyhandler(object.get(), handler.out()), object);
    require(NMR::lib3mf_propertyhandler_settexturearray(handler.get(), uvs.data()), handler);
    require(NMR::lib3mf_object_createdefaultpropertyhandler(object.get(), fallback.out()), object);
    require(NMR::lib3mf_defaultpropertyhandler_settexture(fallback.get(), id, uvs[0].m_fU[0],
                                                          uvs[0].m_fV[0]),
            fallback);
  }

  Lib3mfHandle model_;
  std::vector<NMR::MODELMESHTRIANGLE> triangles_;  ///< of the mesh being added
  std::vector<std::size_t> kept_;                  ///< their indices in it
};

}  // namespace

Result<> write_3mf(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame) {
  const ClassicStreams points(meshes);
  try {
    const std::string bytes = Writer(meshes, frame).write();
    if (bytes.empty()) return fail(ErrorCode::kLibrary, "lib3mf wrote nothing");
    return sink.write(bytes);
  } catch (const Lib3mfFailure& failure) {
    return fail(ErrorCode::kLibrary, "cannot write 3MF: {}", failure.what());
  }
}

}  // namespace turnscan::mesh_io
