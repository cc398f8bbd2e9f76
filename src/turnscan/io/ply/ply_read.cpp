#include <limits>
#include <turnscan/io/file/file_frame.hpp>
#include <turnscan/io/ply/ply_body.hpp>
#include <turnscan/io/ply/ply_read.hpp>
#include <turnscan/io/text/number_text.hpp>

namespace turnscan::ply {

namespace {

using Names = std::initializer_list<std::string_view>;
using Kind = PlyColumn::Kind;

/// Collects the columns of the vertices that exist in the file.
class VertexColumns {
 public:
  VertexColumns(const PlyElement& element, PlyWanted& wanted)
      : element_(element), wanted_(wanted) {}

  /// Adds the properties if the file has all of them as scalars, and allocates memory for them.
  template <class T>
  bool add(std::vector<T>& target, Kind kind, std::initializer_list<Names> properties) {
    std::vector<int> found;
    for (const Names& names : properties) {
      const int position = element_.find(names);
      if (position < 0 || element_.properties[static_cast<std::size_t>(position)].is_list)
        return false;
      found.push_back(position);
    }
    if (element_.count == 0) return true;
    target.resize(element_.count);
    char* first = reinterpret_cast<char*>(target.data());
    const std::size_t step = sizeof(T) / found.size();
    for (std::size_t i = 0; i < found.size(); ++i)
      wanted_.columns.push_back(
          {static_cast<std::size_t>(found[i]), kind, first + i * step, sizeof(T)});
    return true;
  }

