// SPDX-License-Identifier: Apache-2.0
#include "prepare/mesh_table.h"

#include "base/parallel.h"
#include "geom/motion.h"
#include "geom/tessellate.h"
#include "prepare/refine_displacement.h"

namespace oriel {

MeshTable::MeshTable(const scene::Scene& scene, TessellationPlan plan, World& world,
                     GeometryCache& cache, Diagnostics& diagnostics)
    : scene_(scene),
      plan_(std::move(plan)),
      world_(world),
      cache_(cache),
      diagnostics_(diagnostics) {
  world.accel = std::move(cache.accel);
  if (!world.accel || !cache.shutter.same_span(world.shutter) || cache.hair != world.options.hair) {
    world.accel = std::make_unique<geom::Accel>();
    cache.forms.clear();
  }
  world.accel->begin_again();
  meshes_.resize(size());
  kept_.resize(size());
  for (std::size_t i = 0; i < size(); ++i) kept_[i] = kept_mesh(plan_.jobs[i]);
  parallel_for(size(), [&](std::size_t i) {
    if (!kept_[i]) meshes_[i] = make(i);
  });
}

const std::vector<geom::MaterialSlot>& MeshTable::slots(std::size_t job) const {
  return kept_[job] ? world_.accel->mesh(*kept_[job]).slots : meshes_[job].slots;
}

void MeshTable::add(std::vector<MeshVariant>& variants, PrepareReport& report) {
  std::vector<std::size_t> uses(size());
  for (const MeshVariant& v : variants) ++uses[v.job];
  std::map<std::string, std::vector<GeometryCache::Form>, std::less<>> forms;
  cache_.reused = 0;
  for (MeshVariant& v : variants) {
    // Copied unless this is the last use.
    const bool last = --uses[v.job] == 0;
    const bool plain = v.displacement.empty();
    if (plain && kept_[v.job]) {
      v.id = *kept_[v.job];
      ++cache_.reused;
    } else {
      geom::Mesh mesh = kept_[v.job] ? make(v.job)
                        : last       ? std::move(meshes_[v.job])
                                     : meshes_[v.job];
      refine_for_displacement(mesh, v.displacement, *v.first, plan_.jobs[v.job].context, world_,
                              diagnostics_);
      displace(mesh, v.displacement, *v.first, world_, diagnostics_);
      v.id = world_.accel->add_mesh(with_keys(std::move(mesh)));
    }
    report.triangles += world_.accel->mesh(v.id).triangles.size();
    if (!plain) continue;
    plain_[v.id] = v.job;
    GeometryCache::Form form = form_of(plan_.jobs[v.job]);
    form.mesh = v.id;
    forms[plan_.jobs[v.job].object->name].push_back(std::move(form));
  }
  cache_.forms = std::move(forms);
  cache_.shutter = world_.shutter;
  cache_.hair = world_.options.hair;
}

void MeshTable::commit() {
  world_.accel->commit([this](geom::MeshId id) { return with_keys(make(plain_.at(id))); });
}

GeometryCache::Form MeshTable::form_of(const TessellationJob& job) const {
  GeometryCache::Form form;
  form.revisions = {scene_.revision(job.object->name)};
  if (!job.approximated) return form;
  form.view = job.context.view;
  if (job.context.options) form.revisions.push_back(scene_.revision(job.context.options->name));
  for (const scene::Instance* instance : job.context.chain)
    form.revisions.push_back(scene_.revision(instance->name));
  return form;
}

std::optional<geom::MeshId> MeshTable::kept_mesh(const TessellationJob& job) const {
  const auto found = cache_.forms.find(job.object->name);
  if (found == cache_.forms.end()) return std::nullopt;
  const GeometryCache::Form wanted = form_of(job);
  for (const GeometryCache::Form& form : found->second)
    if (form.same_shape(wanted) && !world_.accel->mesh(form.mesh).empty()) return form.mesh;
  return std::nullopt;
}

geom::Mesh MeshTable::make(std::size_t job) const {
  geom::Mesh mesh =
      geom::tessellate(*plan_.jobs[job].object, plan_.jobs[job].context, diagnostics_);
  if (!world_.options.hair) mesh.curves = {};
  return mesh;
}

geom::Mesh MeshTable::with_keys(geom::Mesh mesh) const {
  if (world_.shutter.on) geom::add_keys(mesh, world_.shutter.first, world_.shutter.last);
  return mesh;
}

}  // namespace oriel
