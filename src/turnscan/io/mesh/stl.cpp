#include <algorithm>
#include <bit>
#include <cstring>
#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/vertex_merger.hpp>
#include <turnscan/io/text/number_text.hpp>

namespace turnscan::mesh_io {

namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of text, 4 of the count
constexpr std::size_t kTriangleBytes = 50;
constexpr std::string_view kHeader = "binary STL by turnscan, unit millimetre";
constexpr bool kSwap = std::endian::native == std::endian::big;

bool same_word(std::string_view word, std::string_view lower) {
  return word.size() == lower.size() &&
         std::equal(word.begin(), word.end(), lower.begin(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

std::uint64_t promised_triangles(std::string_view bytes) {
  return bytes.size() < kHeaderBytes ? 0 : file::load<std::uint32_t, kSwap>(bytes.data() + 80);
}

/// A binary file may also begin with "solid": its length decides, and what follows the first line.
bool is_text(std::string_view bytes) {
  if (bytes.size() >= kHeaderBytes &&
      bytes.size() == kHeaderBytes + promised_triangles(bytes) * kTriangleBytes)
    return false;
  text::TextCursor cursor(bytes.substr(0, 4096));
  cursor.skip_space();
  if (!same_word(cursor.word(), "solid")) return false;
  cursor.skip_line();
  cursor.skip_space();
  const std::string_view next = cursor.word();
  return same_word(next, "facet") || same_word(next, "endsolid");
}

file::FileFrame frame_in_header(std::string_view bytes) {
  const std::string_view text = bytes.substr(0, 80);
  const std::size_t mark = kHeader.size() + 2;
  return text.starts_with(kHeader) ? file::frame_of_mark(text.substr(mark)) : file::FileFrame();
}

Meshes decode_binary(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes)
    return fail(ErrorCode::kFormat, "not an STL file: it has only {} bytes", bytes.size());
  const std::uint64_t count = promised_triangles(bytes);
  if (count > (bytes.size() - kHeaderBytes) / kTriangleBytes)
    return fail(ErrorCode::kFormat,
                "not an STL file, or it is cut short: {} triangles do not fit into {} bytes", count,
                bytes.size());
  std::vector<TriangleMesh> meshes(1);
  meshes[0].triangles.resize(count);
  VertexMerger merger(count / 2);
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* from = bytes.data() + kHeaderBytes + i * kTriangleBytes + 12;  // after the normal
    for (std::uint32_t& corner : meshes[0].triangles[i]) {
      corner = merger.index_of({file::load<float, kSwap>(from), file::load<float, kSwap>(from + 4),
                                file::load<float, kSwap>(from + 8)});
      from += 12;
    }
  }
  meshes[0].vertices = merger.take();
  file::from_file(frame_in_header(bytes), meshes[0].vertices, meshes[0].normals);
  return meshes;
}

class TextReader {
 public:
  explicit TextReader(std::string_view bytes) : cursor_(bytes) {}

  Meshes read() {
    for (cursor_.skip_space(); !cursor_.at_end(); cursor_.skip_space()) {
      if (const char* why = statement(cursor_.word()))
        return fail(ErrorCode::kFormat, "damaged at line {}: {}", cursor_.line_number(), why);
      cursor_.skip_line();
    }
    if (open_) return fail(ErrorCode::kFormat, "the file ends within a solid");
    return std::move(meshes_);
  }

 private:
  const char* statement(std::string_view word) {
    if (same_word(word, "vertex")) return vertex();
    if (same_word(word, "solid")) return begin_solid();
    if (!open_) return "something outside of a solid";
    if (same_word(word, "facet")) {
      corners_ = 0;
      return nullptr;
    }
    if (same_word(word, "endfacet")) return end_facet();
    if (same_word(word, "endsolid")) return end_solid();
    return same_word(word, "outer") || same_word(word, "endloop") ? nullptr : "an unknown word";
  }

  const char* begin_solid() {
    if (open_) return "a solid within a solid";
    open_ = true;
    if (meshes_.empty() || !meshes_.back().empty()) meshes_.emplace_back();
    meshes_.back().name = std::string(cursor_.rest_of_line());
    merger_ = VertexMerger(0);
    return nullptr;
  }

  const char* end_solid() {
    // Corners are indexed within this solid.
    if (corners_ != 0) return "a solid ends within a facet";
    open_ = false;
    meshes_.back().vertices = merger_.take();
    return nullptr;
  }

  const char* vertex() {
    if (!open_ || corners_ == 3) return "a vertex that belongs to no triangle";
    Vec3f point;
    for (int i = 0; i < 3; ++i)
      if (!cursor_.floating(point[i])) return "not a number";
    triangle_[corners_++] = merger_.index_of(point);
    return nullptr;
  }

  const char* end_facet() {
    if (corners_ != 3) return "a facet without three vertices";
    meshes_.back().triangles.push_back(triangle_);
    corners_ = 0;
    return nullptr;
  }

  text::TextCursor cursor_;
  std::vector<TriangleMesh> meshes_;
  VertexMerger merger_{0};
  std::array<std::uint32_t, 3> triangle_{};
  std::size_t corners_ = 0;
  bool open_ = false;
};

template <class T>
void put(std::string& text, T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (kSwap) std::reverse(bytes.begin(), bytes.end());
  text.append(bytes.data(), bytes.size());
}

void put_vector(std::string& text, const Vec3d& v) {
  for (int i = 0; i < 3; ++i) put(text, static_cast<float>(v[i]));
}

Result<> write_triangles(FileSink& sink, const TriangleMesh& mesh) {
  std::string row;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = mesh.vertices[triangle[i]].cast<double>() * 1000.0;
    row.clear();
    put_vector(row, (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized());
    for (const Vec3d& corner : corners) put_vector(row, corner);
    put(row, std::uint16_t(0));
    TURNSCAN_TRY(sink.write(row));
  }
  return {};
}

}  // namespace

Meshes decode_stl(std::string_view bytes) {
  return is_text(bytes) ? TextReader(bytes).read() : decode_binary(bytes);
}

Result<> write_stl(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame) {
  std::uint64_t count = 0;
  for (const TriangleMesh& mesh : meshes) count += mesh.triangles.size();
  if (count > 0xffffffffU)
    return fail(ErrorCode::kUnsupported, "STL cannot hold {} triangles; write PLY", count);
  std::string header(kHeader);
  if (frame.z_up) header += ", " + file::mark_of(frame, 1000.0);
  header.resize(80, ' ');
  put(header, static_cast<std::uint32_t>(count));
  TURNSCAN_TRY(sink.write(header));
  for (const TriangleMesh& mesh : meshes) TURNSCAN_TRY(write_triangles(sink, mesh));
  return {};
}

}  // namespace turnscan::mesh_io
