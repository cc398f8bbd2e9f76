#pragma once
// What a scan tells of one of its meshes, and the mesh in the colours of that.

#include <QString>
#include <memory>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/page/page.hpp>
#include <vector>

#include "view/drawable.hpp"
#include "view/scene_view.hpp"

namespace turnscan::studio {

/// Of a mesh as the scan made it; an edited one has none.
struct ScanQuality {
  Verdict verdict;
  std::shared_ptr<const PageInput> page;                   ///< the report of the whole run
  std::size_t object = 0;                                  ///< of page, this mesh
  std::shared_ptr<const TextureReport> texture = nullptr;  ///< of its texture; nullptr: none
};

/// A property of the vertices that a mesh can be coloured by.
struct ColorWay {
  QString id, label;  ///< label is for people
};

/// Those that are known of this mesh, in the order of the report page.
std::vector<ColorWay> color_ways(const ScanQuality& quality);

struct ColoredMesh {
  DrawablePtr drawable;
  Legend legend;
};
/// In the colours of color_ways(): viridis, or those of its kinds; grey where it is not known.
ColoredMesh color_mesh(const ScanQuality& quality, const QString& way);

/// A sign and a colour for each level that are told apart by form, lightness and hue (after
/// M. Okabe and K. Ito, "Color universal design", 2008).
QString sign_of(Level level);
QColor color_of(Level level);

}  // namespace turnscan::studio
