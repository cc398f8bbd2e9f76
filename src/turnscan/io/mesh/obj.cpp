#include <algorithm>
#include <limits>
#include <string>
#include <turnscan/io/file/read_budget.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/text/number_text.hpp>
#include <unordered_map>

namespace turnscan::mesh_io {

namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
/// Bytes that an object takes beside its triangles, with what is said of it.
constexpr std::uint64_t kObjectHeld = 1024;

/// Content of the file; objects are ranges of triangles.
struct ObjContent {
  struct Object {
    std::string name;
    std::size_t first_triangle = 0;
  };
  std::vector<Vec3f> vertices;
  std::vector<Rgb> colors;  ///< of the vertices so far, while all of them have one
  std::vector<Vec3f> normals;
  std::vector<std::uint32_t> normal_of;  ///< per vertex, kNone if no face specifies it
  bool one_normal_each = true;           ///< no vertex has different normals in different faces
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Object> objects;
  std::vector<Eigen::Vector2f> uvs;  ///< in images, relative to the lower left corner
  std::vector<std::array<std::uint32_t, 3>> uv_of;  ///< per triangle, kNone if no face specifies it
  std::vector<std::uint32_t> material_of;           ///< per triangle
  std::vector<std::string> materials{""}, libraries;
};

class ObjReader {
 public:
  explicit ObjReader(std::string_view bytes) : cursor_(bytes), budget_(bytes.size()) {
    content_.objects.emplace_back();
  }

  Result<ObjContent> read() {
    for (cursor_.skip_space(); !cursor_.at_end(); cursor_.skip_space()) {
      if (const char* why = statement(cursor_.word()))
        return fail(ErrorCode::kFormat, "damaged at line {}: {}", cursor_.line_number(), why);
      cursor_.skip_line();
    }
    TURNSCAN_TRY(budget_.state());
    return std::move(content_);
  }

 private:
  const char* statement(std::string_view word) {
    if (word == "v") return vertex();
    if (word == "vn") return normal();
    if (word == "f") return face();
    if (word == "o") return object();
    if (word == "vt") return place();
    if (word == "usemtl") use_material(std::string(cursor_.rest_of_line()));
    if (word == "mtllib") content_.libraries.emplace_back(cursor_.rest_of_line());
    return nullptr;  // groups, curves
  }

  const char* object() {
    if (content_.objects.back().first_triangle != content_.triangles.size()) {
      if (!budget_.hold(kObjectHeld)) return nullptr;  // read() tells
      content_.objects.emplace_back();
    }
    content_.objects.back() = {std::string(cursor_.rest_of_line()), content_.triangles.size()};
    return nullptr;
  }

  const char* vertex() {
    if (content_.vertices.size() >= std::numeric_limits<std::int32_t>::max())
      return "too many vertices";
    std::array<float, 8> value{};
    std::size_t count = 0;
    for (cursor_.skip_blanks(); count < 8 && !cursor_.at_line_end(); cursor_.skip_blanks())
      if (!cursor_.floating(value[count++])) return "not a number";
    if (count < 3) return "a vertex without three coordinates";
    if (count >= 6 && content_.colors.size() == content_.vertices.size())
      content_.colors.push_back(color_from(&value[count - 3]));
    content_.vertices.emplace_back(value[0], value[1], value[2]);
    content_.normal_of.push_back(kNone);
    return nullptr;
  }

  static Rgb color_from(const float* rgb) {
    const auto byte = [](float v) {
      return v > 0.0F ? static_cast<std::uint8_t>(std::min(v, 1.0F) * 255.0F + 0.5F)
                      : std::uint8_t(0);
    };
    return {byte(rgb[0]), byte(rgb[1]), byte(rgb[2])};
  }

  const char* normal() {
    Vec3f n;
    for (int i = 0; i < 3; ++i)
      if (!cursor_.floating(n[i])) return "not a number";
    content_.normals.push_back(n);
    return nullptr;
  }

  const char* place() {
    Eigen::Vector2f at;
    for (int i = 0; i < 2; ++i)
      // A single number is a coordinate in a 1D texture.
      if (!cursor_.floating(at[i])) at[i] = 0.0F;
    content_.uvs.push_back(at);
    return nullptr;
  }

