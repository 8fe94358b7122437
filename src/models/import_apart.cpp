// SPDX-License-Identifier: Apache-2.0
#include "models/import_apart.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/confined_process.h"
#include "mi/reader.h"
#include "models/import_packets.h"
#include "models/import_texture.h"

namespace oriel::models {
namespace {

using packets::Message;
using packets::whole;
using packets::words;

/// The stems of the packages that imported scenes use.
constexpr std::array kPackages = {"base", "physics", "architectural", "oriel"};
constexpr std::array kOptionStatements = {"samples", "trace depth", "gamma", "indirect", "shadow"};

template <class List>
bool contains(const List& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

std::size_t machine_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(size)
                               : std::size_t{8} << 30;
}

ConfinedOptions process_options(const ImportProcess& process) {
  ConfinedOptions options;
  options.program = process.program;
  options.argument = kModelReaderArgument;
  const std::size_t memory = process.memory_mb > 0 ? process.memory_mb << 20 : machine_memory();
  options.memory_mb = memory >> 20;
  options.processor_seconds = static_cast<std::size_t>(std::ceil(process.seconds));
  options.shared_bytes = memory / 2;  // pages exist once they are written
  return options;
}

// The elements of a scene that a model may define, without what import_model() never sets.
void keep_imported(scene::Options& options) {
  std::erase_if(options.statements,
                [](const auto& s) { return !contains(kOptionStatements, s.keyword); });
  options.state = {};
  options.uninterpreted.clear();
}
void keep_imported(scene::Camera& camera) {
  camera.outputs.clear();
  camera.frame_buffers.clear();
  camera.uninterpreted.clear();
}
void keep_imported(scene::Texture& texture) {
  texture.local = texture.writable = false;
  texture.procedure = {};
}
void keep_imported(scene::Object& object) { object.uninterpreted.clear(); }
void keep_imported(scene::Instance& instance) { instance.uninterpreted.clear(); }
template <class Element>
void keep_imported(Element&) {}

template <class Element>
constexpr bool is_imported =
    !std::is_same_v<Element, scene::LightProfile> && !std::is_same_v<Element, scene::Assembly> &&
    !std::is_same_v<Element, scene::UserData> &&
    !std::is_same_v<Element, scene::UninterpretedElement>;

/// A file may have taken the process over.
void keep_imported(scene::Scene& scene, const std::string& folder) {
  scene.commands.clear();
  scene.declarations.clear();
  scene.phenomena.clear();
  scene.data_declarations.clear();
  std::erase_if(scene.packages, [](const std::string& package) {
    return !contains(kPackages, std::filesystem::path(package).stem().string());
  });
  std::vector<std::string> others;
  for (scene::Element& element : scene.elements())
    std::visit(
        [&]<class E>(E& e) {
          if constexpr (!is_imported<E>)
            others.push_back(e.name);
          else
            keep_imported(e);
          if constexpr (std::is_same_v<E, scene::Texture>) e.directory = folder;
        },
        element);
  for (const std::string& name : others) scene.remove(name);
}

scene::Scene scene_of(std::string_view text, const std::string& path, const std::string& folder,
                      Diagnostics& diagnostics) {
  mi::ReadOptions options;
  options.packages.assign(kPackages.begin(), kPackages.end());
  options.knows_shader = [](std::string_view) { return true; };
  options.limits.include_depth = 0;
  options.budgets.set(Budget::Text, std::numeric_limits<std::uint64_t>::max());
  options.budgets.set(Budget::Expansion, std::numeric_limits<std::uint64_t>::max());
  scene::Scene scene = mi::read_text(text, options, diagnostics, path);
  keep_imported(scene, folder);
  scene.budgets = {};
  return scene;
}

void report(const Message& list, Diagnostics& diagnostics) {
  constexpr std::size_t kMost = 2000;
  if (!list.is_array()) return;
  for (std::size_t i = 0; i < std::min(list.size(), kMost); ++i) {
    const Message& one = list[i];
    if (!one.is_object() || !words(one, "code").starts_with("OR-MD-")) continue;
    const auto severity = static_cast<Severity>(
        std::min<std::uint64_t>(whole(one, "severity"), static_cast<int>(Severity::Error)));
    diagnostics.report(severity, words(one, "code").substr(0, 9), {}, words(one, "message"),
                       words(one, "hint"));
  }
}

/// Answers what the process asks for, until it has the scene.
class Import {
 public:
  Import(const std::string& path, const ImportOptions& options, const ImportProcess& process,
         Diagnostics& diagnostics)
      : path_(path),
        options_(options),
        diagnostics_(diagnostics),
        seconds_(process.seconds),
        process_(process_options(process)) {
    options_.files.permit(std::filesystem::path(path).parent_path().string());
    if (!options.texture_folder.empty()) options_.files.permit(options.texture_folder);
  }

