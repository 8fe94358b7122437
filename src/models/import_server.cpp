// SPDX-License-Identifier: Apache-2.0
// The process that imports a model without access to files.
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>

#include <array>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <span>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/confined_process.h"
#include "base/packet.h"
#include "mi/writer.h"
#include "models/import_apart.h"
#include "models/import_packets.h"
#include "models/read_model.h"

namespace oriel::models {
namespace {

using packets::Message;
using packets::whole;
using packets::words;

/// Writes to memory; fails at its end.
class MemoryBuffer : public std::streambuf {
 public:
  explicit MemoryBuffer(std::span<std::byte> memory) : memory_(memory) {}
  std::size_t size() const { return size_; }

 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    const auto wanted = static_cast<std::size_t>(count);
    if (wanted > memory_.size() - size_) return 0;
    std::memcpy(memory_.data() + size_, text, wanted);
    size_ += wanted;
    return count;
  }
  int_type overflow(int_type c) override {
    const char text = traits_type::to_char_type(c);
    return xsputn(&text, 1) == 1 ? c : traits_type::eof();
  }

 private:
  std::span<std::byte> memory_;
  std::size_t size_ = 0;
};

/// The other process.
class Parent {
 public:
  explicit Parent(const ConfinedSide& side) : side_(side) {}

  Message receive(Descriptor* descriptor = nullptr) {
    std::vector<std::uint8_t> bytes(packets::kMaxBytes);
    const auto size = receive_packet(side_.socket, bytes.data(), bytes.size(), descriptor);
    if (!size) throw std::runtime_error("the program has ended");
    return packets::unpacked(bytes.data(), *size);
  }
  void send(const Message& message) {
    const std::vector<std::uint8_t> bytes = packets::packed(message);
    if (bytes.size() > packets::kMaxBytes || !send_packet(side_.socket, bytes.data(), bytes.size()))
      throw std::runtime_error("it has names that are too long");
  }

  OpenFile open(const std::string& path, FileUse use) {
    send({{"what", "open"}, {"path", path}, {"use", use == FileUse::Asset ? 0u : 1u}});
    Descriptor descriptor;
    const Message answer = receive(&descriptor);
    if (descriptor) return OpenFile::received(std::move(descriptor), words(answer, "path"));
    return OpenFile::failed(static_cast<OpenFile::Fault>(whole(answer, "fault")),
                            words(answer, "reason"), words(answer, "hint"));
  }

  void write_texture(const std::string& name, std::string_view content) {
    if (content.size() > side_.memory.size()) throw std::runtime_error("it is too large");
    std::memcpy(side_.memory.data(), content.data(), content.size());
    send({{"what", "texture"}, {"name", name}, {"size", content.size()}});
    const std::string error = words(receive(), "error");
    if (!error.empty()) throw std::runtime_error(error);
  }

  std::optional<Vec3> mean_color(const std::string& path) {
    send({{"what", "color"}, {"path", path}});
    const Message answer = receive();
    if (!answer.contains("color")) return std::nullopt;
    const auto color = answer["color"].get<std::array<float, 3>>();
    return Vec3(color[0], color[1], color[2]);
  }

  void finish(const std::optional<scene::Scene>& scene, const Diagnostics& diagnostics) {
    Message list = Message::array();
    for (const Diagnostic& d : diagnostics.all())
      list.push_back({{"severity", static_cast<unsigned>(d.severity)},
                      {"code", d.code},
                      {"message", d.message},
                      {"hint", d.hint}});
    const std::vector<std::uint8_t> bytes = packets::packed(list);
    MemoryBuffer buffer(side_.memory);
    std::ostream stream(&buffer);
    if (scene) mi::write_scene(*scene, stream);
    const std::size_t size = buffer.size();
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    if (!stream.good())
      throw std::runtime_error(
          fmt::format("its scene has more than {} MB", side_.memory.size() >> 20));
    send({{"what", "done"}, {"scene", size}, {"diagnostics", bytes.size()}});
  }

 private:
  const ConfinedSide side_;
};

template <class T>
std::optional<T> optional_of(const Message& message, const char* name) {
  return message.contains(name) ? std::optional(message[name].get<T>()) : std::nullopt;
}

ImportOptions options_of(const Message& start, Parent& parent) {
  ImportOptions options;
  options.texture_folder = words(start, "texture_folder");
  options.scene_folder = words(start, "scene_folder");
  if (const std::string up = words(start, "up"); !up.empty()) options.up = up[0];
  options.aspect = optional_of<float>(start, "aspect");
  options.seconds = optional_of<float>(start, "seconds");
  options.emission_scale = optional_of<float>(start, "emission_scale");
  options.files = FileAccess::by(
      [&parent](const std::string& path, FileUse use) { return parent.open(path, use); });
  options.texture_writer = [&parent](const std::string& name, std::string_view content) {
    parent.write_texture(name, content);
  };
  options.color_reader = [&parent](const std::string& path) { return parent.mean_color(path); };
  return options;
}

void import(Parent& parent, const SandboxLimits& limits) {
  Descriptor model;
  const Message start = parent.receive(&model);
  const std::string path = words(start, "path");
  grant_file(path.c_str(), model.get());
  try {
    enter_sandbox(limits);
  } catch (const std::runtime_error&) {
    if (start.value("untrusted", true)) throw;
  }
  Diagnostics diagnostics;
  const auto scene = import_model(path, options_of(start, parent), diagnostics);
  parent.finish(scene, diagnostics);
}

}  // namespace

int serve_model(const SandboxLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int number : {SIGINT, SIGHUP, SIGTERM, SIGPIPE}) signal(number, SIG_IGN);
  try {
    Parent parent(confined_side());
    std::string error;
    try {
      import(parent, limits);
      return 0;
    } catch (const std::bad_alloc&) {
      error = kTooMuchMemory;
    } catch (const std::exception& e) {
      error = e.what();
    }
    parent.send({{"what", "failed"}, {"error", error}});
    return 0;
  } catch (const std::exception&) {
    return 1;
  }
}

}  // namespace oriel::models
