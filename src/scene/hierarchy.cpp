// SPDX-License-Identifier: Apache-2.0
#include "scene/hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "scene/element_settings.h"
#include "scene/motion.h"

namespace oriel::scene {
namespace {

// double: for products over many levels and inverses of matrices far from the origin.
using Matrix = Imath::M44d;

constexpr std::size_t kNoElement = ~std::size_t{0};
/// Instances in all chains that are always possible; 8 MB.
constexpr std::uint64_t kFewLinks = 1'000'000;
// Limit for the search for a similar name, which compares with every name.
constexpr std::size_t kMaxNamesSearched = 20'000;

Matrix matrix_of(const std::optional<Mat4>& matrix, bool singular) {
  return matrix && !singular ? Matrix(*matrix) : Matrix();
}

/// Data of an instance besides its matrices, computed and validated once per instance. Must be
/// small: a scene can have millions of instances.
struct InstanceInfo {
  std::size_t element = kNoElement;
  FlagLayer flags;
  bool known = false, overrides = false, motion_off = false;
  bool singular = false, motion_singular = false;
};

/// State inherited along a path of instances.
struct Inherited {
  Matrix to_local, to_world;
  Matrix motion_to_local;
  bool moves = false;
  std::size_t first_moving = 0;
  const Instance* material_source = nullptr;
  bool material_override = false;
  const LightLinks* light_links = nullptr;
  const LightLinks* shadow_links = nullptr;
  FlagLayer flags;
};

class Flattener {
 public:
  Flattener(const Scene& scene, Diagnostics& diagnostics, const FlattenLimits& limits,
            const FlagLayer& defaults)
      : scene_(scene),
        diagnostics_(diagnostics),
        limits_(limits),
        defaults_(defaults),
        instances_(scene.elements().size()),
        groups_(scene.elements().size()),
        objects_(scene.elements().size()) {}

  std::vector<Leaf> run(std::string_view root) {
    const std::size_t index = index_of(root);
    if (index == kNoElement) {
      report_missing("OR-SC-301", {}, fmt::format("the root '{}' is not defined", root), root);
    } else if (std::holds_alternative<InstanceGroup>(element(index))) {
      visit_group(index, {});
    } else if (std::holds_alternative<Instance>(element(index))) {
      visit_instance(index, {});
    } else {
      diagnostics_.error("OR-SC-301", place_of(element(index)),
                         fmt::format("the root '{}' is neither a group nor an instance", root));
    }
    if (assumed_on_ > 0)
      diagnostics_.note(
          "OR-SC-307", first_assumed_,
          fmt::format("{} placed object(s), this one first, have none of the flags visible, shadow "
                      "and trace; taken as on",
                      assumed_on_),
          "write 'visible on shadow on trace on' in the object");
    return std::move(leaves_);
  }

 private:
  const Element& element(std::size_t index) const { return scene_.elements()[index]; }

  std::size_t index_of(std::string_view name) const {
    const Element* found = scene_.find(name);
    return found ? static_cast<std::size_t>(found - scene_.elements().data()) : kNoElement;
  }

  void report_missing(std::string_view code, SourceLocation where, std::string message,
                      std::string_view name) {
    std::string hint;
    if (scene_.elements().size() <= kMaxNamesSearched) {
      std::vector<std::string> names;
      for (const Element& e : scene_.elements()) names.push_back(name_of(e));
      const std::string near = nearest_name(name, names);
      if (!near.empty()) hint = fmt::format("did you mean '{}'?", near);
    }
    diagnostics_.error(code, where, std::move(message), std::move(hint));
  }

  /// Indices of the members that are instances.
  struct GroupInfo {
    std::vector<std::size_t> members;
    bool open = false;  ///< part of the current path
    bool cycle_reported = false;
  };

