#pragma once
// Internal to the sources that use VTK.

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <turnscan/core/mesh_texture.hpp>

#include "view/drawable.hpp"

namespace turnscan::studio {

enum class DrawableKind { kMesh, kCloud, kLines };

struct Drawable {
  DrawableKind kind = DrawableKind::kMesh;
  /// For a cloud: chunks, each spread over the whole cloud, so that the first ones alone show its
  /// shape; first kSmallChunks small ones, so that a slow renderer can be given few points, and
  /// then chunks of kChunkPoints points. Else a single one.
  std::vector<vtkSmartPointer<vtkPolyData>> chunks;
  /// For a large mesh: fewer triangles, drawn while it moves.
  vtkSmartPointer<vtkPolyData> coarse;
  Box box;
  std::size_t points = 0;
  double spacing_m = 0.0;  ///< for a cloud whose points should touch; else 0
  bool colored = false;
  /// The texture image, which shares the pixels of `texture`, or for a large one those of one of
  /// its halves; nullptr: none.
  vtkSmartPointer<vtkImageData> picture;
  std::shared_ptr<const MeshTexture> texture;
  std::vector<ColorImage> halves;  ///< for a large image: halves_of() it
  Texels texels = Texels::kBlended;

  bool has_colors() const { return colored || picture; }
};

inline constexpr std::size_t kSmallChunks = 10, kSmallChunkPoints = 10000;
inline constexpr std::size_t kChunkPoints = 40000;
inline constexpr std::size_t kCoarseAbove = 150000;  ///< triangles
/// The same for a textured mesh, which loses its texture.
inline constexpr std::size_t kCoarseTexturedAbove = 1000000;

}  // namespace turnscan::studio
