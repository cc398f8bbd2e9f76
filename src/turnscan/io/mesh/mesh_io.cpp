#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/decode_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/file/file_name.hpp>
#include <turnscan/io/mesh/mesh_convert.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/io/mesh/obj_material.hpp>

namespace turnscan {

namespace fs = std::filesystem;

namespace {

constexpr double kMetre = 1.0;
constexpr double kMillimetre = 0.001;

struct ReadFormat {
  std::string_view extension;
  double metres_per_unit;
  mesh_io::Meshes (*decode)(std::string_view);
};
constexpr std::array<ReadFormat, 4> kReadFormats{{{"ply", kMetre, mesh_io::decode_ply_mesh},
                                                  {"obj", kMetre, mesh_io::decode_obj},
                                                  {"stl", kMillimetre, mesh_io::decode_stl},
                                                  {"off", kMetre, mesh_io::decode_off}}};

struct WriteFormat {
  std::string_view extension;
  Result<> (*write)(FileSink&, std::span<const TriangleMesh>, const file::FileFrame&);
  bool for_printers = false;  ///< z is up by default, and with z up the object is placed on z = 0
};
constexpr std::array<WriteFormat, 5> kWriteFormats{{{"ply", mesh_io::write_ply_mesh},
                                                    {"obj", mesh_io::write_obj},
                                                    {"stl", mesh_io::write_stl, true},
                                                    {"3mf", mesh_io::write_3mf, true},
                                                    {"glb", mesh_io::write_glb}}};

template <class Formats>
auto find_format(const Formats& formats, const fs::path& path) {
  const std::string extension = file::lower_extension(path);
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [&](const auto& f) { return f.extension == extension; });
  return found == formats.end() ? nullptr : &*found;
}

/// Checks coordinates, scales to metres and removes objects without triangles.
mesh_io::Meshes finish(std::vector<TriangleMesh> meshes, double metres_per_unit) {
  std::erase_if(meshes, [](const TriangleMesh& mesh) { return mesh.empty(); });
  if (meshes.empty()) return fail(ErrorCode::kTooFewPoints, "the file holds no triangles");
  for (TriangleMesh& mesh : meshes) {
    if (metres_per_unit != 1.0)
      for (Vec3f& p : mesh.vertices) p = (p.cast<double>() * metres_per_unit).cast<float>();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      if (!mesh.vertices[i].allFinite())
        return fail(ErrorCode::kFormat, "the coordinates of vertex {} are not finite", i);
      if (const double distance = mesh.vertices[i].cwiseAbs().maxCoeff(); distance > kMaxDistance_m)
        return fail(ErrorCode::kFormat,
                    "vertex {} lies {:.3g} m from the origin, and at most {:.0f} km are read; "
                    "check the unit (--unit) or the file",
                    i, distance, kMaxDistance_m / 1000.0);
    }
  }
  return meshes;
}

mesh_io::Meshes read_foreign(const fs::path& path, std::optional<double> metres_per_unit,
                             const RunContext& ctx) {
  TURNSCAN_TRY(file::check_readable(path));
  auto meshes = mesh_io::read_in_child(path, metres_per_unit, ctx);
  if (meshes) meshes = finish(std::move(*meshes), kMetre);
  if (!meshes && meshes.error().path.empty()) meshes.error().path = path.string();
  return meshes;
}

void require_valid(const TriangleMesh& mesh) {
  const std::size_t n = mesh.vertices.size();
  if ((!mesh.normals.empty() && mesh.normals.size() != n) ||
      (!mesh.colors.empty() && mesh.colors.size() != n))
    throw std::invalid_argument("an attribute of a mesh must be empty or as long as its vertices");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t index : triangle)
      if (index >= n) throw std::invalid_argument("a triangle of a mesh refers to no vertex");
}

