// SPDX-License-Identifier: Apache-2.0
#include "models/import_packets.h"

#include <nlohmann/json.hpp>

namespace oriel::models::packets {

std::vector<std::uint8_t> packed(const Message& message) { return Message::to_msgpack(message); }

Message unpacked(const std::uint8_t* bytes, std::size_t size) {
  Message message = Message::from_msgpack(bytes, bytes + size, true, false);
  return message.is_object() ? message : Message(Message::value_t::discarded);
}

std::string words(const Message& message, const char* name) {
  const auto found = message.find(name);
  return found != message.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::uint64_t whole(const Message& message, const char* name) {
  const auto found = message.find(name);
  return found != message.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

}  // namespace oriel::models::packets
