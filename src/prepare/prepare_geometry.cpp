// SPDX-License-Identifier: Apache-2.0
// Converts objects to meshes, leaves to instances, names to materials, flags to ray masks.
#include <fmt/format.h>
#include <malloc.h>

#include <map>

#include "prepare/flat_panes.h"
#include "prepare/mesh_table.h"
#include "prepare/prepare_parts.h"

namespace oriel {
namespace {

/// Materials by name; each is bound once. Materials that the world has are not bound again.
class MaterialTable {
 public:
  MaterialTable(const scene::Scene& scene, Binder& binder, World& world, Diagnostics& diagnostics)
      : scene_(scene), binder_(binder), world_(world), diagnostics_(diagnostics) {
    for (std::size_t i = 0; i < world.materials.size(); ++i)
      known_.try_emplace(world.materials[i].name, static_cast<int>(i));
  }

  int find(const std::string& name, SourceLocation where) {
    const auto [entry, is_new] =
        known_.try_emplace(name, static_cast<int>(world_.materials.size()));
    if (is_new) {
      const std::size_t before = diagnostics_.all().size();
      world_.materials.push_back(bind_material(scene_, name, where, binder_, diagnostics_));
      world_.materials.back().has_messages = diagnostics_.all().size() != before;
    }
    return entry->second;
  }

 private:
  const scene::Scene& scene_;
  Binder& binder_;
  World& world_;
  Diagnostics& diagnostics_;
  std::map<std::string, int> known_;
};

int material_of_slot(const scene::Leaf& leaf, const geom::MaterialSlot& slot,
                     MaterialTable& materials) {
  const scene::Instance* source = leaf.material_source;
  const auto from_instance = [&](std::size_t label) {
    if (!source || source->materials.empty()) return materials.find({}, leaf.instance().where);
    return materials.find(source->materials[std::min(label, source->materials.size() - 1)],
                          source->where);
  };
  if (slot.label != scene::kNone) return from_instance(slot.label);
  if (!slot.name.empty() && !(leaf.material_override && source))
    return materials.find(slot.name, leaf.object()->where);
  return from_instance(0);
}

std::uint32_t ray_mask(const scene::ResolvedFlags& flags, bool lets_light_through) {
  std::uint32_t mask = 0;
  if (flags.visible) mask |= geom::RayMask::Camera;
  if (flags.casts_shadow)
    mask |= lets_light_through ? geom::RayMask::ShadowTransparent : geom::RayMask::Shadow;
  if (flags.reflection.seen) mask |= geom::RayMask::Reflection | geom::RayMask::Probe;
  if (flags.refraction.seen) mask |= geom::RayMask::Refraction;
  if (flags.transparency.seen) mask |= geom::RayMask::Transparency;
  if (flags.finalgather.seen) mask |= geom::RayMask::FinalGather;
  if (!flags.casts_shadow) {
    if (flags.reflection.seen) mask |= geom::RayMask::ShadowlessReflection;
    if (flags.refraction.seen) mask |= geom::RayMask::ShadowlessRefraction;
    if (flags.finalgather.seen) mask |= geom::RayMask::ShadowlessFinalGather;
  }
  return mask;
}

/// Records whether shadow rays and other rays see different objects.
void note_differences(std::uint32_t mask, World& world) {
  using geom::RayMask;
  constexpr std::uint32_t kLobes = RayMask::Reflection | RayMask::Refraction | RayMask::FinalGather;
  world.has_transparent_blockers |= (mask & RayMask::ShadowTransparent) != 0;
  world.has_unseen_blockers |= (mask & RayMask::Shadow) != 0 && (mask & kLobes) != kLobes;
  world.shadowless |= mask & (RayMask::ShadowlessReflection | RayMask::ShadowlessRefraction |
                              RayMask::ShadowlessFinalGather);
}

std::uint16_t visibility(const scene::ResolvedFlags& flags) {
  unsigned bits = 0;
  const auto set = [&](bool on, unsigned bit) { bits |= on ? bit : 0; };
  set(flags.reflection.sends, kSendsReflections);
  set(flags.refraction.sends, kSendsRefractions);
  set(flags.transparency.sends, kSendsTransparency);
  set(flags.finalgather.sends, kSendsGatherRays);
  set(!flags.caustic.excluded, kMeetsCaustics);
  set(flags.caustic.casts, kCastsCaustics);
  set(flags.caustic.receives, kReceivesCaustics);
  set(!flags.globillum.excluded, kMeetsGlobillum);
  set(flags.globillum.casts, kCastsGlobillum);
  set(flags.globillum.receives, kReceivesGlobillum);
  return static_cast<std::uint16_t>(bits);
}

/// The mesh variants in the order of first use by the leaves.
class VariantTable {
 public:
  std::size_t find(std::size_t object, Displacement displacement, const scene::Leaf& leaf) {
    const auto [entry, is_new] =
        known_.try_emplace({object, std::move(displacement)}, variants.size());
    if (is_new) variants.push_back({object, entry->first.second, &leaf, {}});
    return entry->second;
  }
  std::vector<MeshVariant> variants;

