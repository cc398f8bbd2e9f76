// The items of the view: their actors, appearance, and bounding boxes.

#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

#include "view/scene_view_parts.hpp"

namespace turnscan::studio {

namespace {

constexpr const char* kNormalColors = "NormalColors";

/// Maps -1 to 1 to 0 to 255.
void add_normal_colors(vtkPolyData& data) {
  vtkDataArray* normals = data.GetPointData()->GetNormals();
  if (!normals || data.GetPointData()->HasArray(kNormalColors)) return;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName(kNormalColors);
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(normals->GetNumberOfTuples());
  std::array<double, 3> n{};
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i) {
    normals->GetTuple(i, n.data());
    for (int c = 0; c < 3; ++c)
      colors->SetTypedComponent(
          i, c,
          static_cast<unsigned char>(std::clamp(127.5 * (n[std::size_t(c)] + 1.0), 0.0, 255.0)));
  }
  data.GetPointData()->AddArray(colors);
}

void look_of_surface(SurfaceLook look, vtkActor& actor, vtkPolyDataMapper& mapper) {
  vtkProperty* property = actor.GetProperty();
  property->SetRepresentation(look == SurfaceLook::kWireframe ? VTK_WIREFRAME : VTK_SURFACE);
  property->SetEdgeVisibility(look == SurfaceLook::kEdges);
  property->SetEdgeColor(0.15, 0.2, 0.25);
  if (look != SurfaceLook::kNormals) return;
  add_normal_colors(*mapper.GetInput());
  if (!mapper.GetInput()->GetPointData()->HasArray(kNormalColors)) return;
  actor.SetTexture(nullptr);
  property->LightingOff();
  mapper.SetScalarModeToUsePointFieldData();
  mapper.SelectColorArray(kNormalColors);
  mapper.ScalarVisibilityOn();
}

}  // namespace

vtkSmartPointer<vtkTexture> texture_of(const Drawable& drawable) {
  if (!drawable.picture) return nullptr;
  auto out = vtkSmartPointer<vtkTexture>::New();
  const bool blended = drawable.texels == Texels::kBlended;
  out->SetInputData(drawable.picture);
  out->SetColorModeToDirectScalars();
  out->SetInterpolate(blended);
  out->SetMipmap(blended);
  out->RepeatOn();
  return out;
}

int SceneView::add(DrawablePtr drawable, const ItemStyle& style) {
  Parts& p = *parts_;
  const int id = p.next_item++;
  p.items[id].style = style;
  const bool first = scene_box().empty();
  replace(id, std::move(drawable));
  if (first && style.in_view) reset_camera();
  return id;
}

void SceneView::replace(int id, DrawablePtr drawable) {
  const auto found = parts_->items.find(id);
  if (found == parts_->items.end()) return;
  Item& item = found->second;
  parts_->drop(item);
  item.drawable = std::move(drawable);
  item.actors.resize(item.drawable->chunks.size());
  apply_style(item);
  request_render();
}

vtkActor* SceneView::actor_of(Item& item, std::size_t chunk) {
  const bool coarse = chunk >= item.actors.size();
  vtkSmartPointer<vtkActor>& actor = coarse ? item.coarse : item.actors[chunk];
  if (actor) return actor;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(coarse ? item.drawable->coarse : item.drawable->chunks[chunk]);
  mapper->StaticOn();
  if (parts_->clip_planes->GetNumberOfItems() > 0 && item.style.boxed)
    mapper->SetClippingPlanes(parts_->clip_planes);
  if (!item.texture && item.drawable->picture) parts_->give_texture(item);
  actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  style_actor(item, actor);
  parts_->size_points(item, devicePixelRatioF(), metres_per_pixel());
  return actor;
}

void SceneView::set_style(int id, const ItemStyle& style) {
  const auto found = parts_->items.find(id);
  if (found == parts_->items.end()) return;
  found->second.style = style;
  apply_style(found->second);
  request_render();
}

void SceneView::remove(int id) {
  const auto found = parts_->items.find(id);
  if (found == parts_->items.end()) return;
  parts_->drop(found->second);
  parts_->items.erase(found);
  request_render();
}

