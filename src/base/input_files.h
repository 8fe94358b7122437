// SPDX-License-Identifier: Apache-2.0
// The files that the scene of this process was read from.
#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace oriel {

/// Which files, by when they are read.
enum class InputKind : std::uint8_t {
  Scene,  ///< text of the scene
  Frame,  ///< bound for one frame: textures, photometric profiles, shader libraries, user data
};

/// Notes that a file decides the picture. Thread-safe.
void note_input_file(const std::string& path, InputKind kind);

/// The files noted so far. Thread-safe.
std::set<std::string> input_files(InputKind kind);

/// Forgets those of the frame before.
void forget_frame_inputs();

/// A checksum of the content of a file, or of its size and modification time if it is larger than
/// `most` bytes; 0 if it cannot be read.
/// Checked: InputFiles.*
std::uint64_t file_checksum(const std::string& path, std::uint64_t most);

}  // namespace oriel
