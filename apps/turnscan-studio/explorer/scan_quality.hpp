#pragma once
// Quality of a mesh as determined by its scan, and the mesh coloured by it.

#include <QString>
#include <memory>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/page/page.hpp>
#include <vector>

#include "view/drawable.hpp"
#include "view/scene_view.hpp"

namespace turnscan::studio {

/// For a mesh as made by the scan; an edited one has none.
struct ScanQuality {
  Verdict verdict;
  std::shared_ptr<const PageInput> page;                   ///< the report of the whole run
  std::size_t object = 0;                                  ///< index of this mesh in the page
  std::shared_ptr<const TextureReport> texture = nullptr;  ///< for its texture; nullptr: none
};

/// A vertex property by which a mesh can be coloured.
struct ColorWay {
  QString id, label;  ///< label is human-readable
};

/// The properties known for this mesh, in the order of the report page.
std::vector<ColorWay> color_ways(const ScanQuality& quality);

struct ColoredMesh {
  DrawablePtr drawable;
  Legend legend;
};
/// Colours a mesh by one of color_ways(): viridis, or the colours of its categories; grey where it
/// is not known.
ColoredMesh color_mesh(const ScanQuality& quality, const QString& way);

/// A sign and a colour for each level, which differ in shape, lightness and hue (after M. Okabe and
/// K. Ito, "Color universal design", 2008).
QString sign_of(Level level);
QColor color_of(Level level);

}  // namespace turnscan::studio
