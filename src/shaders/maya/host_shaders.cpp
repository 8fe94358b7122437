// SPDX-License-Identifier: Apache-2.0
#include "shaders/maya/host_shaders.h"

#include <algorithm>
#include <string_view>

#include "shaders/max/max_shaders.h"
#include "shaders/maya/maya_layers.h"
#include "shaders/maya/maya_light.h"
#include "shaders/maya/maya_surface.h"
#include "shaders/maya/maya_texture.h"
#include "shaders/maya/maya_utility.h"
#include "shaders/maya/production.h"
#include "shaders/subsurface/subsurface.h"

namespace oriel {

std::vector<const ShaderSpec*> host_shaders() {
  std::vector<const ShaderSpec*> all = {
      &kMayaAmbientlight,  &kMayaAnisotropic,  &kMayaArealight,        &kMayaBlinn,
      &kMayaBump2d,        &kMayaChecker,      &kMayaDirectionallight, &kMayaFile,
      &kMayaFractal,       &kMayaLambert,      &kMayaLayeredshader,    &kMayaNoise,
      &kMayaPhong,         &kMayaPhongE,       &kMayaPhotonsurface,    &kMayaPlace2dtex,
      &kMayaPointlight,    &kMayaRamp,         &kMayaShadingengine,    &kMayaShadow,
      &kMayaShapelight,    &kMayaSpotlight,    &kMayaSurfaceshader,    &kMayaTransparent,
      &kMayaUsebackground, &kMayaVolumelight,  &kMisssFastSimple,      &kMisssFastSkin,
      &kMisssFastShader,   &kMisssFastShader2, &kMisssPhysical,
  };
  for (const auto specs :
       {maya_arithmetic(), maya_conversions(), maya_surroundings(), max_materials(), max_lights(),
        max_textures(), max_elements(), production_shaders(), subsurface_helpers()})
    for (const ShaderSpec& spec : specs) all.push_back(&spec);
  std::sort(all.begin(), all.end(), [](const ShaderSpec* a, const ShaderSpec* b) {
    return std::string_view(a->name) < b->name;
  });
  return all;
}

}  // namespace oriel
