// SPDX-License-Identifier: Apache-2.0
// The C interface for embedding: pictures are those of `oriel render`, errors are return codes.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "image/files.h"
#include "oriel/oriel.h"
#include "support/files.h"
#include "support/program.h"

namespace oriel {
namespace {

constexpr const char* kScene = R"(options "opt" samples 0 1 trace depth 3 3 4 "indirect" "path"
end options
light "lamp" "mib_light_point" ("color" 40 38 35, "shadow" on) origin 0 0 3 end light
instance "lamp_inst" "lamp" end instance
material "grey" "mia_material_x" ("diffuse" .5 .4 .3, "reflectivity" .2) end material
object "floor" visible shadow trace group
  -4 -4 0  4 -4 0  4 4 0  -4 4 0  v 0 v 1 v 2 v 3  p "grey" 0 1 2 3
end group end object
instance "floor_inst" "floor" end instance
camera "cam" output "rgba" "exr" "out.exr" focal 35 aperture 36 aspect 1.5 resolution 48 32
end camera
instance "cam_inst" "cam"
  transform 1 0 0 0  0 .4472136 -.8944272 0  0 .8944272 .4472136 0  0 -1.3416408 -4.9193496 1
end instance
instgroup "root" "lamp_inst" "floor_inst" "cam_inst" end instgroup
render "root" "cam_inst" "opt"
)";

class Embed : public ProgramTest {
 protected:
  void SetUp() override { write("scene.mi", kScene); }
  void TearDown() override { oriel_session_close(session_); }

  void open() {
    ASSERT_EQ(oriel_session_open(file("scene.mi").c_str(), nullptr, &session_), ORIEL_OK)
        << oriel_last_error();
  }
  std::uint32_t view(std::uint32_t samples) {
    OrielView view;
    oriel_init_view(&view);
    view.samples = samples;
    std::uint32_t epoch = 0;
    EXPECT_EQ(oriel_session_set_view(session_, &view, &epoch), ORIEL_OK) << oriel_last_error();
    return epoch;
  }
  std::vector<float> saved() {
    const std::string path = file("saved.exr");
    EXPECT_EQ(oriel_session_save_picture(session_, path.c_str()), ORIEL_OK) << oriel_last_error();
    return read_image(path).pixels;
  }
  std::vector<float> rendered(const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", "scene.mi", "-o", "rendered.exr", "--samples", "8"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).exit_code, 0);
    return read_image(file("rendered.exr")).pixels;
  }

