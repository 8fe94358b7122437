// SPDX-License-Identifier: Apache-2.0
// Test support: a client that waits for finished pictures and reads them.
#pragma once

#include <half.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "image/files.h"
#include "studio_client.h"

namespace oriel::studio {

class StudioSessionTest : public StudioTest {
 protected:
  /// Waits until the picture of the newest epoch is finished.
  static json converged(TestSocket& socket, std::uint32_t epoch) {
    return socket.wait([&](const json& m) {
      return m["type"] == "progress" && m["status"] == "converged" && m["epoch"] >= epoch;
    });
  }
  /// Beauty of the finished picture of that client, as an EXR file of the server.
  std::vector<float> delivered(TestSocket& socket) {
    const json reply = socket.ask({{"type", "deliver"}, {"kind", "exr"}});
    EXPECT_EQ(reply["type"], "reply") << reply;
    return pixels_of(fetch(reply["url"]));
  }
  std::string fetch(const std::string& url) const {
    const std::string answer =
        raw("GET " + url + " HTTP/1.1\r\n" + host() + "X-Oriel-Token: " + token + "\r\n\r\n");
    EXPECT_EQ(std::atoi(answer.c_str() + 9), 200);
    return answer.substr(answer.find("\r\n\r\n") + 4);
  }
  std::vector<float> pixels_of(const std::string& exr) {
    std::ofstream(file("fetched.exr"), std::ios::binary) << exr;
    return read_image(file("fetched.exr")).pixels;
  }
  /// The picture of `oriel render` with edits.
  std::vector<float> rendered(const std::string& scene, const std::vector<std::string>& edits) {
    std::vector<std::string> words = {"render", scene, "-o", "rendered.exr", "--samples", "8"};
    for (const std::string& edit : edits) words.insert(words.end(), {"--set", edit});
    EXPECT_EQ(run(words).exit_code, 0);
    return read_image(file("rendered.exr")).pixels;
  }
  pid_t renderer() const {
    std::ifstream children("/proc/" + std::to_string(process_) + "/task/" +
                           std::to_string(process_) + "/children");
    pid_t child = 0;
    children >> child;
    return child;
  }
};

/// The halves of one layer in the last frame of a client.
inline std::vector<float> layer_of_last_frame(const TestSocket& socket, int layer) {
  const std::uint32_t frame = TestSocket::word(socket.strips.back(), 28);
  std::vector<float> values;
  for (const std::string& s : socket.strips) {
    if (TestSocket::word(s, 28) != frame || static_cast<unsigned char>(s[12]) != layer) continue;
    for (std::size_t i = 32; i + 1 < s.size(); i += 2) {
      half value;
      value.setBits(static_cast<std::uint16_t>(static_cast<unsigned char>(s[i]) |
                                               static_cast<unsigned char>(s[i + 1]) << 8));
      values.push_back(value);
    }
  }
  return values;
}

}  // namespace oriel::studio
