#include <algorithm>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/obj_material.hpp>

namespace turnscan::mesh_io {

namespace {

void append_vertex(fmt::memory_buffer& text, const TriangleMesh& mesh, std::size_t i) {
  const Vec3f& p = mesh.vertices[i];
  fmt::format_to(fmt::appender(text), "v {} {} {}", p.x(), p.y(), p.z());
  if (!mesh.colors.empty()) {
    const Rgb c = mesh.colors[i];
    constexpr float kStep = 1.0F / 255.0F;
    fmt::format_to(fmt::appender(text), " {:.6g} {:.6g} {:.6g}", float(c.r) * kStep,
                   float(c.g) * kStep, float(c.b) * kStep);
  }
  text.push_back('\n');
}

/// uvs: indices of the corners' texture coordinates, or nullptr.
void append_face(fmt::memory_buffer& text, const std::array<std::uint32_t, 3>& triangle,
                 std::uint64_t first, bool normals, const std::array<std::uint64_t, 3>* uvs) {
  text.push_back('f');
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint64_t number = first + triangle[k];
    if (uvs != nullptr && normals)
      fmt::format_to(fmt::appender(text), " {}/{}/{}", number, (*uvs)[k], number);
    else if (uvs != nullptr)
      fmt::format_to(fmt::appender(text), " {}/{}", number, (*uvs)[k]);
    else if (normals)
      fmt::format_to(fmt::appender(text), " {}//{}", number, number);
    else
      fmt::format_to(fmt::appender(text), " {}", number);
  }
  text.push_back('\n');
}

/// Calls append(text, i) for all i in [0, n).
template <class Append>
Result<> write_lines(FileSink& sink, std::size_t n, const Append& append) {
  fmt::memory_buffer text;
  for (std::size_t i = 0; i < n; ++i) {
    append(text, i);
    if (text.size() < 60000 && i + 1 < n) continue;
    TURNSCAN_TRY(sink.write(std::string_view(text.data(), text.size())));
    text.clear();
  }
  return {};
}

/// A backslash could join the line with the next.
std::string object_name(const TriangleMesh& mesh) {
  std::string name = file::clean_name(mesh.name);
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

}  // namespace

Result<> write_obj(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame, const std::string& library) {
  TURNSCAN_TRY(sink.write("# turnscan, unit metre"));
  if (frame.z_up) TURNSCAN_TRY(sink.write(", " + file::mark_of(frame)));
  TURNSCAN_TRY(sink.write("\n"));
  if (!library.empty()) TURNSCAN_TRY(sink.write("mtllib " + library + "\n"));
  // Normals use the indices of their vertices: either all objects have them or none.
  const bool normals = std::none_of(meshes.begin(), meshes.end(),
                                    [](const TriangleMesh& m) { return m.normals.empty(); });
  std::uint64_t first = 1, first_uv = 1;
  for (std::size_t number = 0; number < meshes.size(); ++number) {
    const TriangleMesh& mesh = meshes[number];
    if (meshes.size() > 1 || !mesh.name.empty())
      TURNSCAN_TRY(sink.write("o " + object_name(mesh) + "\n"));
    const std::size_t n = mesh.vertices.size();
    TURNSCAN_TRY(write_lines(sink, n, [&](auto& text, auto i) { append_vertex(text, mesh, i); }));
    TURNSCAN_TRY(write_lines(sink, normals ? n : 0, [&](auto& text, auto i) {
      const Vec3f& v = mesh.normals[i];
      fmt::format_to(fmt::appender(text), "vn {} {} {}\n", v.x(), v.y(), v.z());
    }));
    SplitMesh split;
    if (!library.empty() && has_texture(mesh)) split = split_at_seams(mesh);
    TURNSCAN_TRY(write_lines(sink, split.uvs.size(), [&](auto& text, auto i) {
      const Eigen::Vector2f& p = split.uvs[i];
      fmt::format_to(fmt::appender(text), "vt {} {}\n", p.x(), 1.0F - p.y());
    }));
    if (!split.uvs.empty()) TURNSCAN_TRY(sink.write("usemtl " + material_name(number) + "\n"));
    TURNSCAN_TRY(write_lines(sink, mesh.triangles.size(), [&](auto& text, auto i) {
      if (split.uvs.empty()) {
        append_face(text, mesh.triangles[i], first, normals, nullptr);
        return;
      }
      std::array<std::uint64_t, 3> uvs{};
      for (std::size_t k = 0; k < 3; ++k) uvs[k] = first_uv + split.mesh.triangles[i][k];
      append_face(text, mesh.triangles[i], first, normals, &uvs);
    }));
    first += n;
    first_uv += split.uvs.size();
  }
  return {};
}

Result<> write_obj(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame) {
  return write_obj(sink, meshes, frame, "");
}

}  // namespace turnscan::mesh_io
