#pragma once
// For the sources that talk to VTK.

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <turnscan/core/mesh_texture.hpp>

#include "view/drawable.hpp"

namespace turnscan::studio {

enum class DrawableKind { kMesh, kCloud, kLines };

struct Drawable {
  DrawableKind kind = DrawableKind::kMesh;
  /// A cloud: pieces, each spread over the whole cloud, so that the first ones alone show its
  /// shape; the first kSmallChunks small ones, so that a slow renderer can be given few points, and
  /// then such of kChunkPoints points. Else one piece.
  std::vector<vtkSmartPointer<vtkPolyData>> chunks;
  /// Of a large mesh: fewer triangles, for while it moves.
  vtkSmartPointer<vtkPolyData> coarse;
  Box box;
  std::size_t points = 0;
  double spacing_m = 0.0;  ///< of a cloud whose points are to touch; else 0
  bool colored = false;
  /// The texture's picture, whose pixels are those of `texture`, or of a large one those of one of
  /// its halves; nullptr: none.
  vtkSmartPointer<vtkImageData> picture;
  std::shared_ptr<const MeshTexture> texture;
  std::vector<ColorImage> halves;  ///< of a large one: halves_of() it
  Texels texels = Texels::kBlended;

  bool has_colors() const { return colored || picture; }
};

inline constexpr std::size_t kSmallChunks = 10, kSmallChunkPoints = 10000;
inline constexpr std::size_t kChunkPoints = 40000;
inline constexpr std::size_t kCoarseAbove = 150000;           ///< triangles
inline constexpr std::size_t kCoarseTexturedAbove = 1000000;  ///< the same, which loses the picture

}  // namespace turnscan::studio
