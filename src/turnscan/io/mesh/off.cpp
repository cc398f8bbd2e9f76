// Object File Format of Geomview (www.geomview.org, manual, "OFF Files"), text form.

#include <limits>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/text/number_text.hpp>

namespace turnscan::mesh_io {

namespace {

class OffReader {
 public:
  explicit OffReader(std::string_view bytes) : size_(bytes.size()), cursor_(bytes) {}

  Meshes read() {
    skip_comments();
    TURNSCAN_TRY(keyword());
    std::int64_t vertices = 0;
    std::int64_t faces = 0;
    skip_comments();
    if (!cursor_.integer(vertices) || !cursor_.integer(faces)) return damaged("the counts");
    cursor_.skip_line();  // the number of edges may be omitted
    const auto left = static_cast<std::int64_t>(size_ - cursor_.position()) + 1;
    if (vertices < 0 || faces < 0 || vertices > left / 6 || faces > left / 2 ||
        vertices > std::numeric_limits<std::int32_t>::max())
      return fail(ErrorCode::kFormat,
                  "the file is too short: its header promises {} vertices and {} faces, and only "
                  "{} bytes are left",
                  vertices, faces, left - 1);
    mesh_.vertices.reserve(static_cast<std::size_t>(vertices));
    mesh_.triangles.reserve(static_cast<std::size_t>(faces));
    for (std::int64_t i = 0; i < vertices; ++i)
      if (!vertex()) return damaged("three coordinates");
    for (std::int64_t i = 0; i < faces; ++i)
      if (!face()) return damaged("the indices of a face, in range");
    return std::vector<TriangleMesh>{std::move(mesh_)};
  }

 private:
  tl::unexpected<Error> damaged(std::string_view what) const {
    return fail(ErrorCode::kFormat, "damaged at line {}: it should hold {}", cursor_.line_number(),
                what);
  }

  void skip_comments() {
    for (cursor_.skip_space(); cursor_.skip('#'); cursor_.skip_space()) cursor_.skip_line();
  }

  /// Colours, normals and texture (COFF, NOFF, STOFF) follow the coordinates and are skipped.
  Result<> keyword() {
    const std::string_view word = cursor_.word();
    for (const std::string_view known :
         {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"})
      if (word == known) {
        cursor_.skip_blanks();
        text::TextCursor ahead = cursor_;
        if (ahead.word() != "BINARY") return {};
      }
    return fail(ErrorCode::kUnsupported, "not an OFF file with text and three coordinates");
  }

  bool vertex() {
    skip_comments();
    Vec3f point;
    for (int i = 0; i < 3; ++i)
      if (!cursor_.floating(point[i])) return false;
    mesh_.vertices.push_back(point);
    cursor_.skip_line();
    return true;
  }

  bool index(std::uint32_t& value) {
    std::int64_t read = 0;
    if (!cursor_.integer(read) || read < 0 ||
        read >= static_cast<std::int64_t>(mesh_.vertices.size()))
      return false;
    value = static_cast<std::uint32_t>(read);
    return true;
  }

  bool face() {
    skip_comments();
    std::int64_t count = 0;
    if (!cursor_.integer(count) || count < 0) return false;
    std::array<std::uint32_t, 3> triangle{};
    for (std::int64_t i = 0; i < count; ++i) {
      if (!index(triangle[static_cast<std::size_t>(i < 2 ? i : 2)])) return false;
      if (i < 2) continue;
      mesh_.triangles.push_back(triangle);
      triangle[1] = triangle[2];
    }
    cursor_.skip_line();
    return true;
  }

  std::size_t size_;
  text::TextCursor cursor_;
  TriangleMesh mesh_;
};

}  // namespace

Meshes decode_off(std::string_view bytes) { return OffReader(bytes).read(); }

}  // namespace turnscan::mesh_io