Result<> check_for_writing(const fs::path& path, std::span<const TriangleMesh> meshes) {
  for (const TriangleMesh& mesh : meshes) require_valid(mesh);
  if (meshes.empty() ||
      std::any_of(meshes.begin(), meshes.end(), [](const auto& mesh) { return mesh.empty(); }))
    return fail_at(path.string(), ErrorCode::kTooFewPoints, "there are no triangles to write");
  for (const TriangleMesh& mesh : meshes)
    for (const Vec3f& p : mesh.vertices)
      if (!p.allFinite())
        return fail_at(path.string(), ErrorCode::kFormat,
                       "the mesh has a vertex that is not finite");
  return {};
}

std::string writable_extensions() {
  std::string text;
  for (const WriteFormat& format : kWriteFormats) text += fmt::format(" .{}", format.extension);
  return text;
}

Result<const WriteFormat*> write_format(const fs::path& path) {
  if (const WriteFormat* format = find_format(kWriteFormats, path)) return format;
  return fail_at(path.string(), ErrorCode::kUnsupported,
                 "no mesh can be written under this name; give one that ends in one of{}",
                 writable_extensions());
}

Result<file::FileFrame> frame_for(const fs::path& path, const WriteFormat& format,
                                  std::span<const TriangleMesh> meshes, UpAxis up) {
  file::FileFrame frame;
  frame.z_up = up == UpAxis::kZ || (up == UpAxis::kFormat && format.for_printers);
  if (frame.z_up && format.extension == "glb")
    return fail_at(path.string(), ErrorCode::kInvalidOption,
                   "a .glb file has y up by its standard; leave --up out, or write another format");
  if (!frame.z_up || !format.for_printers) return frame;
  frame.base = std::numeric_limits<double>::infinity();
  for (const TriangleMesh& mesh : meshes)
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t i : triangle)
        frame.base = std::min(frame.base, double(mesh.vertices[i].y()));
  return frame;
}

std::vector<TriangleMesh> in_frame(const file::FileFrame& frame,
                                   std::span<const TriangleMesh> meshes) {
  std::vector<TriangleMesh> out(meshes.begin(), meshes.end());
  for (TriangleMesh& mesh : out) file::to_file(frame, mesh.vertices, mesh.normals);
  return out;
}

