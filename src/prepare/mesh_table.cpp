// SPDX-License-Identifier: Apache-2.0
#include "prepare/mesh_table.h"

#include <fmt/format.h>

#include <atomic>
#include <memory>

#include "base/parallel.h"
#include "geom/motion.h"
#include "geom/tessellate.h"
#include "prepare/refine_displacement.h"

namespace oriel {
namespace {

/// Surfaces that are tessellated by approximations.
std::size_t surfaces_of(const scene::Object& object) {
  std::size_t count = 0;
  for (const scene::PolygonGroup& group : object.groups)
    count += group.subdivisions.size() + group.freeform.surfaces.size();
  return count;
}

/// Triangles that the polygons of an object have without approximations.
std::size_t triangles_in_file(const scene::Object& object) {
  std::size_t count = 0;
  for (const scene::PolygonGroup& group : object.groups)
    count += group.polygons.indices.size() -
             std::min(group.polygons.indices.size(), 2 * group.polygons.size());
  return count;
}

/// Messages of a task that ran in parallel with others; null if there are none.
using TaskMessages = std::unique_ptr<Diagnostics>;

/// Runs the task and returns what it reported.
template <class Task>
TaskMessages messages_of(const Task& task) {
  auto messages = std::make_unique<Diagnostics>();
  task(*messages);
  return messages->all().empty() ? nullptr : std::move(messages);
}

void report(const TaskMessages& messages, Diagnostics& to) {
  if (!messages) return;
  for (const Diagnostic& d : messages->all())
    to.report(d.severity, d.code, d.where, d.message, d.hint);
}

}  // namespace

/// Triangles that displacement may add. The meshes are refined in order; each may take all that is
/// left, except for a small share of the later ones.
class MeshTable::RefinementBudget {
 public:
  RefinementBudget(std::uint64_t most, std::uint64_t used, const std::vector<MeshVariant>& variants)
      : left_(most - std::min(most, used)) {
    for (const MeshVariant& v : variants) later_ += !v.displacement.empty();
    constexpr std::uint64_t kShare = 65536;
    share_ = later_ > 0 ? std::min(kShare, left_ / later_) : 0;
  }
  /// An equal share; next() is not below it while no mesh takes more.
  std::size_t each() const { return later_ > 0 ? static_cast<std::size_t>(left_ / later_) : 0; }
  std::size_t next() const {
    const std::uint64_t others = later_ > 1 ? (later_ - 1) * share_ : 0;
    return static_cast<std::size_t>(left_ - std::min(left_, others));
  }
  void take(const geom::Mesh& mesh, const MeshVariant& variant) {
    if (variant.displacement.empty()) return;
    --later_;
    left_ -= std::min<std::uint64_t>(left_, mesh.triangles.size());
  }
  void count_limited(const scene::Object& object) {
    if (limited_++ == 0) first_ = &object;
  }
  void report(const SceneBudgets& budgets, Diagnostics& diagnostics) const {
    if (limited_ == 0) return;
    diagnostics.warning(
        "OR-RN-081", first_->where,
        fmt::format("the displacement of {} object(s), of \"{}\" first, requests {}; "
                    "they are refined less",
                    limited_, first_->name, budgets.excess(Budget::Triangles)),
        SceneBudgets::hint(Budget::Triangles));
  }

 private:
  std::uint64_t left_, share_ = 0;
  std::size_t later_ = 0, limited_ = 0;
  const scene::Object* first_ = nullptr;
};

/// A displaced mesh that was made in parallel with others.
struct MeshTable::Displaced {
  geom::Mesh mesh;
  /// The limit of triangles did not affect it. If it did, `mesh` is empty.
  bool complete = false;
  TaskMessages messages;
};

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
    world.accel->keep_apart(cache.least_apart);
    cache.forms.clear();
  }
  world.accel->begin_again();
  meshes_.resize(size());
  kept_.resize(size());
  for (std::size_t i = 0; i < size(); ++i) kept_[i] = kept_mesh(plan_.jobs[i]);
  const std::uint64_t most = world.budgets[Budget::Triangles];
  if (subdivided() <= most && make_all(most, diagnostics)) return;
  limit_surfaces();
  make_all(UINT64_MAX, diagnostics);
}

std::uint64_t MeshTable::subdivided() const {
  std::atomic<std::uint64_t> sum = 0;
  parallel_for(size(), [&](std::size_t i) {
    if (!kept_[i] && surfaces_of(*plan_.jobs[i].object) > 0)
      sum += geom::subdivided_triangles(*plan_.jobs[i].object, plan_.jobs[i].context);
  });
  return sum;
}

bool MeshTable::make_all(std::uint64_t most, Diagnostics& diagnostics) {
  // The sum decides, not the order: the result does not depend on the threads.
  std::atomic<std::uint64_t> generated = 0;
  std::vector<TaskMessages> messages(size());
  parallel_for(size(), [&](std::size_t i) {
    if (kept_[i] || generated > most) return;
    messages[i] = messages_of([&](Diagnostics& own) { meshes_[i] = make(i, own); });
    if (surfaces_of(*plan_.jobs[i].object) == 0) return;
    const std::size_t written = triangles_in_file(*plan_.jobs[i].object);
    const std::size_t all = meshes_[i].triangles.size();
    generated += all - std::min(all, written);
  });
  generated_ = generated;
  // Beyond the budget, all objects are tessellated again with limits, and report then.
  if (generated > most) return false;
  for (const TaskMessages& of_job : messages) report(of_job, diagnostics);
  return true;
}

