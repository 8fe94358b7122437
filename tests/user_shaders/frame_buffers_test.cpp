// SPDX-License-Identifier: Apache-2.0
// Frame buffers written by user shaders, in files and before output shaders.
#include "image/files.h"
#include "output/output_names.h"
#include "user_picture.h"

namespace oriel {
namespace frame_buffers_test {

using testing::ShaderFolder;
using testing::UserPicture;
using testing::UserScene;

const std::string kExamples = ORIEL_SOURCE_DIR "/examples/shaders/";
const std::string kLamp =
    "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 3 end light "
    "instance \"lamp_i\" \"lamp\" end instance ";

/// Puts what it is given into buffer 0, its red into 1, its first three as a vector into 2, and
/// into 3 the pixel's own place.
const char* const kPutter =
    "#include <shader.h>\n"
    "struct put { miColor c; };"
    "DLLEXPORT miBoolean put(miColor *r, miState *state, struct put *p) {"
    "  miColor c = *mi_eval_color(&p->c), x = {0, 0, 0, 1};"
    "  miVector v; v.x = c.r; v.y = c.g; v.z = c.b; x.r = state->raster_x;"
    "  mi_fb_put(state, 0, &c); mi_fb_put(state, 1, &c.r); mi_fb_put(state, 2, &v);"
    "  mi_fb_put(state, 3, &x); if (mi_fb_put(state, 7, &c)) return miFALSE;"
    "  *r = c; return miTRUE; }"
    "DLLEXPORT miBoolean dim(void *r, miState *state, void *p) {"
    "  miImg_image *b = mi_output_image_open(state, miRC_IMAGE_USER + 0); miColor c;"
    "  miImg_image *z = mi_output_image_open(state, miRC_IMAGE_RGBA); int x, y;"
    "  if (!b || !z || mi_output_image_open(state, miRC_IMAGE_USER + 5)) return miFALSE;"
    "  for (y = 0; y < 8; y++) for (x = 0; x < 8; x++) {"
    "    mi_img_get_color(b, &c, x, y); c.r *= 2; c.g *= 2; c.b *= 2;"
    "    mi_img_put_color(b, &c, x, y); mi_img_put_color(z, &c, x, y); }"
    "  mi_output_image_close(state, miRC_IMAGE_USER + 0);"
    "  mi_output_image_close(state, miRC_IMAGE_RGBA); return miTRUE; }";
const std::string kDeclared =
    "link \"p.so\" declare shader color \"put\" ( color \"c\" ) apply material end declare "
    "declare shader \"dim\" ( ) apply output end declare "
    "material \"m\" \"put\" ( \"c\" .1 .2 .4 1 ) end material " +
    UserScene::square("m");
const std::string kBuffers =
    "frame buffer 0 \"+rgba_fp\" frame buffer 1 \"+s\" frame buffer 2 \"+n\" "
    "frame buffer 3 \"-rgba\" ";

// acceptance: U6
TEST(UserFrameBuffers, NumberedBuffersAreLayersOfTheirKind) {
  const ShaderFolder folder;
  folder.compile("p", kPutter);
  UserScene scene(folder, kDeclared, "\"square_i\"", kBuffers);
  const UserPicture picture(scene, 4);
  const auto layers = picture.layers(folder);
  const Layer* color = find_layer(layers, "fb0");
  const Layer* scalar = find_layer(layers, "fb1");
  const Layer* vector = find_layer(layers, "fb2");
  const Layer* first = find_layer(layers, "fb3");
  ASSERT_TRUE(color && scalar && vector && first);
  EXPECT_EQ(color->channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(scalar->channel_names, (std::vector<std::string>{"X"}));
  EXPECT_EQ(vector->channel_names, (std::vector<std::string>{"X", "Y", "Z"}));
  const float wanted[] = {.1f, .2f, .4f, 1};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int k = 0; k < 4; ++k) EXPECT_FLOAT_EQ(color->image.at(x, y)[k], wanted[k]);
  for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(vector->image.at(3, 3)[k], wanted[k]);
  EXPECT_FLOAT_EQ(*scalar->image.at(3, 3), .1f);
  // Not interpolated: one sample's place, not the mean of four.
  sampling::Sampler sampler(3, 4, 0, 0);
  const FilterSampler filter(scene.world->options.filter);
  const float x = 3.5f + filter.sample(sampler.next_2d()).pixels.x;
  EXPECT_NEAR(first->image.at(3, 3)[0], x, 1e-5f);
  EXPECT_EQ(scene.messages(), "");
}

// acceptance: U6
TEST(UserFrameBuffers, OutputsOfAnyBufferAreFilesOfIt) {
  const ShaderFolder folder;
  folder.compile("p", kPutter);
  UserScene scene(folder, kDeclared, "\"square_i\"", kBuffers,
                  "output \"fb0\" \"exr\" \"a.exr\" output \"fb1\" \"exr\" \"b.exr\" "
                  "output \"rgba,fb0\" \"exr\" \"c.exr\" output \"fb9\" \"exr\" \"d.exr\"");
  const UserPicture picture(scene, 1);
  ASSERT_EQ(picture.write_files(folder).size(), 3u);
  const auto read = [&](const char* name) { return read_exr((folder.path() / name).string()); };
  const Image a = read("a.exr").layers.at(0).image, b = read("b.exr").layers.at(0).image;
  ASSERT_EQ(a.channels, 4);
  ASSERT_EQ(b.channels, 1);
  EXPECT_FLOAT_EQ(a.at(5, 2)[2], .4f);
  EXPECT_FLOAT_EQ(*b.at(5, 2), .1f);
  EXPECT_NE(find_layer(read("c.exr").layers, "fb0"), nullptr);
  EXPECT_NE(scene.messages().find("OR-RN-054"), std::string::npos);
  EXPECT_NE(scene.messages().find("\"fb9\" is not a buffer of the options"), std::string::npos);
}

// acceptance: U6
TEST(UserFrameBuffers, NamedBuffersMeanWhatTheyMeantUntilAShaderWrites) {
  const ShaderFolder folder;
  folder.compile("named",
                 "#include <shader.h>\n#include <mi_shader_if.h>\n"
                 "extern \"C\" DLLEXPORT miBoolean named(miColor *r, miState *state, void *) {"
                 "  using namespace mi::shader; size_t i = 0; miColor c = {.1f, .2f, .4f, 1};"
                 "  Access_fb buffers(state->camera->buffertag);"
                 "  if (!buffers->get_index(\"own\", i)) return miFALSE;"
                 "  mi_fb_put(state, (int)i, &c);"
                 "  if (!buffers->get_index(\"spec_raw\", i)) return miFALSE;"
                 "  mi_fb_put(state, (int)i, &c);"
                 "  *r = c; return miTRUE; }",
                 "cpp");
  UserScene scene(folder,
                  "link \"named.so\" declare shader color \"named\" ( ) apply material end declare "
                  "material \"m\" \"named\" ( ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"", "",
                  "framebuffer \"refl_raw\" datatype \"rgba\" filetype \"exr\" filename \"r.exr\" "
                  "framebuffer \"own\" datatype \"rgba_fp\" filetype \"exr\" filename \"own.exr\" "
                  "framebuffer \"spec_raw\" datatype \"rgba\" filetype \"exr\" filename \"s.exr\"");
  const UserPicture picture(scene, 1);
  const auto layers = picture.layers(folder);
  ASSERT_NE(find_layer(layers, "own"), nullptr);
  ASSERT_NE(find_layer(layers, "spec_raw"), nullptr);
  EXPECT_EQ(find_layer(layers, "refl_raw"), nullptr);
  ASSERT_EQ(picture.write_files(folder).size(), 3u);
  const auto first = [&](const char* name) {
    return read_exr((folder.path() / name).string()).layers.at(0).image;
  };
  EXPECT_FLOAT_EQ(first("own.exr").at(4, 4)[1], .2f);
  EXPECT_FLOAT_EQ(first("s.exr").at(4, 4)[1], .2f);
  EXPECT_EQ(first("r.exr").at(4, 4)[1], 0);
  EXPECT_EQ(scene.messages(), "");
}

// acceptance: U6
TEST(UserFrameBuffers, OutputShadersReadAndChangeThem) {
  const ShaderFolder folder;
  folder.compile("p", kPutter);
  UserScene scene(folder, kDeclared, "\"square_i\"", kBuffers,
                  "output \"fb0\" \"exr\" \"before.exr\" output \"rgba\" \"dim\" ( ) "
                  "output \"fb0\" \"exr\" \"after.exr\" output \"rgba_fp\" \"tif\" \"shown.tif\"");
  const UserPicture picture(scene, 1);
  const auto files = picture.write_files(folder);
  ASSERT_EQ(files.size(), 3u) << scene.messages();
  const auto first = [&](const char* name) {
    return read_exr((folder.path() / name).string()).layers.at(0).image;
  };
  EXPECT_FLOAT_EQ(first("before.exr").at(4, 4)[1], .2f);
  EXPECT_FLOAT_EQ(first("after.exr").at(4, 4)[1], .4f);
  EXPECT_FLOAT_EQ(shown_image(*picture.session, files[2].shaders).at(4, 4)[1], .4f);
  EXPECT_FLOAT_EQ(read_image((folder.path() / "shown.tif").string()).at(4, 4)[1], .4f);
  EXPECT_EQ(scene.messages(), "");
}

TEST(UserFrameBuffers, ScenesWithoutUsersShadersKeepNone) {
  const ShaderFolder folder;
  UserScene scene(folder,
                  "material \"m\" \"mib_illum_lambert\" ( ) end material " + UserScene::square("m"),
                  "\"square_i\"", kBuffers);
  EXPECT_TRUE(scene.world->user_buffers.empty());
  const UserPicture picture(scene, 1);
  EXPECT_EQ(picture.session->film().user_buffers(), 0u);
  EXPECT_EQ(find_layer(picture.layers(folder), "fb0"), nullptr);
}

/// A lit sheet of coloured glass that reflects a grey sky.
std::string sheet(const std::string& material) {
  return kLamp +
         "shader \"x\" \"mia_material_x\" ( \"diffuse\" .7 .5 .3 1, \"reflectivity\" .4, "
         "\"refl_color\" .9 .8 .7 1, \"transparency\" .3, \"refr_color\" .5 .7 .9 1, \"refr_ior\" "
         "1.5, \"thin_walled\" on, \"multiple_outputs\" on ) material \"m\" " +
         material + " end material " + UserScene::square("m");
}
const char* const kSky = "environment \"mib_color_mix\" ( \"num\" 0, \"color_base\" .2 .4 .6 1 )";

Rgb mean(const Image& image) {
  Rgb sum(0);
  for (std::size_t i = 0; i < image.pixel_count(); ++i)
    for (int k = 0; k < 3; ++k)
      sum[k] +=
          image.pixels[i * static_cast<std::size_t>(image.channels) + static_cast<std::size_t>(k)];
  return sum / static_cast<float>(image.pixel_count());
}

// acceptance: I2
TEST(UserFrameBuffers, TheManualsWrapperWritesWhatTheMaterialSaysOfItself) {
  const ShaderFolder folder;
  folder.compile_file("mia_wrapper", kExamples + "mia_wrapper/mia_material_out_wrapper.c");
  const std::string declaration =
      "link \"mia_wrapper.so\" declare shader color \"mia_material_out_wrapper\" ( shader \"mtl\" "
      ") version 1 apply material end declare ";
  const std::string buffers =
      "frame buffer 10 \"+rgba_fp\" frame buffer 11 \"+rgba_fp\" frame buffer 12 \"+rgba_fp\" ";
  UserScene wrapped(folder, declaration + sheet("\"mia_material_out_wrapper\" ( \"mtl\" \"x\" )"),
                    "\"lamp_i\" \"square_i\"", buffers, kSky);
  UserScene bare(folder, sheet("= \"x\""), "\"lamp_i\" \"square_i\"", "", kSky);
  const auto found = UserPicture(wrapped, 512).layers(folder);
  const auto own = UserPicture(bare, 512, true).layers(folder, LayerSet(LayerGroup::Outputs));
  // Diffuse light has no noise but that of the places in the pixel, which are the same. A path
  // goes one way of several: of 32768 a tenth at least is reflected, 3 deviations are 5 %.
  const std::tuple<const char*, const char*, float> pairs[] = {{"fb10", "diffuse_result", 1e-4f},
                                                               {"fb11", "refl_result", .05f},
                                                               {"fb12", "refr_result", .05f}};
  for (const auto& [buffer, output, tolerance] : pairs) {
    const Layer* by_shader = find_layer(found, buffer);
    const Layer* by_renderer = find_layer(own, output);
    ASSERT_TRUE(by_shader && by_renderer) << buffer << wrapped.messages() << bare.messages();
    const Rgb wanted = mean(by_renderer->image), shown = mean(by_shader->image);
    EXPECT_GT(wanted.x, .005f) << output;
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(shown[k] / wanted[k], 1, tolerance) << output << " channel " << k;
  }
  EXPECT_EQ(wrapped.messages() + bare.messages(), "");
}

}  // namespace frame_buffers_test
}  // namespace oriel
