// SPDX-License-Identifier: Apache-2.0
// Messages between import_model_apart() and its process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace oriel::models::packets {

// Conventions
//   A message is an object in MessagePack, because names need not be UTF-8. "what" is its kind:
//     start    to the process, with the descriptor of the model: path and options
//     open     path, use; answered with fault, path, reason, hint, and a descriptor
//     texture  name, size of the content in the shared memory; answered with error
//     color    path; answered with color, or nothing
//     done     size of the scene in the shared memory, and of the diagnostics that follow it
//     failed   error

using Message = nlohmann::json;

inline constexpr std::size_t kMaxBytes = std::size_t{64} << 10;

std::vector<std::uint8_t> packed(const Message& message);
/// Discarded if the bytes are not a message.
Message unpacked(const std::uint8_t* bytes, std::size_t size);

/// A member; empty or 0 if it is missing or has another type.
std::string words(const Message& message, const char* name);
std::uint64_t whole(const Message& message, const char* name);

}  // namespace oriel::models::packets
