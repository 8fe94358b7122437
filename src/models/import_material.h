// SPDX-License-Identifier: Apache-2.0
// Imports materials as mia_material_x.
#pragma once

#include <map>
#include <string>

#include "base/diagnostic.h"
#include "models/gltf/extras.h"
#include "models/texture_space.h"
#include "models/vertex_colors.h"
#include "scene/scene.h"

struct aiScene;

namespace oriel::models {

class ShaderCall;
class TextureMaker;

/// Gamma of the scene options: 8-bit textures are sRGB, and 2.2 is the nearest power.
inline constexpr float kTextureGamma = 2.2f;

/// A unique element name: letters, digits and underscores of `wish`, followed by a number if the
/// name exists.
std::string unique_name(const scene::Scene& scene, const std::string& wish);

/// Adds a shader to the scene under a name similar to `wish`, which is returned.
std::string add_shader(scene::Scene& scene, const std::string& wish, const ShaderCall& call);

/// Result of importing a material.
struct ImportedMaterial {
  std::string name;
  SurfaceSpaces surface;           ///< texture spaces of the objects with this material
  bool needs_own_package = false;  ///< it uses shaders of oriel.mi
  bool absorbs = false;            ///< light on its way inside, also in shadows
};

/// Adds material `index` of a model and the shaders that it refers to.
///
/// Model:   metallic-roughness: diffuse_weight is 1 - metallic. Reflections use curve 5 from F0 to
///          1; F0 is computed from the index of refraction (default .04) and is 1 for metals.
///          Reflections are tinted by the base colour in proportion to metallic. Transmission
///          becomes transparency, solid if a volume is given, else thin-walled; attenuation becomes
///          refr_falloff. Emission becomes additional_color, coverage cutout_opacity. Materials
///          without these properties (OBJ, Collada, FBX, IFC): diffuse and specular colour, gloss
///          from the Phong exponent n by alpha = sqrt(2 / (n + 2)), F0 from the brightness of its
///          highlight, opacity as transparency. Specular-glossiness: that colour as F0.
///          Normals and clear coats: import_layers.h.
///          Colours of corners: in place of the diffuse colour, times its texture (PLY, OBJ, OFF);
///          times base colour and coverage (glTF).
///          A material that transmits or has cut-outs is its own shadow and photon shader: without
///          a shadow shader it would block light.
/// Inputs:  extras: of glTF files, by the names of materials; colors: of the format's corners.
/// Errors:  OR-MD-003 sheen and what else nothing stands for is left out, OR-MD-004 a texture that
///          cannot be used.
/// Source:  glTF 2.0, appendix B, and
///          KHR_materials_{ior,specular,transmission,volume,emissive_strength,anisotropy};
///          Walter et al. 2007 for the exponent.
/// Checked: ModelMaterial.*, ModelTexture.*, ImportedPanes.* in tests/imported/panes_test.cpp
ImportedMaterial add_material(const aiScene& model, unsigned index,
                              const std::map<std::string, GltfExtras>& extras, ColorsAre colors,
                              TextureMaker& textures, scene::Scene& scene,
                              Diagnostics& diagnostics);

}  // namespace oriel::models