  GroupInfo& group_info(std::size_t index) {
    auto& info = groups_[index];
    if (info) return *info;
    info = std::make_unique<GroupInfo>();
    const auto& group = std::get<InstanceGroup>(element(index));
    for (const std::string& name : group.members) {
      const std::size_t member = index_of(name);
      if (member == kNoElement)
        report_missing("OR-SC-302", group.where,
                       fmt::format("group '{}' names '{}', which is not defined", group.name, name),
                       name);
      else if (!std::holds_alternative<Instance>(element(member)))
        diagnostics_.error(
            "OR-SC-303", group.where,
            fmt::format("group '{}' names '{}', which is not an instance", group.name, name),
            "groups hold instances: make one of this element and name that");
      else
        info->members.push_back(member);
    }
    return *info;
  }

  bool check_singular(const std::optional<Mat4>& matrix, const Instance& instance) {
    if (!matrix || !is_singular(Matrix(*matrix))) return false;
    diagnostics_.warning(
        "OR-SC-306", instance.where,
        fmt::format("the transform of '{}' is singular; identity is used", instance.name),
        "an instance requires an invertible matrix");
    return true;
  }

  /// Index of the element that an instance places, or kNoElement.
  std::size_t placed_element(const Instance& instance) {
    if (!instance.geometry.empty()) return kNoElement;
    const std::size_t index = index_of(instance.element);
    if (index == kNoElement) {
      report_missing("OR-SC-302", instance.where,
                     fmt::format("instance '{}' places '{}', which is not defined", instance.name,
                                 instance.element),
                     instance.element);
      return kNoElement;
    }
    const Element& e = element(index);
    // A placeholder is replaced by its loaded content. Placeholders without content were reported
    // by the reader.
    if (const auto* object = std::get_if<Object>(&e); object && !object->content.empty())
      return index_of(object->content);
    if (const auto* assembly = std::get_if<Assembly>(&e))
      return assembly->content.empty() ? kNoElement : index_of(assembly->content);
    const bool placeable = std::holds_alternative<Object>(e) || std::holds_alternative<Light>(e) ||
                           std::holds_alternative<Camera>(e) ||
                           std::holds_alternative<InstanceGroup>(e);
    if (placeable) return index;
    diagnostics_.error("OR-SC-303", instance.where,
                       fmt::format("instance '{}' places '{}', which cannot be placed",
                                   instance.name, instance.element),
                       "an instance contains an object, light, camera, group or geometry shader");
    return kNoElement;
  }

  const InstanceInfo& instance_info(std::size_t index) {
    InstanceInfo& info = instances_[index];
    if (info.known) return info;
    const auto& instance = std::get<Instance>(element(index));
    info.known = true;
    info.singular = check_singular(instance.transform, instance);
    info.motion_singular = check_singular(instance.motion_transform, instance);
    const InstanceSettings settings = settings_of(instance, &diagnostics_);
    info.flags = settings.flags;
    info.overrides = settings.overrides;
    info.motion_off = settings.motion_off;
    info.element = placed_element(instance);
    return info;
  }

  Inherited descend(const Inherited& above, const Instance& instance,
                    const InstanceInfo& info) const {
    Inherited below = above;
    const Matrix m = matrix_of(instance.transform, info.singular);
    below.to_local = above.to_local * m;
    below.to_world = m.inverse() * above.to_world;
    below.moves = above.moves || instance.motion_transform;
    below.motion_to_local =
        above.motion_to_local * (instance.motion_transform
                                     ? matrix_of(instance.motion_transform, info.motion_singular)
                                     : m);
    if (info.motion_off) {
      below.motion_to_local = below.to_local;
      below.moves = false;
      below.first_moving = chain_.size() + 1;
    }
    // The nearest instance with materials applies, unless a higher one has `override`.
    if (!instance.materials.empty() && !above.material_override) {
      below.material_source = &instance;
      below.material_override = info.overrides;
    }
    if (instance.light_links) below.light_links = &*instance.light_links;
    if (instance.shadow_links) below.shadow_links = &*instance.shadow_links;
    below.flags = overlay(above.flags, info.flags);
    return below;
  }

  void visit_group(std::size_t index, const Inherited& above) {
    GroupInfo& group = group_info(index);
    if (group.open) {
      if (!std::exchange(group.cycle_reported, true))
        diagnostics_.error(
            "OR-SC-304", place_of(element(index)),
            fmt::format("group '{}' contains itself", name_of(element(index))),
            chain_.empty() ? "" : fmt::format("through instance '{}'", chain_.back()->name));
      return;
    }
    if (chain_.size() >= limits_.depth)
      return stop(fmt::format("groups are nested more than {} deep", limits_.depth));
    group.open = true;
    for (const std::size_t member : group.members) {
      if (stopped_) break;
      visit_instance(member, above);
    }
    group.open = false;
  }

