// SPDX-License-Identifier: Apache-2.0
#include "models/ifc_styles.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace oriel::models {
namespace {

using Id = std::uint64_t;

/// Nesting of materials, booleans and mapped items.
constexpr int kMaxNesting = 20;

/// Position of the parts of material sets, and of the material of such a part.
struct MaterialPart {
  const char* name;
  std::size_t argument;
};
constexpr MaterialPart kMaterialParts[] = {
    {"IFCMATERIALLIST", 0},    {"IFCMATERIALLAYERSETUSAGE", 0},   {"IFCMATERIALLAYERSET", 0},
    {"IFCMATERIALLAYER", 0},   {"IFCMATERIALPROFILESETUSAGE", 0}, {"IFCMATERIALPROFILESET", 2},
    {"IFCMATERIALPROFILE", 2}, {"IFCMATERIALCONSTITUENTSET", 2},  {"IFCMATERIALCONSTITUENT", 2}};

/// The ids of a reference or of a list of references.
std::vector<Id> references(const std::string& argument) {
  std::vector<Id> ids;
  for (const std::string& item :
       argument.starts_with('(') ? step_list(argument) : std::vector{argument})
    if (const Id id = step_reference(item)) ids.push_back(id);
  return ids;
}

class StyleFinder {
 public:
  explicit StyleFinder(StepFile& file) : file_(file) {
    for (std::size_t i = 0; i < file.entities.size(); ++i) {
      by_id_[file.entities[i].id] = i;
      next_ = std::max(next_, file.entities[i].id + 1);
    }
    for (const StepEntity& e : file.entities) collect(e);
  }

  void add() {
    const std::size_t count = file_.entities.size();
    for (std::size_t i = 0; i < count; ++i) {
      const StepEntity& product = file_.entities[i];
      constexpr std::size_t kRepresentation = 6;
      if (product.arguments.size() <= kRepresentation) continue;
      const StepEntity* shape = find(step_reference(product.arguments[kRepresentation]));
      if (!shape || shape->name != "IFCPRODUCTDEFINITIONSHAPE") continue;
      add_to_shape(*shape, material_of(product.id));
    }
    file_.entities.insert(file_.entities.end(), added_.begin(), added_.end());
  }

 private:
  const StepEntity* find(Id id) const {
    const auto found = by_id_.find(id);
    return found == by_id_.end() ? nullptr : &file_.entities[found->second];
  }
  static std::string argument(const StepEntity& e, std::size_t index) {
    return index < e.arguments.size() ? e.arguments[index] : "$";
  }

  void collect(const StepEntity& e) {
    if (e.name == "IFCSTYLEDITEM") {
      if (const Id item = step_reference(argument(e, 0))) styles_[item] = argument(e, 1);
    } else if (e.name == "IFCRELASSOCIATESMATERIAL") {
      for (const Id object : references(argument(e, 4)))
        materials_[object] = step_reference(argument(e, 5));
    } else if (e.name == "IFCRELDEFINESBYTYPE") {
      for (const Id object : references(argument(e, 4)))
        types_[object] = step_reference(argument(e, 5));
    } else if (e.name == "IFCMATERIALDEFINITIONREPRESENTATION") {
      for (const Id representation : references(argument(e, 2)))
        if (const StepEntity* styled = find(representation))
          for (const Id item : references(argument(*styled, 3)))
            if (const StepEntity* style = find(item); style && style->name == "IFCSTYLEDITEM")
              material_styles_.emplace(step_reference(argument(e, 3)), argument(*style, 1));
    } else if (e.name == "IFCSHAPEASPECT") {
      for (const Id representation : references(argument(e, 0)))
        if (const StepEntity* part = find(representation))
          for (const Id item : references(argument(*part, 3))) aspects_[item] = argument(e, 1);
    }
  }

  Id material_of(Id product) const {
    if (const auto own = materials_.find(product); own != materials_.end()) return own->second;
    const auto type = types_.find(product);
    if (type == types_.end()) return 0;
    const auto shared = materials_.find(type->second);
    return shared == materials_.end() ? 0 : shared->second;
  }

