// SPDX-License-Identifier: Apache-2.0
// oriel interactive: requests on standard input, pictures on standard output.
#include <half.h>
#include <poll.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace oriel {
namespace interactive_command_test {

using nlohmann::json;

/// The mean of the pixels of a picture, and its place.
struct Seen {
  std::uint32_t epoch = 0;
  int divider = 0, x = 0, y = 0, w = 0, h = 0;
  float red = 0, green = 0;
};

class InteractiveCommand : public ProgramTest {
 protected:
  void begin(const std::string& scene) {
    write("scene.mi", scene);
    int in[2], out[2];
    ASSERT_EQ(pipe(in), 0);
    ASSERT_EQ(pipe(out), 0);
    child_ = fork();
    if (child_ == 0) {
      dup2(in[0], STDIN_FILENO);
      dup2(out[1], STDOUT_FILENO);
      for (const int end : {in[0], in[1], out[0], out[1]}) close(end);
      execl(ORIEL_PROGRAM, "oriel", "interactive", file("scene.mi").c_str(), nullptr);
      _exit(127);
    }
    close(in[0]), close(out[1]);
    to_ = in[1], from_ = out[0];
  }
  void TearDown() override {
    if (child_ > 0) end();
  }
  /// Closes standard input; returns the exit code.
  int end() {
    close(to_);
    char byte = 0;
    while (::read(from_, &byte, 1) == 1) {
    }
    close(from_);
    int status = 0;
    waitpid(std::exchange(child_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void send(const std::string& line) const {
    const std::string text = line + "\n";
    ASSERT_EQ(::write(to_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  bool read_bytes(void* to, std::size_t size) const {
    auto* at = static_cast<char*>(to);
    while (size > 0) {
      constexpr int kMilliseconds = 30000;  // a message that never comes must not stop the tests
      pollfd waits{from_, POLLIN, 0};
      if (poll(&waits, 1, kMilliseconds) <= 0) return false;
      const ssize_t got = ::read(from_, at, size);
      if (got <= 0) return false;
      at += got, size -= static_cast<std::size_t>(got);
    }
    return true;
  }
  /// Reads messages up to one with that value; pixels are put into `seen`.
  json wait(const char* field, const std::string& value) {
    std::uint32_t size = 0;
    while (read_bytes(&size, sizeof size)) {
      std::string bytes(size, '\0');
      if (!read_bytes(bytes.data(), size)) break;
      if (bytes.starts_with("ORIL")) {
        add_picture(bytes);
        continue;
      }
      json message = json::parse(bytes, nullptr, false);
      EXPECT_TRUE(message.is_object()) << bytes;
      if (message.contains(field) && message[field] == value) return message;
    }
    ADD_FAILURE() << "the program ended before " << field << " = " << value;
    return {};
  }
  void add_picture(const std::string& bytes) {
    ASSERT_GT(bytes.size(), 32u);
    const auto number = [&](std::size_t at) {
      std::uint16_t n = 0;
      std::memcpy(&n, bytes.data() + at, sizeof n);
      return static_cast<int>(n);
    };
    Seen s;
    s.epoch = static_cast<std::uint32_t>(number(8));
    s.divider = number(14), s.x = number(16), s.y = number(18), s.w = number(20), s.h = number(22);
    const std::size_t pixels = (bytes.size() - 32) / 6;
    ASSERT_EQ(pixels, static_cast<std::size_t>(s.w) * static_cast<std::size_t>(s.h));
    for (std::size_t i = 0; i < pixels; ++i) {
      half value[3];
      std::memcpy(static_cast<void*>(value), bytes.data() + 32 + 6 * i, sizeof value);
      s.red += static_cast<float>(value[0]) / static_cast<float>(pixels);
      s.green += static_cast<float>(value[1]) / static_cast<float>(pixels);
    }
    seen.push_back(s);
  }

  std::vector<Seen> seen;

 private:
  pid_t child_ = 0;
  int to_ = -1, from_ = -1;
};

/// A square that fills the view under light from the camera: its colour is its radiance.
constexpr const char* kSquare = R"($include "base.mi"
options "opt" object space "indirect" "path" end options
light "sun" "mib_light_infinite" ( "color" 1 1 1 ) direction 0 0 -1 end light
instance "sun_inst" "sun" end instance
material "wall" "mib_illum_lambert" ( "diffuse" .5 .25 .1 ) end material
object "square" visible on shadow on trace on group
  -9 -9 0 9 -9 0 9 9 0 -9 9 0 v 0 v 1 v 2 v 3 p "wall" 0 1 2 3 end group end object
instance "square_inst" "square" end instance
camera "cam" focal 1 aperture 1 aspect 1.5 resolution 300 200 end camera
instance "cam_inst" "cam" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -3 1 end instance
instgroup "root" "sun_inst" "square_inst" "cam_inst" end instgroup
render "root" "cam_inst" "opt"
)";

TEST_F(InteractiveCommand, EditsChangeThePictureOfTheNextEpoch) {
  begin(kSquare);
  send(R"({"type": "update", "id": 1, "samples": 2})");
  EXPECT_EQ(wait("type", "reply")["epoch"], 1);
  EXPECT_EQ(wait("state", "converged")["epoch"], 1);
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.front().divider, 2) << "the first picture is reduced";
  EXPECT_EQ(seen.back().divider, 1);
  EXPECT_EQ(seen.back().w, 300);
  EXPECT_NEAR(seen.back().red, .5, .001);
  seen.clear();
  send(R"({"type": "update", "id": 2, "edits": ["wall.diffuse=.1 .8 .1", "sun.color=.5 .5 .5"]})");
  EXPECT_EQ(wait("type", "reply")["id"], 2);
  EXPECT_EQ(wait("state", "converged")["epoch"], 2);
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.front().epoch, 2u);
  EXPECT_NEAR(seen.back().red, .05, .001);
  EXPECT_NEAR(seen.back().green, .4, .001);
  EXPECT_EQ(end(), 0);
}

TEST_F(InteractiveCommand, RegionsCameraAndScenesChange) {
  begin(kSquare);
  send(R"({"type": "update", "id": 1, "samples": 1, "region": [30, 20, 90, 60]})");
  wait("state", "converged");
  const Seen part = seen.back();
  EXPECT_EQ((std::vector<int>{part.x, part.y, part.w, part.h}), (std::vector<int>{30, 20, 60, 40}));
  send(R"({"type": "update", "id": 2, "region": null, "edits": ["cam.resolution=90 60"]})");
  wait("state", "converged");
  EXPECT_EQ(seen.back().w, 90);
  std::string other = kSquare;
  other.replace(other.find(".5 .25 .1"), 9, ".2 .25 .1");
  write("scene.mi", other);
  send(R"({"type": "update", "id": 3, "reload": true})");
  wait("state", "converged");
  EXPECT_EQ(seen.back().w, 300) << "edits end with the scene";
  EXPECT_NEAR(seen.back().red, .2, .001);
}

TEST_F(InteractiveCommand, BadRequestsAreAnswered) {
  begin(kSquare);
  send("nonsense");
  wait("type", "error");
  send(R"({"type": "dance", "id": 2})");
  EXPECT_EQ(wait("type", "error")["id"], 2);
  send(R"({"type": "update", "id": 3, "edits": ["wal.diffuse=1 1 1"]})");
  const std::string message = wait("type", "error")["message"];
  EXPECT_NE(message.find("did you mean \"wall\""), std::string::npos) << message;
  send(R"({"type": "update", "id": 4, "region": [9, 9, 9, 9]})");
  EXPECT_EQ(wait("type", "error")["id"], 4);
  send(R"({"type": "update", "id": 5, "samples": 1, "edits": []})");
  wait("state", "converged");
  EXPECT_NEAR(seen.back().red, .5, .001);
}

TEST_F(InteractiveCommand, DenoisedPicturesFollowTheFinalOne) {
  begin(kSquare);
  send(R"({"type": "update", "id": 1, "samples": 4, "denoise": true})");
  wait("state", "converged");
  ASSERT_FALSE(seen.empty());
  EXPECT_NEAR(seen.back().red, .5, .001);
}

TEST_F(InteractiveCommand, UnreadableScenesFail) {
  begin("this is no scene");
  send(R"({"type": "update", "id": 1})");
  EXPECT_EQ(wait("type", "error")["id"], 1);
  EXPECT_EQ(end(), 0);
}

}  // namespace interactive_command_test
}  // namespace oriel