  void visit_instance(std::size_t index, const Inherited& above) {
    if (++visits_ > limits_.visits)
      return stop(fmt::format("the groups hold more than {} instances", limits_.visits));
    const auto& instance = std::get<Instance>(element(index));
    const InstanceInfo& info = instance_info(index);
    if (info.element == kNoElement && instance.geometry.empty()) return;
    const Inherited here = descend(above, instance, info);
    chain_.push_back(&instance);
    if (info.element != kNoElement && std::holds_alternative<InstanceGroup>(element(info.element)))
      visit_group(info.element, here);
    else
      add_leaf(info.element, here);
    chain_.pop_back();
  }

  void add_leaf(std::size_t index, const Inherited& here) {
    if (leaves_.size() >= limits_.leaves)
      return stop(fmt::format("the scene places more than {} elements", limits_.leaves),
                  SceneBudgets::hint(Budget::Instances));
    links_ += chain_.size();
    if (links_ > std::max(limits_.leaves * limits_.mean_depth, kFewLinks))
      return stop(fmt::format("{} placed elements have {} instances above them, more than {} each",
                              leaves_.size() + 1, links_, limits_.mean_depth),
                  SceneBudgets::hint(Budget::Instances));
    Leaf& leaf = leaves_.emplace_back();
    leaf.element = index == kNoElement ? nullptr : &element(index);
    leaf.chain = chain_;
    leaf.world_to_local = Mat4(here.to_local);
    leaf.local_to_world = Mat4(here.to_world);
    leaf.first_moving = here.first_moving;
    if (here.moves) leaf.motion_world_to_local = Mat4(here.motion_to_local);
    leaf.material_source = here.material_source;
    leaf.material_override = here.material_override;
    leaf.light_links = here.light_links;
    leaf.shadow_links = here.shadow_links;
    leaf.kind = !leaf.element   ? LeafKind::GeometryShader
                : leaf.light()  ? LeafKind::Light
                : leaf.camera() ? LeafKind::Camera
                                : LeafKind::Object;
    const bool is_object = leaf.kind == LeafKind::Object;
    leaf.flags =
        resolve(is_object ? overlay(defaults_, flags_of_object(index)) : FlagLayer{}, here.flags);
    if (is_object && leaf.flags.assumed_on && assumed_on_++ == 0)
      first_assumed_ = place_of(element(index));
  }

  const FlagLayer& flags_of_object(std::size_t index) {
    auto& layer = objects_[index];
    if (!layer) layer = settings_of(std::get<Object>(element(index)), &diagnostics_).flags;
    return *layer;
  }

  void stop(const std::string& message, const std::string& hint = {}) {
    if (!std::exchange(stopped_, true))
      diagnostics_.error("OR-SC-305", chain_.empty() ? SourceLocation{} : chain_.back()->where,
                         message + "; the rest of the scene is left out", hint);
  }

  const Scene& scene_;
  Diagnostics& diagnostics_;
  const FlattenLimits& limits_;
  const FlagLayer& defaults_;
  // Indexed by element; computed on first use.
  std::vector<InstanceInfo> instances_;
  std::vector<std::unique_ptr<GroupInfo>> groups_;
  std::vector<std::optional<FlagLayer>> objects_;
  std::vector<const Instance*> chain_;
  std::vector<Leaf> leaves_;
  std::uint64_t links_ = 0;  // of all chains
  std::size_t visits_ = 0, assumed_on_ = 0;
  SourceLocation first_assumed_;
  bool stopped_ = false;
};

}  // namespace

std::vector<Leaf> flatten(const Scene& scene, std::string_view root, Diagnostics& diagnostics,
                          const FlattenLimits& limits, const FlagLayer& defaults) {
  return Flattener(scene, diagnostics, limits, defaults).run(root);
}

}  // namespace oriel::scene
