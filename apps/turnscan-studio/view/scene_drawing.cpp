// Frames of the view: a subset of the points while it moves, the rest piece by piece.

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <QElapsedTimer>
#include <algorithm>

#include "view/scene_view_parts.hpp"

namespace turnscan::studio {

namespace {

constexpr std::size_t kMovingPoints = 200000;  // maximum while the camera moves
constexpr double kFrameGoalMs = 45.0;
constexpr double kPieceGoalMs = 25.0;  // a piece must not delay mouse input

}  // namespace

void SceneView::render_now() {
  if (!isVisible()) return;
  draw_coarse();
}

/// Draws everything except the points beyond the budget. They follow, piece by piece, when the
/// camera rests.
void SceneView::draw_coarse() {
  Parts& p = *parts_;
  if (!isVisible() || !p.canvas->isValid()) return;
  p.warm_up();
  show_first(p.moving);
  for (auto& [id, item] : p.items)
    if (item.drawable->spacing_m > 0.0)
      p.size_points(item, devicePixelRatioF(), metres_per_pixel());
  set_clipping_range();
  for (auto& renderer : p.renderers) {
    renderer->PreserveColorBufferOff();
    renderer->PreserveDepthBufferOff();
    renderer->SetUseFXAA(!p.live && !p.moving && p.pending.empty());
  }
  p.set_up_passes(scene_box().size().norm());
  QElapsedTimer clock;
  clock.start();
  p.window->Render();
  const double ms = 1e-6 * double(clock.nsecsElapsed());
  p.complete = !p.moving && p.pending.empty() && !p.waits_for_texture();
  if (p.moving) p.longest_ms = std::max(p.longest_ms, ms);
  p.learn_from(ms);
  if (!p.moving && !p.complete) p.more.start(0);
  update_overlay();
}

/// Enables what is expensive for a software renderer only where it is visible.
void SceneView::Parts::set_up_passes(double scene_size_m) {
  const bool translucent = std::any_of(items.begin(), items.end(), [](const auto& entry) {
    return entry.second.style.visible && entry.second.style.opacity < 1.0;
  });
  for (auto& renderer : renderers) {
    renderer->SetUseDepthPeeling(translucent);
    renderer->SetMaximumNumberOfPeels(moving ? 2 : 6);
    renderer->SetOcclusionRatio(0.0);
    const bool shade = occlusion && !moving && pending.empty() && !translucent;
    renderer->SetUseSSAO(shade);
    renderer->SetSSAORadius(0.1 * scene_size_m);
    renderer->SetSSAOBias(0.001 * scene_size_m);
    renderer->SetSSAOKernelSize(64);
    renderer->SSAOBlurOn();
  }
}

/// A slow renderer gets fewer points the next time, a fast one more, if it was given many.
void SceneView::Parts::learn_from(double ms) {
  const double share = kFrameGoalMs / std::max(ms, 1.0);
  if (share > 1.0 && !moving && 4 * points_drawn < budget) return;
  const double wanted = double(budget) * std::clamp(share, 0.5, 1.3);
  budget = std::clamp<std::size_t>(std::size_t(wanted), 20000, kMovingPoints);
}

/// The first picture of each kind of item compiles its shaders, which takes a software renderer
/// tenths of a second: this is done while the window opens, not when the user loads or rotates.
void SceneView::Parts::warm_up() {
  if (warm) return;
  warm = true;
  Vec3d focus;
  camera->GetFocalPoint(focus.data());
  const Vec3f at = focus.cast<float>(), x = 1e-4f * Vec3f::UnitX(), y = 1e-4f * Vec3f::UnitY();
  TriangleMesh mesh;
  mesh.vertices = {at, at + x, at + y};
  mesh.triangles = {{0, 1, 2}};
  PointCloud cloud;
  cloud.points = mesh.vertices;
  Segments lines;
  lines.points = {at, at + x};
  std::vector<DrawablePtr> things{make_drawable(mesh), make_drawable(cloud), make_drawable(lines)};
  mesh.colors.assign(3, Rgb{200, 200, 200});
  cloud.colors = mesh.colors;
  things.push_back(make_drawable(mesh));
  things.push_back(make_drawable(cloud));
  mesh.colors.clear();
  auto texture = std::make_shared<MeshTexture>();
  texture->image = ColorImage(4, 4, Rgb{200, 200, 200});
  texture->corners.resize(1, {Eigen::Vector2f(0, 0), Eigen::Vector2f(1, 0), Eigen::Vector2f(0, 1)});
  mesh.texture = std::move(texture);
  things.push_back(make_drawable(mesh));
  std::vector<vtkSmartPointer<vtkActor>> actors;
  for (const DrawablePtr& thing : things) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(thing->chunks.front());
    mapper->SetScalarVisibility(thing->colored);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->SetTexture(texture_of(*thing));
    actor->GetProperty()->SetLighting(thing->kind == DrawableKind::kMesh);
    actor->GetProperty()->SetInterpolationToPhong();
    renderers[0]->AddActor(actor);
    actors.push_back(actor);
  }
  for (const bool smooth : {true, false}) {
    renderers[0]->SetUseFXAA(smooth);
    window->Render();
  }
  for (const auto& actor : actors) renderers[0]->RemoveActor(actor);
}