void MeshTable::limit_surfaces() {
  const std::uint64_t most = world_.budgets[Budget::Triangles];
  std::size_t surfaces = 0;
  const scene::Object* first = nullptr;
  for (const TessellationJob& job : plan_.jobs) {
    surfaces += surfaces_of(*job.object);
    if (!first && surfaces > 0) first = job.object;
  }
  const std::size_t each = std::max<std::size_t>(most / surfaces, 2);
  for (std::size_t i = 0; i < size(); ++i) {
    plan_.jobs[i].context.most_triangles = each;
    meshes_[i] = {};
  }
  diagnostics_.warning(
      "OR-RN-080", first->where,
      fmt::format("{} subdivision and free-form surfaces, of object \"{}\" first, request {}; each "
                  "is limited to {}",
                  surfaces, first->name, world_.budgets.excess(Budget::Triangles), each),
      SceneBudgets::hint(Budget::Triangles));
}

const std::vector<geom::MaterialSlot>& MeshTable::slots(std::size_t job) const {
  return kept_[job] ? world_.accel->mesh(*kept_[job]).slots : meshes_[job].slots;
}

std::vector<MeshTable::Displaced> MeshTable::displace_all(const std::vector<MeshVariant>& variants,
                                                          const std::vector<std::size_t>& uses,
                                                          std::size_t most) {
  std::vector<std::size_t> tasks;
  for (std::size_t i = 0; i < variants.size(); ++i)
    if (!variants[i].displacement.empty()) tasks.push_back(i);
  std::vector<Displaced> made(variants.size());
  parallel_for(tasks.size(), [&](std::size_t task) {
    const MeshVariant& v = variants[tasks[task]];
    Displaced& result = made[tasks[task]];
    result.messages = messages_of([&](Diagnostics& own) {
      geom::Mesh mesh = kept_[v.job]       ? make(v.job, own)
                        : uses[v.job] == 1 ? std::move(meshes_[v.job])
                                           : meshes_[v.job];
      result.complete = refine_for_displacement(mesh, v.displacement, *v.first,
                                                plan_.jobs[v.job].context, world_, most, own);
      if (!result.complete) return;
      displace(mesh, v.displacement, *v.first, world_, own);
      result.mesh = std::move(mesh);
    });
  });
  return made;
}

geom::Mesh MeshTable::displaced_mesh(const MeshVariant& v, Displaced made, std::size_t each,
                                     RefinementBudget& left) {
  // A limit has no effect on a mesh that stays below it.
  const std::size_t most = left.next();
  const bool in_reach = each < kMaxMicroTriangles && made.mesh.triangles.size() <= most;
  if (made.complete && (most >= each || in_reach)) {
    report(made.messages, diagnostics_);
    return std::move(made.mesh);
  }
  Diagnostics reported_before;
  geom::Mesh mesh = make(v.job, kept_[v.job] ? diagnostics_ : reported_before);
  if (!refine_for_displacement(mesh, v.displacement, *v.first, plan_.jobs[v.job].context, world_,
                               most, diagnostics_))
    left.count_limited(*plan_.jobs[v.job].object);
  displace(mesh, v.displacement, *v.first, world_, diagnostics_);
  return mesh;
}

void MeshTable::add(std::vector<MeshVariant>& variants, PrepareReport& report) {
  std::vector<std::size_t> uses(size());
  for (const MeshVariant& v : variants) ++uses[v.job];
  RefinementBudget left(world_.budgets[Budget::Triangles], generated_, variants);
  // In parallel, each within its share; what needs more is made again in order.
  const std::size_t each = left.each();
  std::vector<Displaced> displaced = displace_all(variants, uses, each);
  std::map<std::string, std::vector<GeometryCache::Form>, std::less<>> forms;
  cache_.reused = 0;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    MeshVariant& v = variants[i];
    const bool last = --uses[v.job] == 0;
    const bool plain = v.displacement.empty();
    if (plain && kept_[v.job]) {
      v.id = *kept_[v.job];
      ++cache_.reused;
    } else {
      // A plain mesh is copied unless this is its last use.
      geom::Mesh mesh = !plain ? displaced_mesh(v, std::move(displaced[i]), each, left)
                        : last ? std::move(meshes_[v.job])
                               : meshes_[v.job];
      left.take(mesh, v);
      v.id = world_.accel->add_mesh(with_keys(std::move(mesh)));
    }
    report.triangles += world_.accel->mesh(v.id).triangles.size();
    if (!plain) continue;
    plain_[v.id] = v.job;
    GeometryCache::Form form = form_of(plan_.jobs[v.job]);
    form.mesh = v.id;
    forms[plan_.jobs[v.job].object->name].push_back(std::move(form));
  }
  left.report(world_.budgets, diagnostics_);
  cache_.forms = std::move(forms);
  cache_.shutter = world_.shutter;
  cache_.hair = world_.options.hair;
}

void MeshTable::commit() {
  world_.accel->commit(
      [this](geom::MeshId id) { return with_keys(make(plain_.at(id), diagnostics_)); });
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

geom::Mesh MeshTable::make(std::size_t job, Diagnostics& diagnostics) const {
  geom::Mesh mesh = geom::tessellate(*plan_.jobs[job].object, plan_.jobs[job].context, diagnostics);
  if (!world_.options.hair) mesh.curves = {};
  return mesh;
}

geom::Mesh MeshTable::with_keys(geom::Mesh mesh) const {
  if (world_.shutter.on) geom::add_keys(mesh, world_.shutter.first, world_.shutter.last);
  return mesh;
}

}  // namespace oriel