void SceneView::apply_style(Item& item) {
  for (const auto& actor : item.actors)
    if (actor) style_actor(item, actor);
  if (item.coarse) style_actor(item, item.coarse);
  parts_->size_points(item, devicePixelRatioF(), metres_per_pixel());
  update_box(item);
}

void SceneView::style_actor(const Item& item, vtkActor* actor) {
  Parts& p = *parts_;
  const ItemStyle& style = item.style;
  vtkProperty* property = actor->GetProperty();
  const bool mesh = item.drawable->kind == DrawableKind::kMesh;
  const bool pictured = style.own_colors && item.drawable->picture;
  const QColor color = pictured ? QColor(Qt::white) : style.color;
  property->SetColor(color.redF(), color.greenF(), color.blueF());
  property->SetLineWidth(float(style.line_width * devicePixelRatioF()));
  property->SetLighting(style.lit && mesh);
  property->SetInterpolationToPhong();
  // A texture contains its own lighting; little of the view's is needed to show the shape.
  property->SetAmbient(pictured ? 0.45 : 0.12);
  property->SetDiffuse(pictured ? 0.55 : 0.85);
  property->SetSpecular(pictured ? 0.0 : 0.12);
  property->SetSpecularPower(20.0);
  property->SetOpacity(style.opacity);
  actor->SetTexture(pictured ? item.texture : nullptr);
  auto* mapper = static_cast<vtkPolyDataMapper*>(actor->GetMapper());
  mapper->SetScalarModeToDefault();
  mapper->SetScalarVisibility(style.own_colors && item.drawable->colored && !pictured);
  look_of_surface(mesh && style.boxed ? p.look : SurfaceLook::kShaded, *actor, *mapper);
  const int pane = p.split && style.pane == 1 ? 1 : 0;
  p.renderers[std::size_t(1 - pane)]->RemoveActor(actor);
  if (!p.renderers[std::size_t(pane)]->HasViewProp(actor))
    p.renderers[std::size_t(pane)]->AddActor(actor);
}

/// Points that should touch are as large as their spacing at the camera's focus.
void SceneView::Parts::size_points(Item& item, double ratio, double metres_per_pixel) {
  constexpr double kOverlap = 1.25, kLargest = 48.0;
  const double spacing = item.drawable->spacing_m;
  double pixels = point_size * item.style.point_scale;
  if (spacing > 0.0) {
    const double apart = kOverlap * spacing / std::max(metres_per_pixel, 1e-12);
    pixels = std::clamp(apart, 1.0, kLargest) * point_size / kPointSize;
  }
  for (const auto& actor : item.actors)
    if (actor) actor->GetProperty()->SetPointSize(float(pixels * ratio));
  if (item.coarse) item.coarse->GetProperty()->SetPointSize(float(pixels * ratio));
}

void SceneView::update_box(Item& item) {
  Parts& p = *parts_;
  for (auto& renderer : p.renderers)
    if (item.box) renderer->RemoveActor(item.box);
  item.box = nullptr;
  if (!p.boxes || !item.style.visible || !item.style.boxed || item.drawable->box.empty()) return;
  const DrawablePtr lines = make_drawable(box_segments(item.drawable->box));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(lines->chunks.front());
  item.box = vtkSmartPointer<vtkActor>::New();
  item.box->SetMapper(mapper);
  item.box->GetProperty()->SetColor(p.theme->accent.redF(), p.theme->accent.greenF(),
                                    p.theme->accent.blueF());
  item.box->GetProperty()->SetLineWidth(float(1.2 * devicePixelRatioF()));
  item.box->GetProperty()->LightingOff();
  p.renderers[p.split && item.style.pane == 1 ? 1 : 0]->AddActor(item.box);
}

Segments box_segments(const Box& box) {
  Segments lines;
  const auto corner = [&](int i) {
    return Vec3d((i & 1) != 0 ? box.max.x() : box.min.x(), (i & 2) != 0 ? box.max.y() : box.min.y(),
                 (i & 4) != 0 ? box.max.z() : box.min.z());
  };
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4})
      if ((i & bit) == 0) lines.add(corner(i), corner(i | bit));
  return lines;
}

}  // namespace turnscan::studio