  void use_material(std::string name) {
    auto& all = content_.materials;
    const auto [known, fresh] = number_of_.try_emplace(name, std::uint32_t(all.size()));
    material_ = known->second;
    if (fresh) all.push_back(std::move(name));
  }

  const char* face() {
    polygon_.clear();
    polygon_uvs_.clear();
    for (cursor_.skip_blanks(); !cursor_.at_line_end(); cursor_.skip_blanks())
      if (const char* why = corner(cursor_.word())) return why;
    if (polygon_.size() < 3) return "a face without three vertices";
    for (std::size_t i = 2; i < polygon_.size(); ++i) {
      content_.triangles.push_back({polygon_[0], polygon_[i - 1], polygon_[i]});
      content_.uv_of.push_back({polygon_uvs_[0], polygon_uvs_[i - 1], polygon_uvs_[i]});
      content_.material_of.push_back(material_);
    }
    return nullptr;
  }

  /// v, v/vt, v//vn or v/vt/vn; negative numbers count back from the last one.
  const char* corner(std::string_view text) {
    const std::size_t slash = text.find('/');
    const std::uint32_t vertex = index(text.substr(0, slash), content_.vertices.size());
    if (vertex == kNone) return "the index of a vertex is out of range";
    polygon_.push_back(vertex);
    const std::size_t second = slash == std::string_view::npos ? slash : text.find('/', slash + 1);
    polygon_uvs_.push_back(
        slash == std::string_view::npos
            ? kNone
            : index(text.substr(slash + 1,
                                second == std::string_view::npos ? second : second - slash - 1),
                    content_.uvs.size()));
    if (second == std::string_view::npos) return nullptr;
    const std::uint32_t normal = index(text.substr(second + 1), content_.normals.size());
    if (normal == kNone) return "the index of a normal is out of range";
    std::uint32_t& known = content_.normal_of[vertex];
    content_.one_normal_each &=
        known == kNone || known == normal || content_.normals[known] == content_.normals[normal];
    known = normal;
    return nullptr;
  }

  static std::uint32_t index(std::string_view text, std::size_t count) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return kNone;
    const auto limit = static_cast<std::int64_t>(count);
    if (value < 0) value += limit + 1;
    return value < 1 || value > limit ? kNone : static_cast<std::uint32_t>(value - 1);
  }

  text::TextCursor cursor_;
  file::ReadBudget budget_;
  ObjContent content_;
  std::vector<std::uint32_t> polygon_, polygon_uvs_;
  std::unordered_map<std::string, std::uint32_t> number_of_{{"", 0}};  ///< of each material
  std::uint32_t material_ = 0;
};

std::vector<Vec3f> normals_per_vertex(const ObjContent& content) {
  const auto none = [](std::uint32_t n) { return n == kNone; };
  if (!content.one_normal_each || content.normals.empty() ||
      std::any_of(content.normal_of.begin(), content.normal_of.end(), none))
    return {};
  std::vector<Vec3f> normals;
  normals.reserve(content.vertices.size());
  for (const std::uint32_t n : content.normal_of) normals.push_back(content.normals[n]);
  return normals;
}

TriangleMesh whole_mesh(ObjContent&& content) {
  TriangleMesh mesh;
  mesh.normals = normals_per_vertex(content);
  if (content.colors.size() == content.vertices.size()) mesh.colors = std::move(content.colors);
  mesh.vertices = std::move(content.vertices);
  mesh.triangles = std::move(content.triangles);
  mesh.name = content.objects.front().name;
  return mesh;
}

/// Extracts triangles [begin, end) from a mesh, with the vertices that they use, in their order.
class Cutter {
 public:
  explicit Cutter(const TriangleMesh& mesh) : mesh_(mesh), place_(mesh.vertices.size(), kNone) {}

  TriangleMesh cut(std::size_t begin, std::size_t end, std::string name) {
    used_.clear();
    for (std::size_t i = begin; i < end; ++i)
      for (const std::uint32_t v : mesh_.triangles[i]) use(v);
    std::sort(used_.begin(), used_.end());
    TriangleMesh part;
    part.name = std::move(name);
    for (const std::uint32_t v : used_) copy_vertex(v, part);
    for (std::size_t i = begin; i < end; ++i) {
      const auto& t = mesh_.triangles[i];
      part.triangles.push_back({place_[t[0]], place_[t[1]], place_[t[2]]});
    }
    for (const std::uint32_t v : used_) place_[v] = kNone;
    return part;
  }