void SceneView::show_first(bool moving_now) {
  Parts& p = *parts_;
  std::size_t all = 0;
  for (auto& [id, item] : p.items)
    if (item.style.visible && item.drawable->kind == DrawableKind::kCloud)
      all += item.drawable->points;
  const double share = all > p.budget ? double(p.budget) / double(all) : 1.0;
  p.pending.clear();
  p.points_drawn = 0;
  for (auto& [id, item] : p.items) {
    const bool cloud = item.drawable->kind == DrawableKind::kCloud;
    const bool coarse = item.style.visible && item.drawable->coarse && moving_now;
    const double allowed = share * double(item.drawable->points);
    double shown = 0.0;
    for (std::size_t i = 0; i < item.actors.size(); ++i) {
      const auto count = double(item.drawable->chunks[i]->GetNumberOfPoints());
      const bool first = !cloud || i == 0 || shown + count <= allowed;
      if (first) shown += count;
      const bool now = item.style.visible && first && !coarse;
      if (now) actor_of(item, i)->VisibilityOn();
      if (!now && item.actors[i]) item.actors[i]->VisibilityOff();
      if (item.style.visible && !first) p.pending.push_back({&item, i});
    }
    if (coarse) actor_of(item, item.actors.size())->VisibilityOn();
    if (!coarse && item.coarse) item.coarse->VisibilityOff();
    if (item.style.visible && cloud) p.points_drawn += std::size_t(shown);
  }
}

/// Adds some of the pending points to the existing picture.
void SceneView::draw_rest() {
  Parts& p = *parts_;
  if (p.moving || !isVisible()) return;
  if (p.pending.empty()) return bring_textures();
  for (auto& [id, item] : p.items) {
    for (const auto& actor : item.actors)
      if (actor) actor->VisibilityOff();
    if (item.coarse) item.coarse->VisibilityOff();
  }
  const std::size_t count = std::min(p.pending.size(), p.chunks_a_frame);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [item, chunk] = p.pending[p.pending.size() - 1 - i];
    actor_of(*item, chunk)->VisibilityOn();
  }
  p.pending.resize(p.pending.size() - count);
  for (auto& renderer : p.renderers) {
    renderer->PreserveColorBufferOn();
    renderer->PreserveDepthBufferOn();
    renderer->UseFXAAOff();
    renderer->UseSSAOOff();
  }
  QElapsedTimer clock;
  clock.start();
  p.window->Render();
  const double ms = 1e-6 * double(clock.nsecsElapsed());
  if (ms < 0.5 * kPieceGoalMs) p.chunks_a_frame = std::min<std::size_t>(p.chunks_a_frame + 1, 16);
  if (ms > kPieceGoalMs) p.chunks_a_frame = std::max<std::size_t>(p.chunks_a_frame / 2, 1);
  p.complete = p.pending.empty() && !p.waits_for_texture();
  if (!p.complete) p.more.start(0);
}

/// Uploads a piece of the first large texture that is still drawn with a smaller image.
void SceneView::bring_textures() {
  Parts& p = *parts_;
  for (auto& [id, item] : p.items) {
    if (!item.waits_for_texture()) continue;
    p.window->MakeCurrent();
    if (!item.large)
      item.large = std::make_unique<LargeTexture>(item.drawable->texture->image,
                                                  item.drawable->halves, p.window);
    item.large->upload_piece();
    if (!item.large->complete()) break;
    item.texture = item.large->texture();
    apply_style(item);
    draw_coarse();
    return;
  }
  if (p.waits_for_texture()) p.more.start(0);
}

bool SceneView::settled() const {
  return parts_->complete && !parts_->render.isActive() && !parts_->rest.isActive() &&
         parts_->flight.state() != QAbstractAnimation::Running;
}

std::size_t SceneView::points_while_moving() const { return parts_->points_drawn; }

std::size_t SceneView::points_at_once() const { return parts_->budget; }

double SceneView::longest_frame_ms() const { return parts_->longest_ms; }

QImage SceneView::screenshot() {
  draw_coarse();
  while (!parts_->complete && !parts_->moving && isVisible() && parts_->canvas->isValid())
    draw_rest();
  return grab().toImage();
}

}  // namespace turnscan::studio
