#include <algorithm>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>

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

void append_face(fmt::memory_buffer& text, const std::array<std::uint32_t, 3>& triangle,
                 std::uint64_t first, bool normals) {
  text.push_back('f');
  for (const std::uint32_t v : triangle) {
    const std::uint64_t number = first + v;
    if (normals)
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

Result<> write_obj(FileSink& sink, std::span<const TriangleMesh> meshes) {
  TURNSCAN_TRY(sink.write("# turnscan, unit metre\n"));
  // Normals have the numbers of their vertices: all objects have them or none.
  const bool normals = std::none_of(meshes.begin(), meshes.end(),
                                    [](const TriangleMesh& m) { return m.normals.empty(); });
  std::uint64_t first = 1;
  for (const TriangleMesh& mesh : meshes) {
    if (meshes.size() > 1 || !mesh.name.empty())
      TURNSCAN_TRY(sink.write("o " + object_name(mesh) + "\n"));
    const std::size_t n = mesh.vertices.size();
    TURNSCAN_TRY(write_lines(sink, n, [&](auto& text, auto i) { append_vertex(text, mesh, i); }));
    TURNSCAN_TRY(write_lines(sink, normals ? n : 0, [&](auto& text, auto i) {
      const Vec3f& v = mesh.normals[i];
      fmt::format_to(fmt::appender(text), "vn {} {} {}\n", v.x(), v.y(), v.z());
    }));
    TURNSCAN_TRY(write_lines(sink, mesh.triangles.size(), [&](auto& text, auto i) {
      append_face(text, mesh.triangles[i], first, normals);
    }));
    first += n;
  }
  return {};
}

}  // namespace turnscan::mesh_io