 private:
  void use(std::uint32_t vertex) {
    if (place_[vertex] != kNone) return;
    place_[vertex] = 0;
    used_.push_back(vertex);
  }

  void copy_vertex(std::uint32_t vertex, TriangleMesh& part) {
    place_[vertex] = static_cast<std::uint32_t>(part.vertices.size());
    part.vertices.push_back(mesh_.vertices[vertex]);
    if (!mesh_.normals.empty()) part.normals.push_back(mesh_.normals[vertex]);
    if (!mesh_.colors.empty()) part.colors.push_back(mesh_.colors[vertex]);
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> place_;  ///< kNone except during cut()
  std::vector<std::uint32_t> used_;
};

/// Texture coordinates of the triangles [begin, end), if all have them and use one material.
ObjTexCoords uvs_of(const ObjContent& content, std::size_t begin, std::size_t end) {
  ObjTexCoords out;
  for (std::size_t t = begin; t < end; ++t) {
    const auto& place = content.uv_of[t];
    if (content.material_of[t] != content.material_of[begin] ||
        std::find(place.begin(), place.end(), kNone) != place.end())
      return {};
    auto& corners = out.corners.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2f& p = content.uvs[place[k]];
      corners[k] = {p.x(), 1.0F - p.y()};
      if (!corners[k].allFinite()) return {};
    }
  }
  if (begin < end) out.material = content.materials[content.material_of[begin]];
  return out;
}

std::vector<TriangleMesh> objects_of(ObjContent&& content, std::vector<ObjTexCoords>& uvs) {
  auto objects = std::move(content.objects);
  if (objects.size() > 1 && objects.back().first_triangle == content.triangles.size())
    objects.pop_back();
  std::vector<TriangleMesh> meshes;
  const std::size_t count = objects.size();
  content.objects = objects;
  for (std::size_t i = 0; i < count; ++i)
    uvs.push_back(uvs_of(content, objects[i].first_triangle,
                         i + 1 < count ? objects[i + 1].first_triangle : content.triangles.size()));
  TriangleMesh whole = whole_mesh(std::move(content));
  if (count == 1) {
    meshes.push_back(std::move(whole));
    return meshes;
  }
  Cutter cutter(whole);
  for (std::size_t i = 0; i < count; ++i)
    meshes.push_back(
        cutter.cut(objects[i].first_triangle,
                   i + 1 < count ? objects[i + 1].first_triangle : whole.triangles.size(),
                   std::move(objects[i].name)));
  return meshes;
}

/// A backslash at the end of a line joins it with the next.
std::string join_lines(std::string_view bytes) {
  std::string text(bytes);
  for (std::size_t i = text.find('\\'); i != std::string::npos; i = text.find('\\', i + 1)) {
    std::size_t end = i + 1;
    if (end < text.size() && text[end] == '\r') ++end;
    if (end < text.size() && text[end] == '\n')
      std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(i), end - i + 1, ' ');
  }
  return text;
}

/// As marked by write_obj() at the beginning of the file.
file::FileFrame frame_of(std::string_view bytes) {
  constexpr std::string_view kStart = "# turnscan, unit metre, ";
  return bytes.starts_with(kStart) ? file::frame_of_mark(bytes.substr(kStart.size()))
                                   : file::FileFrame();
}

}  // namespace

Result<ObjObjects> parse_obj(std::string_view bytes) {
  const std::string joined = bytes.find('\\') == bytes.npos ? std::string() : join_lines(bytes);
  TURNSCAN_ASSIGN(ObjContent content, ObjReader(joined.empty() ? bytes : joined).read());
  ObjObjects out;
  out.libraries = std::move(content.libraries);
  file::from_file(frame_of(bytes), content.vertices, content.normals);
  out.meshes = objects_of(std::move(content), out.uvs);
  return out;
}

Meshes decode_obj(std::string_view bytes) {
  TURNSCAN_ASSIGN(ObjObjects objects, parse_obj(bytes));
  return std::move(objects.meshes);
}

}  // namespace turnscan::mesh_io