/// Writes checked meshes in the file's frame.
Result<> write_placed(const fs::path& path, const WriteFormat& format,
                      std::span<const TriangleMesh> meshes, const file::FileFrame& frame) {
  const auto beside = texture_files(path, meshes);
  if (beside.empty())
    return write_file_atomically(path,
                                 [&](FileSink& sink) { return format.write(sink, meshes, frame); });
  TURNSCAN_TRY(mesh_io::write_files_beside_obj(path, meshes));
  return write_file_atomically(path, [&](FileSink& sink) {
    return mesh_io::write_obj(sink, meshes, frame, beside.front().filename().string());
  });
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

Result<std::vector<TriangleMesh>> read_meshes(const fs::path& path, const ReadMeshOptions& options,
                                              const RunContext& ctx) {
  if (options.metres_per_unit &&
      !(*options.metres_per_unit > 0.0 && std::isfinite(*options.metres_per_unit)))
    throw std::invalid_argument("metres_per_unit must be positive and finite");
  TURNSCAN_TRY(ctx.check());
  const ReadFormat* format = find_format(kReadFormats, path);
  if (format == nullptr) return read_foreign(path, options.metres_per_unit, ctx);
  return file::decode_file(path, [&](std::string_view bytes) -> mesh_io::Meshes {
    TURNSCAN_ASSIGN(auto meshes, format->extension == "obj" ? mesh_io::read_obj(path, bytes)
                                                            : format->decode(bytes));
    return finish(std::move(meshes), options.metres_per_unit.value_or(format->metres_per_unit));
  });
}

Result<TriangleMesh> read_mesh(const fs::path& path, const ReadMeshOptions& options,
                               const RunContext& ctx) {
  TURNSCAN_ASSIGN(auto meshes, read_meshes(path, options, ctx));
  if (meshes.size() == 1) return std::move(meshes.front());
  return join_meshes(meshes);
}

OptionTable describe(WriteMeshOptions& o) {
  OptionTable table;
  table.choice("up", o.up, {"auto", "y", "z"},
               "Axis that points up in the mesh file. auto: z in .stl and .3mf, where the lowest "
               "point is then at z = 0, as slicers have it, else y");
  return table;
}

Result<> write_meshes(const fs::path& path, std::span<const TriangleMesh> meshes,
                      const WriteMeshOptions& options) {
  TURNSCAN_ASSIGN(const WriteFormat* format, write_format(path));
  TURNSCAN_TRY(check_for_writing(path, meshes));
  TURNSCAN_ASSIGN(const file::FileFrame frame, frame_for(path, *format, meshes, options.up));
  if (!frame.z_up) return write_placed(path, *format, meshes, frame);
  return write_placed(path, *format, in_frame(frame, meshes), frame);
}

std::vector<fs::path> texture_files(const fs::path& path, std::span<const TriangleMesh> meshes) {
  if (file::lower_extension(path) != "obj") return {};
  // Pipes and devices have no accompanying files.
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  return mesh_io::files_beside_obj(path, meshes);
}

bool holds_textures(const fs::path& path) {
  const std::string extension = file::lower_extension(path);
  return extension == "glb" || extension == "obj" || extension == "3mf";
}

Result<> write_mesh(const fs::path& path, const TriangleMesh& mesh,
                    const WriteMeshOptions& options) {
  return write_meshes(path, std::span(&mesh, 1), options);
}

Result<> write_mesh(const fs::path& path, const TriangleMesh& mesh,
                    std::span<const float> confidence, const WriteMeshOptions& options) {
  if (!confidence.empty() && confidence.size() != mesh.vertices.size())
    throw std::invalid_argument("write_mesh: the confidence does not fit the vertices");
  TURNSCAN_ASSIGN(const WriteFormat* format, write_format(path));
  if (confidence.empty() || format->extension != "ply") return write_mesh(path, mesh, options);
  TURNSCAN_TRY(check_for_writing(path, std::span(&mesh, 1)));
  TURNSCAN_ASSIGN(const file::FileFrame frame,
                  frame_for(path, *format, std::span(&mesh, 1), options.up));
  const auto placed =
      frame.z_up ? in_frame(frame, std::span(&mesh, 1)) : std::vector<TriangleMesh>();
  return write_file_atomically(path, [&](FileSink& sink) {
    return mesh_io::write_ply_mesh_with(sink, frame.z_up ? placed.front() : mesh, confidence,
                                        frame);
  });
}

Result<> check_mesh_output(const fs::path& path, const WriteMeshOptions& options) {
  TURNSCAN_ASSIGN(const WriteFormat* format, write_format(path));
  TURNSCAN_TRY(frame_for(path, *format, {}, options.up));
  std::error_code error;
  if (fs::is_directory(path, error))
    return fail_at(path.string(), ErrorCode::kIo, "cannot write: it is a folder");
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  TURNSCAN_ASSIGN(const bool there, file::is_there(folder));
  if (!there)
    return fail_at(path.string(), ErrorCode::kNotFound, "cannot write: there is no folder {}",
                   folder.string());
  if (!fs::is_directory(folder, error))
    return fail_at(path.string(), ErrorCode::kIo, "cannot write: {} is not a folder",
                   folder.string());
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return fail_at(path.string(), ErrorCode::kIo, "cannot write: the folder is not writable");
  return {};
}

TriangleMesh join_meshes(std::span<const TriangleMesh> meshes) {
  TriangleMesh joined;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(joined.vertices.size());
    append(joined.vertices, mesh.vertices);
    append(joined.normals, mesh.normals);
    append(joined.colors, mesh.colors);
    for (const auto& t : mesh.triangles)
      joined.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    if (joined.name.empty()) joined.name = mesh.name;
  }
  if (joined.normals.size() != joined.vertices.size()) joined.normals.clear();
  if (joined.colors.size() != joined.vertices.size()) joined.colors.clear();
  return joined;
}

}  // namespace turnscan