  /// Errors:  ProcessEnded, std::runtime_error.
  std::optional<scene::Scene> run(const OpenFile& model) {
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(seconds_));
    send(start(), model.descriptor());
    std::vector<std::uint8_t> bytes(packets::kMaxBytes);
    while (true) {
      const Message message = packets::unpacked(bytes.data(), receive(bytes, end));
      if (message.is_discarded()) invalid();
      const std::string what = words(message, "what");
      if (what == "done") return finished(message);
      if (what == "failed") throw std::runtime_error(words(message, "error"));
      if (what == "open")
        open(message);
      else if (what == "texture")
        write(message);
      else if (what == "color")
        read_color(message);
      else
        invalid();
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[noreturn]] static void invalid() { throw ProcessEnded("gave an invalid answer"); }

  std::size_t receive(std::vector<std::uint8_t>& bytes, Clock::time_point end) try {
    const std::chrono::duration<double> left = end - Clock::now();
    return process_.receive(bytes.data(), bytes.size(), left.count());
  } catch (const ProcessEnded&) {
    if (Clock::now() < end) throw;
    throw ProcessEnded(fmt::format("took more than {} s", seconds_));
  }

  Message start() const {
    Message message = {{"what", "start"},
                       {"path", path_},
                       {"texture_folder", options_.texture_folder},
                       {"scene_folder", options_.scene_folder},
                       {"untrusted", options_.files.is_untrusted()}};
    if (options_.up) message["up"] = std::string(1, *options_.up);
    if (options_.aspect) message["aspect"] = *options_.aspect;
    if (options_.seconds) message["seconds"] = *options_.seconds;
    if (options_.emission_scale) message["emission_scale"] = *options_.emission_scale;
    return message;
  }

  void send(const Message& message, int descriptor = -1) {
    const std::vector<std::uint8_t> bytes = packets::packed(message);
    if (!process_.send(bytes.data(), bytes.size(), descriptor)) throw ProcessEnded("crashed");
  }

  void open(const Message& message) {
    const FileUse use = whole(message, "use") == 0 ? FileUse::Asset : FileUse::Scene;
    const OpenFile file = options_.files.open(words(message, "path"), use);
    send({{"fault", static_cast<unsigned>(file.fault())},
          {"path", file.path()},
          {"reason", file.reason()},
          {"hint", file.hint()}},
         file ? file.descriptor() : -1);
  }

  void write(const Message& message) {
    const std::string name = words(message, "name");
    const std::uint64_t size = whole(message, "size");
    if (!is_texture_name(name) || size > process_.memory().size() - written_) invalid();
    written_ += size;
    Message answer = {{"error", ""}};
    try {
      write_texture(options_.texture_folder, name, text(0, size));
    } catch (const std::runtime_error& e) {
      answer["error"] = e.what();
    }
    send(answer);
  }

  /// As import_texture.cpp makes them.
  static bool is_texture_name(const std::string& name) {
    constexpr std::string_view kStart = "texture_", kDigits = "0123456789";
    const std::size_t dot = name.find('.');
    return name.starts_with(kStart) && dot != name.npos && dot > kStart.size() &&
           name.find_first_not_of(kDigits, kStart.size()) == dot &&
           is_texture_suffix(std::string_view(name).substr(dot + 1));
  }

  void read_color(const Message& message) {
    Message answer = Message::object();
    if (const auto color = mean_color(options_.files.open(words(message, "path"), FileUse::Asset)))
      answer["color"] = {color->x, color->y, color->z};
    send(answer);
  }

  std::optional<scene::Scene> finished(const Message& message) {
    process_.end();  // so that the memory does not change any more
    const std::uint64_t all = process_.memory().size();
    const std::uint64_t size = whole(message, "scene"), rest = whole(message, "diagnostics");
    if (size > all || rest > all - size) invalid();
    const std::string_view list = text(size, rest);
    report(Message::from_msgpack(list.begin(), list.end(), true, false), diagnostics_);
    if (size == 0) return std::nullopt;
    return scene_of(text(0, size), path_, options_.scene_folder, diagnostics_);
  }

  std::string_view text(std::size_t start, std::size_t size) const {
    return {reinterpret_cast<const char*>(process_.memory().data()) + start, size};
  }

  const std::string path_;
  ImportOptions options_;
  Diagnostics& diagnostics_;
  const double seconds_;
  ConfinedProcess process_;
  std::uint64_t written_ = 0;  ///< bytes of textures
};

}  // namespace

std::optional<scene::Scene> import_model_apart(const std::string& path,
                                               const ImportOptions& options,
                                               const ImportProcess& process,
                                               Diagnostics& diagnostics) {
  const auto unreadable = [&](const std::string& why, std::string hint = {}) {
    diagnostics.error("OR-MD-001", {}, fmt::format("cannot read model '{}': {}", path, why),
                      std::move(hint));
    return std::nullopt;
  };
  const OpenFile model = open_regular(path);
  if (!model) return unreadable(model.reason());
  try {
    return Import(path, options, process, diagnostics).run(model);
  } catch (const ProcessEnded& e) {
    return unreadable(fmt::format("the process that reads it {}", e.what()),
                      "the file is probably damaged");
  } catch (const std::runtime_error& e) {
    return unreadable(e.what());
  }
}

}  // namespace oriel::models
