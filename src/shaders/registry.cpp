// SPDX-License-Identifier: Apache-2.0
#include "shaders/registry.h"

#include <fmt/format.h>

#include <iterator>

#include "shaders/architectural/mia_envblur.h"
#include "shaders/architectural/mia_exposure.h"
#include "shaders/architectural/mia_lens_bokeh.h"
#include "shaders/architectural/mia_light_surface.h"
#include "shaders/architectural/mia_material.h"
#include "shaders/architectural/mia_photometric_light.h"
#include "shaders/architectural/mia_portal_light.h"
#include "shaders/architectural/mia_roundcorners.h"
#include "shaders/architectural/mia_sun_sky.h"
#include "shaders/base/mib_bump.h"
#include "shaders/base/mib_color.h"
#include "shaders/base/mib_glossy.h"
#include "shaders/base/mib_illum.h"
#include "shaders/base/mib_lens.h"
#include "shaders/base/mib_light.h"
#include "shaders/base/mib_light_photometric.h"
#include "shaders/base/mib_lightmap.h"
#include "shaders/base/mib_lookup.h"
#include "shaders/base/mib_lookup_cube.h"
#include "shaders/base/mib_occlusion.h"
#include "shaders/base/mib_ray.h"
#include "shaders/base/mib_ray_marcher.h"
#include "shaders/base/mib_shadow.h"
#include "shaders/base/mib_texture.h"
#include "shaders/base/mib_texture_filter.h"
#include "shaders/base/mib_texture_procedural.h"
#include "shaders/maya/host_shaders.h"
#include "shaders/oriel/oriel_arithmetic.h"
#include "shaders/oriel/oriel_brick.h"
#include "shaders/oriel/oriel_bump.h"
#include "shaders/oriel/oriel_direction_angle.h"
#include "shaders/oriel/oriel_facing.h"
#include "shaders/oriel/oriel_layers.h"
#include "shaders/oriel/oriel_lens.h"
#include "shaders/oriel/oriel_light.h"
#include "shaders/oriel/oriel_noise.h"
#include "shaders/oriel/oriel_normal_map.h"
#include "shaders/oriel/oriel_plastic.h"
#include "shaders/oriel/oriel_tex_vector.h"
#include "shaders/oriel/oriel_vertex_color.h"
#include "shaders/oriel/oriel_voronoi.h"
#include "shaders/oriel/oriel_wave.h"
#include "shaders/physics/dgs_material.h"
#include "shaders/physics/parti_volume.h"

