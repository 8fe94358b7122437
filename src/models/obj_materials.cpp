// SPDX-License-Identifier: Apache-2.0
#include "models/obj_materials.h"

#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <locale>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include "scene/asset_path.h"

namespace oriel::models {
namespace {

namespace fs = std::filesystem;

struct ObjMaterial {
  std::optional<float> dissolve;  ///< `d`
  std::optional<std::array<float, 3>> filter;
  int illum = 0;
  bool pbr = false;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == text.npos ? "" : text.substr(first, last - first + 1);
}

/// Lines of an OBJ or MTL file as keyword and the rest.
template <class F>
void each_line(std::istream& file, F&& use) {
  for (std::string line; std::getline(file, line);) {
    line = trimmed(line);
    const auto end = line.find_first_of(" \t");
    if (end != line.npos) use(line.substr(0, end), trimmed(line.substr(end)));
  }
}

void read_materials(std::istream& file, std::map<std::string, ObjMaterial>& materials) {
  ObjMaterial* now = nullptr;
  each_line(file, [&](const std::string& keyword, const std::string& rest) {
    if (keyword == "newmtl") now = &materials[rest];
    if (!now) return;
    std::istringstream values(rest);
    values.imbue(std::locale::classic());
    if (keyword == "illum") values >> now->illum;
    if (keyword == "Pr" || keyword == "Pm") now->pbr = true;
    if (float d = 1; keyword == "d" && values >> d) now->dissolve = d;
    if (float r = 0; keyword == "Tf" && values >> r) {
      float g = 0, b = 0;
      now->filter = {r, r, r};  // one number holds for all channels
      if (values >> g >> b) now->filter = {r, g, b};
    }
  });
}

struct ObjHead {
  std::vector<std::string> material_files;
  std::string generator;  ///< the first comment
};

ObjHead read_head(const std::string& path) {
  ObjHead head;
  std::vector<std::string>& names = head.material_files;
  std::ifstream file(path);
  each_line(file, [&](const std::string& keyword, const std::string& rest) {
    if (keyword == "mtllib" && std::find(names.begin(), names.end(), rest) == names.end())
      names.push_back(rest);
    if (keyword == "#" && head.generator.empty()) head.generator = rest;
  });
  return head;
}

}  // namespace

void mend_obj_materials(aiScene& model, const std::string& path, ModelFiles& files,
                        Diagnostics& diagnostics) {
  std::map<std::string, ObjMaterial> materials;
  const ObjHead head = read_head(path);
  if (model.mMetaData && !head.generator.empty())
    model.mMetaData->Add(AI_METADATA_SOURCE_GENERATOR, aiString(head.generator));
  for (const std::string& name : head.material_files) {
    const fs::path beside = fs::path(path).parent_path() / scene::with_slashes(name);
    OpenFile opened = files.access.open(beside.string(), files.use);
    if (opened.is_refused() || opened.fault() == OpenFile::Fault::NotRegular) {
      files.refused.emplace(beside.string(), opened.hint().empty()
                                                 ? opened.reason()
                                                 : opened.reason() + "; " + opened.hint());
      continue;
    }
    if (!opened) {
      diagnostics.warning(
          "OR-MD-015", {},
          fmt::format("the material file \"{}\" does not exist; its materials are grey", name),
          "copy it beside the model");
      continue;
    }
    std::istringstream file(opened.read());
    read_materials(file, materials);
  }
  for (unsigned i = 0; i < model.mNumMaterials; ++i) {
    aiMaterial& material = *model.mMaterials[i];
    const auto found = materials.find(material.GetName().C_Str());
    if (found == materials.end()) continue;
    const ObjMaterial& written = found->second;
    if (written.dissolve) material.AddProperty(&*written.dissolve, 1, AI_MATKEY_OPACITY);
    constexpr int kGlass[] = {4, 6, 7, 9};
    const bool glass =
        std::find(std::begin(kGlass), std::end(kGlass), written.illum) != std::end(kGlass);
    if (!written.filter || !(glass || written.pbr)) continue;
    const auto [r, g, b] = *written.filter;
    const aiColor3D filter(r, g, b);
    if (!filter.IsBlack()) material.AddProperty(&filter, 1, ORIEL_MATKEY_FILTER);
  }
}

}  // namespace oriel::models
