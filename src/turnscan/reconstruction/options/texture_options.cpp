#include <turnscan/reconstruction/options/texture_options.hpp>

namespace turnscan {

OptionTable describe(TextureOptions& o) {
  OptionTable table;
  table
      .flag("texture", o.texture,
            "Make a texture for the mesh from the colour images: for .glb, .obj and .3mf files")
      .number("texture-size", o.size_px, {64, 8192},
              "Pixels a side of the texture; automatic: as many as the colour cameras resolve on "
              "the object, at most 4096")
      .flag("refine-colour-camera", o.refine_camera,
            "Texture: find where the colour camera really is beside the depth camera, from the "
            "outlines and the pattern of the object")
      .flag("albedo", o.albedo,
            "Texture: estimate what a light that stands still does to the turning object, and take "
            "it out");
  return table;
}

}  // namespace turnscan