  void add_to_shape(const StepEntity& shape, Id material) {
    for (const Id representation : references(argument(shape, 2)))
      if (const StepEntity* items = find(representation))
        for (const Id item : references(argument(*items, 3))) add_to_item(item, material, 0);
  }

  void add_to_item(Id id, Id material, int depth) {
    const StepEntity* item = find(id);
    if (!item || depth > kMaxNesting) return;
    if (item->name == "IFCMAPPEDITEM") {
      const StepEntity* map = find(step_reference(argument(*item, 0)));
      const StepEntity* mapped = map ? find(step_reference(argument(*map, 1))) : nullptr;
      // Booleans and the parts of constituents have styles of their own inside.
      const StepEntity* set = find(material);
      const bool by_part = set && set->name == "IFCMATERIALCONSTITUENTSET";
      if (mapped)
        for (const Id inner : references(argument(*mapped, 3)))
          add_to_item(inner, by_part ? material : 0, depth + 1);
      if (by_part) return;
    }
    if (styles_.contains(id)) return;
    std::string style = operand_style(*item);
    if (style.empty() && material != 0) style = style_of(material, id);
    if (style.empty()) return;
    styles_[id] = style;
    added_.push_back({next_++, "IFCSTYLEDITEM", {fmt::format("#{}", id), style, "$"}});
  }

  /// Of the first operand of a boolean; empty for others.
  std::string operand_style(const StepEntity& item) const {
    const StepEntity* operand = &item;
    for (int depth = 0; operand && operand->name.starts_with("IFCBOOLEAN") && depth < kMaxNesting;
         ++depth) {
      const Id first = step_reference(argument(*operand, 1));
      if (const auto style = styles_.find(first); style != styles_.end()) return style->second;
      operand = find(first);
    }
    return {};
  }

  /// The materials of a material select.
  void materials_in(Id id, std::vector<Id>& found, int depth) const {
    const StepEntity* e = find(id);
    if (!e || depth > kMaxNesting) return;
    if (e->name == "IFCMATERIAL") found.push_back(id);
    for (const MaterialPart& part : kMaterialParts)
      if (e->name == part.name)
        for (const Id inner : references(argument(*e, part.argument)))
          materials_in(inner, found, depth + 1);
  }

  std::string style_of(Id select, Id item) {
    std::vector<Id> materials;
    const StepEntity* set = find(select);
    if (set && set->name == "IFCMATERIALCONSTITUENTSET") {
      const auto aspect = aspects_.find(item);
      for (const Id part : references(argument(*set, 2)))
        if (const StepEntity* e = find(part);
            e && aspect != aspects_.end() && argument(*e, 0) == aspect->second)
          materials_in(part, materials, 0);
    }
    if (materials.empty()) materials_in(select, materials, 0);
    for (const Id material : materials)
      if (const auto style = material_styles_.find(material); style != material_styles_.end())
        return style->second;
    return materials.empty() ? std::string() : grey_style(materials.front());
  }

  /// As grey as assimp's default material.
  std::string grey_style(Id material) {
    const Id color = next_++, shading = next_++, style = next_++, assignment = next_++;
    added_.push_back({color, "IFCCOLOURRGB", {"$", "0.6", "0.6", "0.6"}});
    added_.push_back({shading, "IFCSURFACESTYLESHADING", {fmt::format("#{}", color), "0."}});
    added_.push_back({style,
                      "IFCSURFACESTYLE",
                      {argument(*find(material), 0), ".BOTH.", fmt::format("(#{})", shading)}});
    added_.push_back({assignment, "IFCPRESENTATIONSTYLEASSIGNMENT", {fmt::format("(#{})", style)}});
    return material_styles_[material] = fmt::format("(#{})", assignment);
  }

  StepFile& file_;
  std::vector<StepEntity> added_;
  std::unordered_map<Id, std::size_t> by_id_;
  std::unordered_map<Id, std::string> styles_, material_styles_, aspects_;
  std::unordered_map<Id, Id> materials_, types_;
  Id next_ = 1;
};

}  // namespace

void add_styles_of_materials(StepFile& file) { StyleFinder(file).add(); }

}  // namespace oriel::models
