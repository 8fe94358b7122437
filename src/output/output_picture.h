// SPDX-License-Identifier: Apache-2.0
// The finished picture in the hands of output shaders that work on all of it at once.
#pragma once

#include <map>
#include <optional>

#include "image/pixel_buffer.h"
#include "render/session.h"

namespace oriel {

/// Buffers by the numbers of the C interface: 0 the picture, RGBA as it is shown; 1 depth, one
/// channel, 0 where there is nothing; 2 world normals, three; 12 + N and N the user's buffer of
/// number N, with one, three or four channels (N alone where nothing else has that number). The
/// picture and users' buffers may be changed; only files that show them tell.
class OutputPicture {
 public:
  OutputPicture(const RenderSession& session, Image& shown) : session_(session), shown_(shown) {}

  const World& world() const { return session_.world(); }
  /// Null when the picture has no such buffer.
  Image* buffer(int number);
  bool is_writable(int number) const { return number == 0 || slot_of(number); }
  /// By its place in World::user_buffers.
  Image& user_buffer(std::size_t slot);

 private:
  std::optional<std::size_t> slot_of(int number) const;
  Image* geometry(int number);

  const RenderSession& session_;
  Image& shown_;
  std::map<int, Image> others_;
  std::map<std::size_t, Image> user_buffers_;
};

/// What the film has of a user's buffer, over the whole picture.
Image film_user_buffer(const RenderSession& session, std::size_t slot);

/// Runs an output shader that works on whole pictures (ShaderSpec::output).
void run_output_shader(const ShaderNode& node, OutputPicture& picture);

}  // namespace oriel
