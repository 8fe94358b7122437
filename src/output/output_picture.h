// SPDX-License-Identifier: Apache-2.0
// The finished picture for output shaders that process whole pictures.
#pragma once

#include <map>
#include <optional>

#include "image/pixel_buffer.h"
#include "render/session.h"

namespace oriel {

/// Buffers are numbered as in the C interface: 0 is the picture, RGBA as displayed; 1 is depth, one
/// channel, 0 = no hit; 2 is world normals, three channels; 12 + N is the user buffer of number N
/// with one, three or four channels (also N if no other buffer has that number). The picture and
/// user buffers may be modified; the change affects only files that show them.
class OutputPicture {
 public:
  OutputPicture(const RenderSession& session, Image& shown) : session_(session), shown_(shown) {}

  const World& world() const { return session_.world(); }
  /// Null if the picture has no such buffer.
  Image* buffer(int number);
  bool is_writable(int number) const { return number == 0 || slot_of(number); }
  /// By index in World::user_buffers.
  Image& user_buffer(std::size_t slot);

 private:
  std::optional<std::size_t> slot_of(int number) const;
  Image* geometry(int number);

  const RenderSession& session_;
  Image& shown_;
  std::map<int, Image> others_;
  std::map<std::size_t, Image> user_buffers_;
};

/// Values of a user buffer in the film, as an image of the full frame.
Image film_user_buffer(const RenderSession& session, std::size_t slot);

/// Runs an output shader that processes whole pictures (ShaderSpec::output).
void run_output_shader(const ShaderNode& node, OutputPicture& picture);

}  // namespace oriel