 private:
  const PlyElement& element_;
  PlyWanted& wanted_;
};

Result<PlyWanted> want_vertices(const PlyElement& element, PointCloud& cloud) {
  if (element.count > std::numeric_limits<std::int32_t>::max())
    return fail(ErrorCode::kResourceLimit, "{} vertices: at most {} are allowed", element.count,
                std::numeric_limits<std::int32_t>::max());
  PlyWanted wanted;
  VertexColumns columns(element, wanted);
  if (!columns.add(cloud.points, Kind::kFloat, {{"x"}, {"y"}, {"z"}}))
    return fail(ErrorCode::kFormat, "the vertices have no x, y and z");
  columns.add(cloud.normals, Kind::kFloat,
              {{"nx", "normal_x"}, {"ny", "normal_y"}, {"nz", "normal_z"}});
  columns.add(cloud.colors, Kind::kColor,
              {{"red", "r", "diffuse_red"},
               {"green", "g", "diffuse_green"},
               {"blue", "b", "diffuse_blue"}});
  if (!columns.add(cloud.weights, Kind::kFloat, {{"weight"}}))
    columns.add(cloud.weights, Kind::kFloat, {{"quality"}});
  columns.add(cloud.frame, Kind::kIndex, {{"frame"}});
  return wanted;
}

int index_list(const PlyElement& element) {
  const int position = element.find({"vertex_indices", "vertex_index"});
  if (position < 0) return -1;
  const PlyProperty& property = element.properties[static_cast<std::size_t>(position)];
  return property.is_list && !is_floating(property.type) ? position : -1;
}

Result<PlyWanted> want_faces(const PlyElement& element, std::uint64_t vertices,
                             std::vector<std::array<std::uint32_t, 3>>& triangles) {
  PlyWanted wanted;
  wanted.list = index_list(element);
  if (wanted.list < 0)
    return fail(ErrorCode::kFormat, "the faces have no list of integers named vertex_indices");
  triangles.reserve(element.count);
  const auto limit = static_cast<std::int64_t>(vertices);
  wanted.on_list = [&triangles, limit](std::span<const std::int64_t> list) -> const char* {
    for (const std::int64_t index : list)
      if (index < 0 || index >= limit) return "the index of a vertex is out of range";
    for (std::size_t i = 2; i < list.size(); ++i)
      triangles.push_back({static_cast<std::uint32_t>(list[0]),
                           static_cast<std::uint32_t>(list[i - 1]),
                           static_cast<std::uint32_t>(list[i])});
    return nullptr;
  };
  return wanted;
}

Result<PlyWanted> want_grid(const PlyElement& element, std::uint64_t vertices,
                            std::vector<std::int32_t>& grid) {
  PlyWanted wanted;
  wanted.list = index_list(element);
  if (wanted.list < 0)
    return fail(ErrorCode::kFormat, "the range grid has no list of integers named vertex_indices");
  grid.reserve(element.count);
  const auto limit = static_cast<std::int64_t>(vertices);
  wanted.on_list = [&grid, limit](std::span<const std::int64_t> list) -> const char* {
    if (list.size() > 1) return "a cell of the range grid holds several vertices";
    if (!list.empty() && (list[0] < 0 || list[0] >= limit))
      return "the index of a vertex is out of range";
    grid.push_back(list.empty() ? -1 : static_cast<std::int32_t>(list[0]));
    return nullptr;
  };
  return wanted;
}

/// Reads "obj_info num_cols N" and num_rows.
Result<> read_grid_size(const PlyHeader& header, std::uint64_t cells, PlyContent& content) {
  std::int64_t columns = 0;
  std::int64_t rows = 0;
  const bool known = text::TextCursor(header.info("num_cols")).integer(columns) &&
                     text::TextCursor(header.info("num_rows")).integer(rows);
  const auto cells_signed = static_cast<std::int64_t>(cells);
  if (!known || cells > std::numeric_limits<std::int32_t>::max() || columns < 1 || rows < 1 ||
      columns > cells_signed || rows > cells_signed || columns * rows != cells_signed)
    return fail(ErrorCode::kFormat,
                "the range grid has {} cells, which is not num_cols x num_rows of the header ('{}' "
                "x '{}')",
                cells, header.info("num_cols"), header.info("num_rows"));
  content.grid_width = static_cast<int>(columns);
  content.grid_height = static_cast<int>(rows);
  return {};
}

std::optional<Viewpoint> viewpoint_of(const PlyHeader& header) {
  for (const bool parallel : {false, true}) {
    text::TextCursor cursor(header.info(parallel ? "view_direction" : "viewpoint"));
    Viewpoint viewpoint;
    viewpoint.parallel = parallel;
    if (cursor.floating(viewpoint.value.x()) && cursor.floating(viewpoint.value.y()) &&
        cursor.floating(viewpoint.value.z()) && viewpoint.value.allFinite())
      return viewpoint;
  }
  return std::nullopt;
}

Result<PlyWanted> want(const PlyElement& element, PlyParts parts, std::uint64_t vertices,
                       PlyContent& content) {
  if (element.name == "vertex") return want_vertices(element, content.cloud);
  if (element.name == "face" && parts == PlyParts::kFaces)
    return want_faces(element, vertices, content.triangles);
  if (element.name == "range_grid" && parts == PlyParts::kGrid)
    return want_grid(element, vertices, content.grid);
  return PlyWanted();
}

}  // namespace

Result<PlyContent> parse_ply(std::string_view bytes, PlyParts parts) {
  TURNSCAN_ASSIGN(const PlyHeader header, parse_ply_header(bytes));
  const PlyElement* vertex = header.find("vertex");
  if (vertex == nullptr) return fail(ErrorCode::kFormat, "the file has no element 'vertex'");
  PlyContent content;
  content.end = header.body;
  for (const PlyElement& element : header.elements) {
    TURNSCAN_ASSIGN(const PlyWanted wanted, want(element, parts, vertex->count, content));
    TURNSCAN_ASSIGN(content.end,
                    read_ply_element(bytes, content.end, header.format, element, wanted));
  }
  const PlyElement* grid = header.find("range_grid");
  if (parts == PlyParts::kGrid && grid != nullptr && grid->count > 0)
    TURNSCAN_TRY(read_grid_size(header, grid->count, content));
  content.viewpoint = viewpoint_of(header);
  file::from_file(file::frame_of_mark(header.info("frame")), content.cloud.points,
                  content.cloud.normals);
  content.name = std::string(header.info("name"));
  return content;
}

}  // namespace turnscan::ply
