#include "view/drawable.hpp"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkQuadricClustering.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

#include "view/creases.hpp"
#include "view/drawable_parts.hpp"
#include "view/large_texture.hpp"
#include "view/picture_halves.hpp"

namespace turnscan::studio {

namespace {

constexpr double kCrease_rad = 0.7;             // between two faces; 40 degrees
constexpr std::size_t kCreasesBelow = 1000000;  // triangles; in larger meshes, edges are small

/// The k-th of n points is the one at k * stride modulo n: any range of them is spread over the
/// whole cloud.
std::uint64_t spread_stride(std::uint64_t n) {
  auto stride = static_cast<std::uint64_t>(0.6180339887498949 * double(n));
  while (stride > 1 && std::gcd(stride, n) != 1) --stride;
  return std::max<std::uint64_t>(stride, 1);
}

vtkSmartPointer<vtkPoints> make_points(const std::vector<Vec3f>& points) {
  vtkNew<vtkFloatArray> data;
  data->SetNumberOfComponents(3);
  data->SetNumberOfTuples(vtkIdType(points.size()));
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  if (!points.empty())
    std::memcpy(data->GetPointer(0), points.data(), points.size() * sizeof(Vec3f));
  auto out = vtkSmartPointer<vtkPoints>::New();
  out->SetData(data);
  return out;
}

vtkSmartPointer<vtkUnsignedCharArray> make_colors(const std::vector<Rgb>& colors) {
  auto out = vtkSmartPointer<vtkUnsignedCharArray>::New();
  out->SetNumberOfComponents(3);
  out->SetNumberOfTuples(vtkIdType(colors.size()));
  static_assert(sizeof(Rgb) == 3);
  if (!colors.empty()) std::memcpy(out->GetPointer(0), colors.data(), colors.size() * sizeof(Rgb));
  return out;
}

/// Cells of `size` indices each.
vtkSmartPointer<vtkCellArray> make_cells(const std::uint32_t* indices, std::size_t count,
                                         std::size_t size) {
  vtkNew<vtkTypeInt32Array> offsets, connectivity;
  offsets->SetNumberOfValues(vtkIdType(count + 1));
  for (std::size_t i = 0; i <= count; ++i) offsets->SetValue(vtkIdType(i), int(i * size));
  connectivity->SetNumberOfValues(vtkIdType(count * size));
  for (std::size_t i = 0; i < count * size; ++i)
    connectivity->SetValue(vtkIdType(i), static_cast<int>(indices[i]));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

vtkSmartPointer<vtkPolyData> make_chunk(const PointCloud& cloud, std::size_t begin, std::size_t end,
                                        std::uint64_t stride) {
  std::vector<Vec3f> points;
  std::vector<Rgb> colors;
  points.reserve(end - begin);
  const bool colored = !cloud.colors.empty();
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t i = std::size_t(k * stride % cloud.size());
    points.push_back(cloud.points[i]);
    if (colored) colors.push_back(cloud.colors[i]);
  }
  std::vector<std::uint32_t> indices(points.size());
  std::iota(indices.begin(), indices.end(), 0u);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(make_points(points));
  data->SetVerts(make_cells(indices.data(), 1, indices.size()));
  if (colored) data->GetPointData()->SetScalars(make_colors(colors));
  data->ComputeBounds();
  return data;
}

/// Gives every triangle separate vertices.
TriangleMesh exploded(const TriangleMesh& mesh) {
  TriangleMesh out;
  out.vertices.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    for (const std::uint32_t v : triangle) {
      out.vertices.push_back(mesh.vertices[v]);
      if (!mesh.colors.empty()) out.colors.push_back(mesh.colors[v]);
    }
    out.triangles.push_back({first, first + 1, first + 2});
    const Vec3f &a = out.vertices[first], &b = out.vertices[first + 1],
                &c = out.vertices[first + 2];
    const Vec3f normal = (b - a).cross(c - a).normalized();
    out.normals.insert(out.normals.end(), 3, normal);
  }
  return out;
}

vtkSmartPointer<vtkPolyData> make_surface(const TriangleMesh& mesh) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(make_points(mesh.vertices));
  if (!mesh.triangles.empty())
    data->SetPolys(make_cells(mesh.triangles.data()->data(), mesh.triangles.size(), 3));
  if (!mesh.colors.empty()) data->GetPointData()->SetScalars(make_colors(mesh.colors));
  const std::vector<Vec3f> normals = mesh.normals.empty() ? vertex_normals(mesh) : mesh.normals;
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName("Normals");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(vtkIdType(normals.size()));
  if (!normals.empty())
    std::memcpy(array->GetPointer(0), normals.data(), normals.size() * sizeof(Vec3f));
  data->GetPointData()->SetNormals(array);
  data->ComputeBounds();
  return data;
}

