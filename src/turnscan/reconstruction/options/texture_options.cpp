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
            "Texture: refine the pose of the colour camera relative to the depth camera, from the "
            "object's outlines and pattern")
      .flag("albedo", o.albedo,
            "Texture: estimate shading and highlights of a fixed light on the turning object, and "
            "remove them");
  return table;
}

}  // namespace turnscan
