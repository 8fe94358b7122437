// SPDX-License-Identifier: Apache-2.0
// A confined process that a file has taken over. The request says what it does.
#include <dirent.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/confined_process.h"
#include "base/packet.h"
#include "image/reader_protocol.h"
#include "models/import_packets.h"

namespace oriel {
namespace {

namespace packets = models::packets;
using packets::Message;

void send_text(int socket, std::string_view text) { send_packet(socket, text.data(), text.size()); }
void send(int socket, const Message& message) {
  const auto bytes = packets::packed(message);
  send_packet(socket, bytes.data(), bytes.size());
}

std::string open_descriptors() {
  std::string numbers;
  DIR* const folder = opendir("/proc/self/fd");
  while (const dirent* entry = readdir(folder))
    if (entry->d_name[0] != '.' && std::atoi(entry->d_name) != dirfd(folder))
      numbers += std::string(entry->d_name) + " ";
  closedir(folder);
  return numbers;
}

std::string environment() {
  std::string all;
  for (char** variable = environ; *variable; ++variable) all += std::string(*variable) + "\n";
  return all;
}

/// Until there is no more.
std::size_t eat_memory() {
  constexpr std::size_t kPart = std::size_t{1} << 20;
  std::size_t parts = 0;
  while (true) {
    char* const part = static_cast<char*>(std::malloc(kPart));
    if (!part) return parts;
    std::memset(part, 1, kPart);
    ++parts;
  }
}

/// What a scene of a model must not contain.
constexpr std::string_view kForbidden =
    "link \"/tmp/evil.so\"\necho \"hello\"\n$include <base.mi>\n$include \"secret.mi\"\n"
    "declare shader \"evil\" ( string \"s\" ) end declare\n"
    "options \"model_options\"\n  samples 0 2\n  photonmap file \"/tmp/evil.pm\"\n"
    "  finalgather file \"/tmp/evil.fgm\"\nend options\n"
    "camera \"c\"\n  output \"rgba\" \"exr\" \"/tmp/evil.exr\"\n  focal 1\n  aperture 1\n"
    "end camera\n"
    "instance \"ci\" \"c\" end instance\n"
    "writable color texture \"t\" \"look.png\"\n"
    "data \"d\" \"/etc/passwd\"\n"
    "instgroup \"model_root\" \"ci\" end instgroup\n"
    "render \"model_root\" \"ci\" \"model_options\"\n";

/// Returns false if the text names no behaviour of models.
bool act_as_model_reader(const ConfinedSide& side, const std::string& request) {
  const auto says = [&](const char* word) { return request.find(word) != request.npos; };
  const auto receive = [&] {
    std::vector<std::uint8_t> bytes(packets::kMaxBytes);
    const auto size = receive_packet(side.socket, bytes.data(), bytes.size());
    return size ? packets::unpacked(bytes.data(), *size) : Message();
  };
  if (says("sizes"))
    send(side.socket, {{"what", "done"}, {"scene", ~std::uint64_t{0}}, {"diagnostics", 9u}});
  else if (says("kinds"))
    send(side.socket, {{"what", "done"}, {"scene", "all"}, {"diagnostics", {1, 2}}});
  else if (says("unknown"))
    send(side.socket, {{"what", "delete everything"}});
  else if (says("escape"))
    send(side.socket, {{"what", "texture"}, {"name", "../texture_0.png"}, {"size", 4u}});
  else if (says("program"))
    send(side.socket, {{"what", "texture"}, {"name", "texture_0.sh"}, {"size", 4u}});
  else if (says("floods"))
    send(side.socket,
         {{"what", "texture"}, {"name", "texture_0.png"}, {"size", std::uint64_t{1} << 50}});
  else if (says("peeks"))
    send(side.socket, {{"what", "open"}, {"path", "/etc/passwd"}, {"use", 1u}});
  else if (says("scripts")) {
    std::memcpy(side.memory.data(), kForbidden.data(), kForbidden.size());
    send(side.socket, {{"what", "done"}, {"scene", kForbidden.size()}, {"diagnostics", 0u}});
  } else {
    return false;
  }
  // What the program says to a texture or a file.
  const Message answer = receive();
  if (answer.is_object())
    send(side.socket, {{"what", "failed"},
                       {"error", "answer: " + packets::words(answer, "error") +
                                     packets::words(answer, "reason")}});
  return true;
}

void act_as_image_reader(const ConfinedSide& side, const reader::Request& first) {
  reader::Request request = first;
  do {
    request.path[reader::kMaxPath - 1] = 0;
    const std::string path = request.path;
    const auto says = [&](const char* word) { return path.find(word) != path.npos; };
    reader::Reply reply;
    reply.good = 1;
    if (says("crash")) std::abort();
    if (says("hang")) pause();
    if (says("error")) {
      reply.good = 0;
      std::memset(reply.error, 27, sizeof reply.error);  // no end, and for terminals
    }
    if (says("short")) {
      send_packet(side.socket, &reply, 5);
      continue;
    }
    reply.level.width = says("width") ? 1 << 30 : 4;
    reply.level.height = says("height") ? -4 : 4;
    reply.level.channels = says("channels") ? 1 << 20 : 3;
    send_packet(side.socket, &reply, sizeof reply);
  } while (receive_packet(side.socket, &request, sizeof request) == sizeof request);
}

int run(char** arguments) {
  const ConfinedSide side = confined_side();
  std::vector<std::byte> bytes(packets::kMaxBytes);
  const auto size = receive_packet(side.socket, bytes.data(), bytes.size());
  if (!size) return 1;
  if (*size == sizeof(reader::Request)) {
    reader::Request request;
    std::memcpy(&request, bytes.data(), sizeof request);
    act_as_image_reader(side, request);
    return 0;
  }
  const std::string request(reinterpret_cast<const char*>(bytes.data()), *size);
  const auto says = [&](const char* word) { return request.find(word) != request.npos; };
  if (says("crash")) std::abort();
  if (says("leave")) return 0;
  if (says("hang")) pause();
  if (says("spin")) {
    enter_sandbox(confined_limits(arguments));
    for (;;) getpid();
  }
  if (says("eat")) {
    enter_sandbox(confined_limits(arguments));
    send_text(side.socket, std::to_string(eat_memory()));
  }
  if (says("large")) send_text(side.socket, std::string(4 * packets::kMaxBytes / 3, 'x'));
  if (says("rubbish")) send_text(side.socket, std::string_view("\xc1\xff rubbish"));
  if (says("echo")) send_text(side.socket, request);
  if (says("descriptors")) send_text(side.socket, open_descriptors());
  if (says("environment")) send_text(side.socket, environment());
  if (act_as_model_reader(side, request)) return 0;
  pause();
  return 0;
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) { return argc == 4 ? oriel::run(argv + 2) : 2; }