/// Each vertex with its texture coordinate; split at the seams of the texture, across which the
/// normals of the mesh continue.
vtkSmartPointer<vtkPolyData> make_textured(const TriangleMesh& mesh) {
  const SplitMesh split = split_at_seams(mesh);
  auto data = make_surface(split.mesh);
  vtkNew<vtkFloatArray> uvs;
  uvs->SetName("Places");
  uvs->SetNumberOfComponents(2);
  uvs->SetNumberOfTuples(vtkIdType(split.uvs.size()));
  static_assert(sizeof(Eigen::Vector2f) == 2 * sizeof(float));
  if (!split.uvs.empty())
    std::memcpy(uvs->GetPointer(0), split.uvs.data(), split.uvs.size() * sizeof(Eigen::Vector2f));
  data->GetPointData()->SetTCoords(uvs);
  return data;
}

/// Refers to the pixels. Rows start at the top, like texture coordinates: (0, 0) is the upper left
/// corner.
vtkSmartPointer<vtkImageData> make_picture(const ColorImage& image) {
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetNumberOfComponents(3);
  // VTK only reads them.
  auto* first = const_cast<unsigned char*>(&image.pixels.front().r);
  pixels->SetArray(first, vtkIdType(3 * image.pixels.size()), 1);
  auto out = vtkSmartPointer<vtkImageData>::New();
  out->SetDimensions(image.width, image.height, 1);
  out->GetPointData()->SetScalars(pixels);
  return out;
}

vtkSmartPointer<vtkPolyData> make_coarse(vtkPolyData* surface) {
  vtkNew<vtkQuadricClustering> clustering;
  clustering->SetInputData(surface);
  clustering->SetNumberOfDivisions(96, 96, 96);
  clustering->AutoAdjustNumberOfDivisionsOn();
  clustering->CopyCellDataOff();
  clustering->Update();
  auto out = vtkSmartPointer<vtkPolyData>::New();
  out->ShallowCopy(clustering->GetOutput());
  out->ComputeBounds();
  return out;
}

}  // namespace

DrawablePtr make_drawable(const TriangleMesh& mesh, Shading shading, Texels texels) {
  auto out = std::make_shared<Drawable>();
  out->kind = DrawableKind::kMesh;
  out->box = bounds(mesh.vertices);
  out->points = mesh.vertices.size();
  out->colored = !mesh.colors.empty();
  const bool textured =
      shading == Shading::kSmooth && has_texture(mesh) && !mesh.texture->image.empty();
  const bool creases = mesh.normals.empty() && mesh.triangles.size() < kCreasesBelow;
  TriangleMesh made = shading == Shading::kFlat ? exploded(mesh)
                      : creases                 ? split_at_creases(mesh, kCrease_rad)
                                                : mesh;
  if (textured) {
    if (made.normals.empty()) made.normals = vertex_normals(made);
    out->texture = mesh.texture;
    const ColorImage& image = mesh.texture->image;
    if (image.pixels.size() > kPictureAtOnce && texels == Texels::kBlended)
      out->halves = halves_of(image);
    const auto small = std::find_if(out->halves.begin(), out->halves.end(), [](const auto& half) {
      return half.pixels.size() <= kPictureAtOnce;
    });
    out->picture = make_picture(small == out->halves.end() ? image : *small);
    out->texels = texels;
    out->chunks.push_back(make_textured(made));
  } else {
    out->chunks.push_back(make_surface(made));
  }
  if (mesh.triangles.size() > (textured ? kCoarseTexturedAbove : kCoarseAbove))
    out->coarse = make_coarse(out->chunks.front());
  return out;
}

DrawablePtr make_drawable(const TriangleMesh& mesh, const TriangleMesh& moving) {
  auto out = std::make_shared<Drawable>();
  out->box = bounds(mesh.vertices);
  out->points = mesh.vertices.size();
  out->colored = !mesh.colors.empty();
  out->chunks.push_back(make_surface(mesh));
  out->coarse = moving.empty() ? nullptr : make_surface(moving);
  return out;
}

DrawablePtr make_drawable(const PointCloud& cloud, double spacing_m) {
  auto out = std::make_shared<Drawable>();
  out->kind = DrawableKind::kCloud;
  out->box = bounds(cloud.points);
  out->points = cloud.size();
  out->spacing_m = spacing_m;
  out->colored = !cloud.colors.empty();
  std::vector<std::size_t> ends;
  for (std::size_t end = 0; end < cloud.size();) {
    end += ends.size() < kSmallChunks ? kSmallChunkPoints : kChunkPoints;
    ends.push_back(std::min(end, cloud.size()));
  }
  const std::uint64_t stride = spread_stride(cloud.size());
  out->chunks.resize(ends.size());
  parallel_for(ends.size(), 1, [&](std::size_t c) {
    out->chunks[c] = make_chunk(cloud, c == 0 ? 0 : ends[c - 1], ends[c], stride);
  });
  return out;
}

DrawablePtr make_drawable(const Segments& segments) {
  auto out = std::make_shared<Drawable>();
  out->kind = DrawableKind::kLines;
  out->box = bounds(segments.points);
  out->points = segments.points.size();
  std::vector<std::uint32_t> indices(segments.points.size());
  std::iota(indices.begin(), indices.end(), 0u);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(make_points(segments.points));
  data->SetLines(make_cells(indices.data(), indices.size() / 2, 2));
  data->ComputeBounds();
  out->chunks.push_back(data);
  return out;
}

const Box& box_of(const Drawable& drawable) { return drawable.box; }

}  // namespace turnscan::studio