  OrielSession* session_ = nullptr;
};

TEST_F(Embed, FinishedPicturesAreThoseOfTheProgram) {
  open();
  std::uint32_t epoch = view(8);
  ASSERT_EQ(oriel_session_start(session_), ORIEL_OK);
  ASSERT_EQ(oriel_session_wait(session_, epoch, UINT32_MAX, 60), ORIEL_OK) << oriel_last_error();
  EXPECT_EQ(saved(), rendered({}));
  ASSERT_EQ(oriel_session_edit(session_, "grey.diffuse=.1 .6 .2", &epoch), ORIEL_OK);
  ASSERT_EQ(oriel_session_wait(session_, epoch, UINT32_MAX, 60), ORIEL_OK) << oriel_last_error();
  EXPECT_EQ(saved(), rendered({"--set", "grey.diffuse=.1 .6 .2"}));
  OrielStatus status = {};
  status.size = sizeof status;
  ASSERT_EQ(oriel_session_status(session_, &status), ORIEL_OK);
  EXPECT_EQ(status.state, ORIEL_STATE_CONVERGED);
  EXPECT_EQ(status.samples, 8);
  EXPECT_GE(status.epoch, epoch);
}

TEST_F(Embed, PixelsOfAPictureAreThoseOfItsFile) {
  open();
  const std::uint32_t epoch = view(8);
  oriel_session_start(session_);
  ASSERT_EQ(oriel_session_wait(session_, epoch, UINT32_MAX, 60), ORIEL_OK) << oriel_last_error();
  OrielPicture* picture = nullptr;
  ASSERT_EQ(oriel_picture_acquire(session_, &picture), ORIEL_OK);
  OrielPictureInfo info = {};
  info.size = sizeof info;
  ASSERT_EQ(oriel_picture_info(picture, &info), ORIEL_OK);
  EXPECT_EQ(info.width, 48);
  EXPECT_EQ(info.h, 32);
  EXPECT_EQ(info.divider, 1);
  EXPECT_EQ(info.samples, 8u);
  std::vector<float> pixels(48 * 32 * 3);
  EXPECT_EQ(oriel_picture_read(picture, 0, pixels.data(), pixels.size() - 1), ORIEL_BAD_ARGUMENT);
  ASSERT_EQ(oriel_picture_read(picture, 0, pixels.data(), pixels.size()), ORIEL_OK);
  EXPECT_EQ(oriel_picture_read(picture, 1, pixels.data(), pixels.size()), ORIEL_NOT_FOUND);
  const std::vector<float> in_file = saved();
  const std::size_t channels = in_file.size() / (48 * 32);
  for (std::size_t i = 0; i < 48 * 32; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(pixels[3 * i + c], in_file[channels * i + c],
                  1e-3 * in_file[channels * i + c] + 1e-6)
          << i;
  // Pictures outlive their session.
  oriel_session_close(std::exchange(session_, nullptr));
  OrielLayer layer = {};
  layer.size = sizeof layer;
  ASSERT_EQ(oriel_picture_layer(picture, 0, &layer), ORIEL_OK);
  EXPECT_STREQ(layer.name, "beauty");
  EXPECT_EQ(layer.bytes, 48u * 32 * 6);
  oriel_picture_release(picture);
}

TEST_F(Embed, ErrorsAreReturnCodesWithAText) {
  EXPECT_EQ(oriel_session_open(file("none.mi").c_str(), nullptr, &session_), ORIEL_NOT_FOUND);
  EXPECT_NE(std::string(oriel_last_error()).find("none.mi"), std::string::npos);
  EXPECT_EQ(session_, nullptr);
  EXPECT_EQ(oriel_session_open(nullptr, nullptr, &session_), ORIEL_BAD_ARGUMENT);
  EXPECT_EQ(oriel_session_start(nullptr), ORIEL_BAD_ARGUMENT);
  open();
  OrielPicture* picture = nullptr;
  EXPECT_EQ(oriel_picture_acquire(session_, &picture), ORIEL_NO_PICTURE);
  EXPECT_EQ(oriel_session_save_picture(session_, file("early.exr").c_str()), ORIEL_NO_PICTURE);
  EXPECT_EQ(oriel_session_edit(session_, "gray.diffuse=1 1 1", nullptr), ORIEL_BAD_EDIT);
  EXPECT_NE(std::string(oriel_last_error()).find("grey"), std::string::npos) << "nearest name";
  OrielView view;
  oriel_init_view(&view);
  view.camera = "no_camera";
  EXPECT_EQ(oriel_session_set_view(session_, &view, nullptr), ORIEL_NOT_FOUND);
  view.camera = nullptr;
  view.width = -5;
  EXPECT_EQ(oriel_session_set_view(session_, &view, nullptr), ORIEL_BAD_ARGUMENT);
  EXPECT_EQ(oriel_session_wait(session_, 1, 0, 5), ORIEL_FAILED) << "it is stopped";
  EXPECT_EQ(oriel_session_start(session_), ORIEL_OK);
  EXPECT_EQ(oriel_session_wait(session_, 1000, 0, .05), ORIEL_TIMEOUT);
}

TEST_F(Embed, ProgramsWithOlderStructuresWork) {
  open();
  OrielView view;
  oriel_init_view(&view);
  view.size = offsetof(OrielView, samples);  // a version without the fields from here on
  view.samples = 0xdeadbeef;
  view.width = 24, view.height = 16;
  std::uint32_t epoch = 0;
  ASSERT_EQ(oriel_session_set_view(session_, &view, &epoch), ORIEL_OK);
  oriel_session_start(session_);
  ASSERT_EQ(oriel_session_wait(session_, epoch, 1, 60), ORIEL_OK) << oriel_last_error();
  struct {
    OrielStatus status;
    int guard;
  } old = {{}, 42};
  old.status.size = offsetof(OrielStatus, samples);
  old.status.samples = -7;
  ASSERT_EQ(oriel_session_status(session_, &old.status), ORIEL_OK);
  EXPECT_EQ(old.status.samples, -7) << "beyond the size that the program gave";
  EXPECT_EQ(old.status.size, offsetof(OrielStatus, samples));
}

TEST_F(Embed, ModelsAreConvertedByTheProgram) {
  write("model.mtl", "newmtl paint\nKd .5 .5 .5\n");
  write("model.obj",
        "mtllib model.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 1 1\nv -1 1 1\nusemtl paint\nf 1 4 3 2\n");
  OrielSettings settings;
  oriel_init_settings(&settings);
  settings.program = "/no/such/program";
  EXPECT_NE(oriel_session_open(file("model.obj").c_str(), &settings, &session_), ORIEL_OK);
  EXPECT_STRNE(oriel_last_error(), "");
  settings.program = ORIEL_PROGRAM;
  ASSERT_EQ(oriel_session_open(file("model.obj").c_str(), &settings, &session_), ORIEL_OK)
      << oriel_last_error();
  OrielView view;
  oriel_init_view(&view);
  view.width = 24, view.height = 16, view.samples = 4;
  std::uint32_t epoch = 0;
  ASSERT_EQ(oriel_session_set_view(session_, &view, &epoch), ORIEL_OK);
  ASSERT_EQ(oriel_session_start(session_), ORIEL_OK);
  const auto redness = [&](const char* edit) {
    EXPECT_EQ(oriel_session_edit(session_, edit, &epoch), ORIEL_OK) << oriel_last_error();
    EXPECT_EQ(oriel_session_wait(session_, epoch, UINT32_MAX, 60), ORIEL_OK) << oriel_last_error();
    const std::vector<float> pixels = saved();
    const std::size_t channels = pixels.size() / (24 * 16);
    float red = 0, blue = 0;
    for (std::size_t i = 0; i < pixels.size(); i += channels)
      red += pixels[i], blue += pixels[i + 2];
    EXPECT_GT(red, 0);
    return red / blue;
  };
  const float blue = redness("paint.diffuse=.1 .1 .9"), red = redness("paint.diffuse=.9 .1 .1");
  EXPECT_GT(red, 1.1f * blue) << "the model is a part of the picture, in daylight";
}

TEST_F(Embed, ShadersOfTrustedFoldersAreLoaded) {
  write("tint.c", R"(#include <shader.h>
struct tint { miColor color; };
DLLEXPORT int tint_version(void) { return 1; }
DLLEXPORT miBoolean tint(miColor* result, miState* state, struct tint* paras) {
  *result = *mi_eval_color(&paras->color);
  result->r *= .5f;
  return miTRUE;
}
)");
  std::filesystem::create_directories(file("lib"));
  ASSERT_EQ(run({"shader-build", "tint.c", "-o", "lib/tint.so"}).exit_code, 0);
  std::string scene = kScene;
  scene.insert(
      0,
      "link \"tint.so\"\ndeclare shader color \"tint\" ( color \"color\" ) version 1 apply "
      "texture end declare\nshader \"own\" \"tint\" ( \"color\" .8 .4 .2 )\n");
  write("scene.mi", scene);
  const std::string folder = file("lib");
  const char* const folders[] = {folder.c_str()};
  OrielSettings settings;
  oriel_init_settings(&settings);
  settings.shader_folders = folders;
  settings.shader_folder_count = 1;
  ASSERT_EQ(oriel_session_open(file("scene.mi").c_str(), &settings, &session_), ORIEL_OK)
      << oriel_last_error();
  view(8);
  ASSERT_EQ(oriel_session_start(session_), ORIEL_OK);
  const char* edit = "grey.diffuse==own";
  std::uint32_t epoch = 0;
  ASSERT_EQ(oriel_session_edit(session_, edit, &epoch), ORIEL_OK) << oriel_last_error();
  ASSERT_EQ(oriel_session_wait(session_, epoch, UINT32_MAX, 60), ORIEL_OK) << oriel_last_error();
  const std::vector<float> trusted = saved();
  EXPECT_EQ(trusted, rendered({"--set", edit, "--shader-path", "lib"}));
  EXPECT_NE(trusted, rendered({"--set", edit})) << "the library is of no use without its folder";
}

TEST_F(Embed, TheExampleRuns) {
  const std::string command = std::string(ORIEL_EMBED_EXAMPLE) + " " + file("scene.mi") +
                              " 'grey.diffuse=.9 .1 .1' " + file("out.exr") + " > " +
                              file("out.txt");
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string output = text_of(file("out.txt"));
  float before[3] = {}, after[3] = {};
  const std::size_t second = output.find("after");
  ASSERT_NE(second, std::string::npos) << output;
  const auto mean = [](const std::string& text, float* to) {
    return std::sscanf(text.c_str() + text.find("mean"), "mean %f %f %f", to, to + 1, to + 2);
  };
  ASSERT_EQ(mean(output, before), 3) << output;
  ASSERT_EQ(mean(output.substr(second), after), 3) << output;
  EXPECT_GT(after[0], before[0] * 1.2f);
  EXPECT_LT(after[1], before[1] * .6f);
  EXPECT_TRUE(std::filesystem::exists(file("out.exr")));
}

}  // namespace
}  // namespace oriel
