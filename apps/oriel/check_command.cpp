// SPDX-License-Identifier: Apache-2.0
// oriel check: what a scene uses, and what of it is unknown, missing, approximated or ignored.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/durable_file.h"
#include "check_html.h"
#include "check_shaders.h"
#include "check_thumbnail.h"
#include "command.h"
#include "output/camera_output.h"
#include "prepare/prepare.h"
#include "render/budget.h"
#include "render/indirect_plan.h"
#include "render/session.h"
#include "scene/element_settings.h"
#include "scene/option_table.h"
#include "scene_code.h"
#include "scene_file.h"
#include "sdk/host.h"
#include "sdk/missing_roles.h"
#include "shaders/registry.h"

namespace oriel::app {
namespace {

using nlohmann::json;

struct CheckArguments {
  SceneArguments scene;
  std::string report;
  bool as_json = false;
};

/// Counts the statements that were read and have no effect.
void count_inert(const std::string& where, const scene::StatementTable& table,
                 const std::vector<scene::Statement>& statements,
                 std::map<std::string, int>& kept) {
  for (const scene::Statement& s : statements) {
    const scene::StatementRow* row = table.find(s.keyword);
    if (!row || row->support != scene::Support::Effective) ++kept[where + " " + s.keyword];
  }
}

/// Constructs that were read and have no effect, by keyword.
std::map<std::string, int> kept_constructs(const scene::Scene& scene) {
  std::map<std::string, int> kept;
  const auto count = [&](const std::vector<scene::UninterpretedStatement>& texts,
                         const char* where) {
    for (const scene::UninterpretedStatement& t : texts)
      ++kept[fmt::format("{} {}", where, t.keyword)];
  };
  for (const scene::Element& element : scene.elements()) {
    if (const auto* c = std::get_if<scene::Camera>(&element))
      count_inert("camera", scene::camera_table(), c->other, kept);
    if (const auto* l = std::get_if<scene::Light>(&element))
      count_inert("light", scene::light_table(), l->other, kept);
    if (const auto* k = std::get_if<scene::UninterpretedElement>(&element)) ++kept[k->kind];
    if (const auto* o = std::get_if<scene::Options>(&element)) count(o->uninterpreted, "options");
    if (const auto* c = std::get_if<scene::Camera>(&element)) count(c->uninterpreted, "camera");
    if (const auto* i = std::get_if<scene::Instance>(&element)) count(i->uninterpreted, "instance");
    if (const auto* o = std::get_if<scene::Object>(&element)) count(o->uninterpreted, "object");
  }
  return kept;
}

/// Statements of the options block that a picture goes by.
std::size_t count_statements(const scene::Scene& scene) {
  const auto* block = scene.get<scene::Options>(scene.renders.back().options);
  return block ? block->statements.size() : 0;
}

/// What happens in place of a string option that does not act.
std::string done_instead(std::string_view keyword) {
  if (const scene::StatementRow* row = scene::option_table().find(keyword))
    return std::string(row->meaning);
  return "path tracing and the noise target take its place";
}

json options_json(const scene::RenderOptions& options, const Diagnostics& diagnostics) {
  // In the order of scene::Support.
  constexpr const char* kReasons[] = {"", "not_yet", "kept", "harmless"};
  json without = {{"not_yet", json::array()}, {"kept", json::array()}, {"harmless", json::array()}};
  for (const scene::WithoutEffect& w : options.without_effect) {
    json entry = {{"keyword", w.keyword}};
    if (w.keyword.starts_with('"')) entry["instead"] = done_instead(w.keyword);
    if (w.where.line) {
      entry["file"] = diagnostics.file(w.where.file);
      entry["line"] = w.where.line;
    }
    without[kReasons[static_cast<int>(w.support)]].push_back(std::move(entry));
  }
  return {{"without_effect", without}, {"unknown_strings", options.unknown_strings}};
}

json picture_json(const World& world) {
  const RenderBudget budget = render_budget(world.options, {});
  const IndirectPlan plan = plan_indirect(world.options);
  return {{"width", world.camera.width},
          {"height", world.camera.height},
          {"max_samples", budget.max_samples},
          {"noise_target", budget.noise},
          {"maps_colours", !world.lens.empty()},
          {"indirect_light", plan.name()},
          {"caustics", plan.caustic || plan.sharp_caustics}};
}

/// Which shaders the scene calls, and what is known of them: those that no part of the picture uses
/// as well, and those of outputs and lenses.
void list_shaders(const CheckedScene& checked, json& result) {
  const json used = used_shaders(checked);
  json calls = json::object(), fallbacks = json::object();
  json magenta = json::array(), without_effect = json::array();
  for (const json& shader : used) {
    const std::string type = shader["type"];
    calls[type] = shader["calls"];
    if (shader.value("fallback", false)) fallbacks[type] = shader["calls"];
    if (shader["status"] == "unknown")
      (shader["magenta"] ? magenta : without_effect).push_back(type);
  }
  result["used_shaders"] = used;
  result["shaders"] = calls;
  result["fallbacks"] = fallbacks;
  result["missing"]["shaders"] = magenta;
  result["missing"]["shaders_without_effect"] = without_effect;
  result["textures"] = used_textures(checked);
  result["libraries"] = used_libraries(checked);
}

/// Everything that is said, once as data; text and page are made from it. Leaves the scene.
json inspect(const CheckArguments& a, SceneCode& code, scene::Scene& scene,
             Diagnostics& diagnostics, bool& renders) {
  const Registry& registry = builtin_shaders();
  mi::Reader reader(a.scene.path, read_options(a.scene, registry), diagnostics);
  if (!reader.opened()) return nullptr;
  json result = {{"scene", a.scene.path}, {"frames", 0}};
  while (reader.next_frame(scene)) {
    for (const std::string& edit : a.scene.edits) apply_edit(scene, edit, registry);
    result["frames"] = result["frames"].get<int>() + 1;
    PrepareReport report;
    code.compile(scene);
    sdk::Host host(scene, registry, code.trusted_folders(), diagnostics);
    const auto world = prepare(scene, scene.renders.back(), host.registry(),
                               {.coarse_tables = true}, diagnostics, report);
    if (!world) {
      renders = false;
      break;
    }
    json outputs = json::array();
    if (const scene::Camera* camera = find_camera(scene, scene.renders.back())) {
      sdk::report_missing_roles(scene, scene.renders.back(), camera, world->options.lens,
                                world->options.output, host, diagnostics);
      const std::string folder = std::filesystem::path(a.scene.path).parent_path().string();
      for (const PictureFile& f :
           camera_outputs(*camera, {folder, {folder}}, scene, host.registry(), *world, diagnostics))
        outputs.push_back(f.path);
    }
    host.end_frame();
    const CheckedScene checked{scene, registry, host, report.binding, diagnostics};
    list_shaders(checked, result);
    result["picture"] = picture_json(*world);
    result["outputs"] = outputs;
    result["parameters"] = {{"approximated", report.binding.approximated},
                            {"ignored", report.binding.ignored}};
    result["guessed"] = report.binding.guessed;
    result["missing"]["textures"] = report.binding.missing_textures;
    result["options"] = options_json(world->options, diagnostics);
    result["options"]["statements"] = count_statements(scene);
    result["geometry"] = {{"objects", report.objects},
                          {"instances", report.instances},
                          {"triangles", report.triangles},
                          {"lights", report.lights},
                          {"bytes", report.geometry_bytes}};
  }
  if (result["frames"] == 0) {
    renders = false;
    const sdk::Host host(scene, registry, code.trusted_folders(), diagnostics);
    const BindingReport nothing_bound;
    list_shaders({scene, registry, host, nothing_bound, diagnostics}, result);
    // In the order of scene::Element.
    constexpr std::array<const char*, std::variant_size_v<scene::Element>> kKinds = {
        "options",  "camera",    "light",  "material", "texture", "lightprofile", "object",
        "instance", "instgroup", "shader", "assembly", "data",    "other"};
    std::map<std::string, int> elements;
    for (const scene::Element& element : scene.elements()) ++elements[kKinds[element.index()]];
    result["elements"] = elements;
  }
  result["kept_without_effect"] = kept_constructs(scene);
  result["packages"] = scene.packages;
  return result;
}

void print_counts(const char* title, const json& counts) {
  if (counts.empty()) return;
  fmt::print("{}\n", title);
  for (const auto& [name, count] : counts.items())
    fmt::print("  {:<48} {}\n", name, count.get<int>());
}

void print_names(const char* title, const json& names) {
  if (names.empty()) return;
  fmt::print("{}\n", title);
  for (const json& name : names) {
    if (name.is_string()) {
      fmt::print("  {}\n", name.get<std::string>());
    } else {
      const std::string place =
          name.contains("line")
              ? fmt::format("{}:{}", name["file"].get<std::string>(), name["line"].get<int>())
              : std::string();
      const std::string instead = name.value("instead", "");
      fmt::print("  {:<48} {}{}\n", name["keyword"].get<std::string>(), place,
                 instead.empty() ? "" : ": " + instead);
    }
  }
}

void print_shaders(const json& r) {
  print_counts("shaders, calls of each", r["shaders"]);
  print_counts("shaders of other programs, approximated by fallback shaders", r["fallbacks"]);
  print_names("missing shaders, shown magenta", r["missing"]["shaders"]);
  print_names("missing shaders, without effect", r["missing"]["shaders_without_effect"]);
}

void print_text(const json& r) {
  if (r.contains("picture")) {
    const json &p = r["picture"], &g = r["geometry"];
    fmt::print("{}: {} frame{}, {} x {} pixels\n", r["scene"].get<std::string>(),
               r["frames"].get<int>(), r["frames"] == 1 ? "" : "s", p["width"].get<int>(),
               p["height"].get<int>());
    fmt::print("  geometry   {} objects, {} instances, {} triangles, {:.1f} MB; {} lights\n",
               g["objects"].get<int>(), g["instances"].get<int>(),
               g["triangles"].get<std::uint64_t>(),
               static_cast<double>(g["bytes"].get<std::uint64_t>()) / 1e6, g["lights"].get<int>());
    fmt::print("  indirect   {}{}\n", p["indirect_light"].get<std::string>(),
               p["caustics"].get<bool>() ? ", caustic photons" : "");
    fmt::print("  sampling   at most {} samples, noise {:.4f}\n", p["max_samples"].get<int>(),
               p["noise_target"].get<double>());
    print_names("outputs", r["outputs"]);
    print_shaders(r);
    if (!r["guessed"].empty()) fmt::print("missing shaders, guessed from their parameters\n");
    for (const auto& [type, guess] : r["guessed"].items())
      fmt::print("  {:<32} {}\n", type, guess.get<std::string>());
    print_names("missing textures", r["missing"]["textures"]);
    print_counts("parameters that are approximated", r["parameters"]["approximated"]);
    print_counts("parameters that are ignored", r["parameters"]["ignored"]);
    const json& without = r["options"]["without_effect"];
    print_names("options that nothing acts on yet", without["not_yet"]);
    print_names("options that are only kept", without["kept"]);
    print_names("options that cannot change the picture", without["harmless"]);
    print_names("unknown options", r["options"]["unknown_strings"]);
  }
  if (r.contains("elements")) {
    print_counts("elements", r["elements"]);
    print_shaders(r);
  }
  print_counts("kept without effect", r["kept_without_effect"]);
}

void write_report(const CheckArguments& a, const sdk::TrustedFolders& trusted, const json& facts,
                  scene::Scene& scene, bool renders) {
  std::string why = "the scene cannot be read";
  const std::string picture = renders ? thumbnail(scene, trusted, why) : std::string();
  write_durably(a.report, check_html(facts, picture, why));
}

int run_check(const CheckArguments& a) {
  Diagnostics diagnostics;
  bool renders = true;
  scene::Scene scene;
  SceneCode code(a.scene, diagnostics);
  json result = inspect(a, code, scene, diagnostics, renders);
  renders = renders && result.contains("picture");
  if (!a.as_json) {
    DiagnosticPrinter(diagnostics, false, true).print_new();
    if (!result.is_null()) print_text(result);
  }
  if (result.is_null()) result = {{"scene", a.scene.path}};
  result["diagnostics"] = json::array();
  for (const Diagnostic& d : diagnostics.all())
    result["diagnostics"].push_back(to_json(d, diagnostics));
  result["renders"] = renders;
  if (a.as_json) print_json(result);
  if (!a.report.empty()) write_report(a, code.trusted_folders(), result, scene, renders);
  if (result.contains("frames") && result["frames"] == 0)
    throw UserError(fmt::format("{}: the scene has no render statement", a.scene.path));
  return renders ? kExitDone : kExitFailed;
}

}  // namespace

Command add_check_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "check", "List what a scene uses, and what is missing, approximated or ignored");
  auto a = std::make_shared<CheckArguments>();
  add_scene_arguments(*app, a->scene);
  app->add_option("--report", a->report,
                  "HTML report: summary, preview, every shader with its "
                  "parameters, missing files, messages")
      ->type_name("FILE.html");
  app->add_flag("--json", a->as_json, "Print one line of JSON");
  return {app, [a] { return run_check(*a); }};
}

}  // namespace oriel::app
