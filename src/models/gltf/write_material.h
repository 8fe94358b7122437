// SPDX-License-Identifier: Apache-2.0
// Materials of scenes as materials of glTF.
#pragma once

#include <memory>
#include <set>
#include <string>

namespace oriel::scene {
class Scene;
}

namespace oriel::models::gltf {

class PlainFile;

/// Writes materials and the images that they need to a file.
class MaterialWriter {
 public:
  /// unit: cd/m2 of one pixel unit, for emission.
  MaterialWriter(const scene::Scene& scene, PlainFile& file, float unit);
  ~MaterialWriter();

  /// Index of the material of that name, which is written once.
  ///
  /// Model:   the inverse of the import (import_material.h). A metal is a material with
  ///          refl_is_metal, or whose diffuse weight falls as far as its reflectivity rises; its
  ///          base colour is its colour of reflection. Thin-walled transparency is transmission,
  ///          solid transparency transmission with a volume. cutout_opacity becomes alpha.
  ///          mib_glossy_reflection over a material is its clear coat. oriel_plastic is a
  ///          dielectric of its roughness. Of textures the picture is embedded, with a constant
  ///          factor; what else lies between is left out.
  std::size_t index_of(const std::string& material);

  /// What was approximated, in words.
  const std::set<std::string>& notes() const;
  const std::set<std::string>& extensions() const;

 private:
  class Maker;
  std::unique_ptr<Maker> maker_;
};

}  // namespace oriel::models::gltf