namespace oriel {
namespace {

constexpr const ShaderSpec* kBuiltin[] = {
    &kMiaMaterial,
    &kMiaMaterialX,
    &kMiaMaterialXPasses,
    &kMiaPhysicalSun,
    &kMiaPhysicalSky,
    &kMiaPortalLight,
    &kMiaPhotometricLight,
    &kMiaLightSurface,
    &kMiaCieSky,
    &kMiaExposurePhotographic,
    &kMiaExposurePhotographicRev,
    &kMiaExposureSimple,
    &kMiaLensBokeh,
    &kMiaEnvBlur,
    &kMiaRoundCorners,
    &kPhysicalLensDof,
    &kMibAmbOcclusion,
    &kMibBentNormalEnv,
    &kMibBlackbody,
    &kMibBumpBasis,
    &kMibBumpMap,
    &kMibBumpMap2,
    &kMibCieD,
    &kMibColorAlpha,
    &kMibColorAverage,
    &kMibColorIntensity,
    &kMibColorInterpolate,
    &kMibColorMix,
    &kMibColorSpread,
    &kMibContinue,
    &kMibDielectric,
    &kMibFastOcclusion,
    &kMibFgOcclusion,
    &kMibGlossyReflection,
    &kMibGlossyRefraction,
    &kMibIllumBlinn,
    &kMibIllumCooktorr,
    &kMibIllumHair,
    &kMibIllumLambert,
    &kMibIllumPhong,
    &kMibIllumWard,
    &kMibIllumWardDeriv,
    &kMibLensClamp,
    &kMibLensStencil,
    &kMibLightInfinite,
    &kMibLightmapSample,
    &kMibLightmapWrite,
    &kMibLightPhotometric,
    &kMibLightPoint,
    &kMibLightSpot,
    &kMibLookupBackground,
    &kMibLookupCube1,
    &kMibLookupCube6,
    &kMibLookupCylindrical,
    &kMibLookupSpherical,
    &kMibOpacity,
    &kMibPassthroughBumpMap,
    &kMibPhotonBasic,
    &kMibRayMarcher,
    &kMibReflect,
    &kMibRefract,
    &kMibRefractionIndex,
    &kMibTextureCheckerboard,
    &kMibTextureFilterLookup,
    &kMibTextureLookup,
    &kMibTextureLookup2,
    &kMibTexturePolkadot,
    &kMibTexturePolkasphere,
    &kMibTextureRemap,
    &kMibTextureRotate,
    &kMibTextureTurbulence,
    &kMibTextureVector,
    &kMibTextureWave,
    &kMibTransparency,
    &kMibTwosided,
    &kMibVolume,
    &kMibShadowTransparency,
    &kDgsMaterial,
    &kDgsMaterialPhoton,
    &kDielectricMaterial,
    &kDielectricMaterialPhoton,
    &kOrielBlend,
    &kOrielBrick,
    &kOrielBump,
    &kOrielDirectionAngle,
    &kOrielFacing,
    &kOrielHueSaturation,
    &kOrielLensCube,
    &kOrielLensFisheye,
    &kOrielLensPanorama,
    &kOrielLensShift,
    &kOrielLight,
    &kOrielMagic,
    &kOrielMath,
    &kOrielNoise,
    &kOrielNormalMap,
    &kOrielPlastic,
    &kOrielSheen,
    &kOrielTexVector,
    &kOrielThinFilm,
    &kOrielVertexColor,
    &kOrielVoronoi,
    &kOrielWave,
    &kOversamplingLens,
    &kPartiVolume,
    &kPartiVolumePhoton,
    &kPathMaterial,
    &kPhysicalLight,
    &kTransmat,
    &kTransmatPhoton,
};

std::string declared_default(const ParamSpec& param) {
  if (!param.declared_default) return {};
  const auto& v = param.fallback;
  switch (param.type) {
    case ParamType::Boolean:
      return v[0] != 0 ? " default on" : " default off";
    case ParamType::Integer:
      return fmt::format(" default {}", static_cast<int>(v[0]));
    case ParamType::Scalar:
      return fmt::format(" default {}", v[0]);
    case ParamType::Color:
    case ParamType::Vector:
      return fmt::format(" default {} {} {}", v[0], v[1], v[2]);
    default:
      return {};
  }
}

std::string apply_words(unsigned apply) {
  constexpr const char* kWords[] = {"material", "texture", "light",  "environment", "lens",
                                    "output",   "shadow",  "photon", "volume",      "emitter"};
  std::string text;
  for (unsigned i = 0; i < std::size(kWords); ++i)
    if (apply & (1u << i)) text += (text.empty() ? "" : ", ") + std::string(kWords[i]);
  return text;
}

}  // namespace

const Registry& builtin_shaders() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> all(std::begin(kBuiltin), std::end(kBuiltin));
    const std::vector<const ShaderSpec*> hosts = host_shaders();
    all.insert(all.end(), hosts.begin(), hosts.end());
    return all;
  }());
  return registry;
}

const std::vector<std::string>& builtin_packages() {
  static const std::vector<std::string> packages = {"base", "architectural", "physics", "oriel"};
  return packages;
}

std::string type_text(const ParamSpec& param) {
  if (param.type == ParamType::Array)
    return fmt::format("array {}", scene::type_name(param.element));
  return std::string(scene::type_name(param.type));
}

std::string mi_declarations(const Registry& registry, std::string_view library) {
  std::string text = fmt::format(
      "# Declarations of Oriel's {0} library, generated from the shaders' own tables.\n"
      "$ifndef \"{0}_mi_included\"\nset \"{0}_mi_included\"\n\n",
      library);
  for (const ShaderSpec* spec : registry.all()) {
    if (library != spec->library) continue;
    std::string result(scene::type_name(spec->result));
    if (spec->result == ParamType::Struct) {
      result = "struct {";
      for (const ParamSpec& member : spec->results)
        result += fmt::format("{} {} \"{}\"", &member == spec->results.data() ? "" : ",",
                              type_text(member), member.name);
      result += " }";
    }
    text += fmt::format("# {}\ndeclare shader {} \"{}\" (\n", spec->doc, result, spec->name);
    for (const ParamSpec& param : spec->params)
      text += fmt::format("    {} \"{}\"{}{}  # {}\n", type_text(param), param.name,
                          declared_default(param), &param == &spec->params.back() ? "" : ",",
                          param.doc);
    text += fmt::format("    )\n    version {}\n    apply {}\nend declare\n\n", spec->version,
                        apply_words(spec->apply));
  }
  return text + "$endif\n";
}

}  // namespace oriel