 private:
  std::map<std::pair<std::size_t, Displacement>, std::size_t> known_;
};

/// Resolves the lights that an instance is linked to; an empty list means all lights.
void link_lights(const scene::Leaf& leaf, const LightNames& lights, InstanceData& data) {
  if (!leaf.light_links || leaf.light_links->lights.empty()) return;
  data.linked = true;
  data.lights_exclusive = leaf.light_links->exclusive;
  for (const std::string& name : leaf.light_links->lights)
    if (const auto found = lights.find(name); found != lights.end())
      data.lights.insert(data.lights.end(), found->second.begin(), found->second.end());
}

}  // namespace

void place_geometry(scene::Scene& scene, const std::vector<scene::Leaf>& leaves,
                    const LightNames& lights, const std::string& options_name, Binder& binder,
                    const PrepareOptions& options, World& world, Diagnostics& diagnostics,
                    PrepareReport& report) {
  const auto* block = scene.get<scene::Options>(options_name);
  GeometryCache nothing;
  MeshTable meshes(scene, plan_tessellation(leaves, block, world.camera), world,
                   options.cache ? *options.cache : nothing, diagnostics);
  report.objects = meshes.size();

  // Instances, and the form of its object's mesh that each one uses.
  MaterialTable materials(scene, binder, world, diagnostics);
  VariantTable table;
  struct Placed {
    const scene::Leaf* leaf;
    std::size_t variant;
    std::uint32_t mask;
  };
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const scene::Leaf& leaf = leaves[i];
    const std::size_t mesh = meshes.of_leaf(i);
    if (mesh == scene::kNone) continue;
    InstanceData data;
    data.name = leaf.instance().name;
    data.to_object = leaf.world_to_local;
    data.to_world = leaf.local_to_world;
    data.receives_shadow = leaf.flags.receives_shadow;
    data.visibility = visibility(leaf.flags);
    world.photons_part_ways |=
        photon_bits(data.visibility, true) != photon_bits(data.visibility, false);
    bool transmits_light = false;
    for (const geom::MaterialSlot& slot : meshes.slots(mesh)) {
      data.materials.push_back(material_of_slot(leaf, slot, materials));
      if (world.materials[static_cast<std::size_t>(data.materials.back())].may_transmit)
        transmits_light = true;
    }
    link_lights(leaf, lights, data);
    const std::uint32_t mask = ray_mask(leaf.flags, transmits_light);
    note_differences(mask, world);
    placed.push_back({&leaf, table.find(mesh, displacement_of(data.materials, world), leaf), mask});
    world.instances.push_back(std::move(data));
  }

  meshes.add(table.variants, report);
  for (std::size_t i = 0; i < placed.size(); ++i)
    world.accel->add_instance({.mesh = table.variants[placed[i].variant].id,
                               .local_to_world = placed[i].leaf->local_to_world,
                               .world_to_local = placed[i].leaf->world_to_local,
                               .mask = placed[i].mask,
                               .user = static_cast<std::uint32_t>(i),
                               .path = scene::motion_path(*placed[i].leaf, world.shutter)});
  if (options.release_geometry && !meshes.takes_over()) {
    for (scene::Element& element : scene.elements())
      if (auto* object = std::get_if<scene::Object>(&element)) {
        object->groups.clear();
        object->hairs.clear();
      }
    malloc_trim(0);  // the C library would keep most of it while Embree builds
  }
  meshes.commit();
  mark_flat_panes(world);
  const geom::AccelMemory memory = world.accel->memory();
  report.geometry_bytes = memory.meshes + memory.instances + memory.embree;
}

}  // namespace oriel
