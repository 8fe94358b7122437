// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "image/files.h"
#include "oriel/sdk/shader/image.h"
#include "output/camera_output.h"
#include "sdk/current.h"
#include "sdk/picture.h"
#include "sdk/testing/bare_state.h"
#include "support/expect_near.h"
#include "support/files.h"

namespace oriel::sdk {
namespace image_test {

using testing::expect_near;

/// Permits shaders to write to a folder of the test.
struct Writable {
  TestFolder folder;
  Writable() { set_output_roots({folder.file(""), {folder.file("")}}); }
  ~Writable() { set_output_roots({}); }
};

miColor colour_at(int x, int y) {
  return {.125f * static_cast<float>(x), .25f * static_cast<float>(y), .5f, .75f};
}

void write_and_read(const char* name, miImg_type type, miImg_format format, float tolerance) {
  SCOPED_TRACE(name);
  miImg_file file;
  ASSERT_TRUE(mi_img_create(&file, name, type, format, 8, 4));
  miImg_image* image = mi_img_image_alloc(&file);
  ASSERT_TRUE(image);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      const miColor c = colour_at(x, y);
      mi_img_put_color(image, &c, x, y);
    }
  ASSERT_TRUE(mi_img_image_write(&file, image));
  mi_img_image_release(image);
  EXPECT_TRUE(mi_img_close(&file));

  ASSERT_TRUE(mi_img_open(&file, name, miIMG_TYPE_ANY));
  EXPECT_EQ(file.width, 8);
  EXPECT_EQ(file.height, 4);
  EXPECT_GT(file.filesize, 0);
  image = mi_img_image_alloc(&file);
  ASSERT_TRUE(mi_img_image_read(&file, image));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      miColor c;
      mi_img_get_color(image, &c, x, y);
      miColor expected = colour_at(x, y);
      if (traits_of(type).components == 3) expected.a = 1;
      expect_near(c, expected, tolerance);
    }
  mi_img_image_release(image);
  EXPECT_TRUE(mi_img_close(&file));
  EXPECT_FALSE(mi_img_close(&file));
  EXPECT_EQ(file.error, miIMG_ERR_NOTOPEN);
}

TEST(ShaderImages, AreWrittenAndReadBack) {
  const Writable writable;
  write_and_read("a.exr", miIMG_TYPE_RGBA_FP, miIMG_FORMAT_EXR, 0);
  write_and_read("h.exr", miIMG_TYPE_RGBA_H, miIMG_FORMAT_FROM_EXT, 1e-3f);
  write_and_read("b.png", miIMG_TYPE_RGBA, miIMG_FORMAT_PNG, .5f / 255 + 1e-6f);
  write_and_read("c.png", miIMG_TYPE_RGB_16, miIMG_FORMAT_FROM_EXT, .5f / 65535 + 1e-6f);
}

TEST(ShaderImages, AreWrittenInTheRequestedFormat) {
  const Writable writable;
  miImg_file file;
  ASSERT_TRUE(mi_img_create(&file, "shadow.map", miIMG_TYPE_S_FP, miIMG_FORMAT_EXR, 2, 2));
  miImg_image* image = mi_img_image_alloc(&file);
  mi_img_put_scalar(image, 3.5f, 1, 0);
  ASSERT_TRUE(mi_img_image_write(&file, image));
  mi_img_image_release(image);
  mi_img_close(&file);
  std::filesystem::rename(writable.folder.file("shadow.map"), writable.folder.file("s.exr"));
  const Image read = read_image(writable.folder.file("s.exr"));
  EXPECT_EQ(*read.at(1, 1), 3.5f) << "the lowest row is the last of the file";
}

TEST(ShaderImages, AreRefusedOutsideOfTheFoldersOfScenes) {
  const Writable writable;
  testing::BareState bare;
  set_current_host(&bare.host());
  miImg_file file;
  EXPECT_FALSE(mi_img_create(&file, "../escaped.png", miIMG_TYPE_RGB, miIMG_FORMAT_PNG, 2, 2));
  EXPECT_EQ(file.error, miIMG_ERR_CREATE);
  EXPECT_EQ(bare.diagnostics().count(Severity::Error), 1u);
  EXPECT_FALSE(mi_img_create(&file, "a.png", miIMG_TYPE_RGB, miIMG_FORMAT_CT, 2, 2));
  EXPECT_EQ(file.error, miIMG_ERR_SUBTYPE);
  EXPECT_FALSE(mi_img_create(&file, "a.png", miIMG_TYPE_RGB, miIMG_FORMAT_PNG, 0, 2));
  EXPECT_EQ(file.error, miIMG_ERR_SIZE);
  set_output_roots({});
  EXPECT_FALSE(mi_img_create(&file, "a.png", miIMG_TYPE_RGB, miIMG_FORMAT_PNG, 2, 2));
}

TEST(ShaderImages, MissingImagesDoNotOpen) {
  const Writable writable;
  testing::BareState bare;
  set_current_host(&bare.host());
  miImg_file file;
  EXPECT_FALSE(mi_img_open(&file, "none.exr", miIMG_TYPE_ANY));
  EXPECT_EQ(file.error, miIMG_ERR_OPEN);
  EXPECT_FALSE(mi_img_image_read(&file, nullptr));
  EXPECT_EQ(file.error, miIMG_ERR_NOTOPEN);
}

TEST(ShaderImages, KeepTheRangeOfTheirType) {
  Picture depth(miIMG_TYPE_Z, 3, 2), normal(miIMG_TYPE_N, 3, 2), tag(miIMG_TYPE_TAG, 3, 2);
  Picture rgbe(miIMG_TYPE_RGBE, 3, 2);
  mi_img_put_depth(&depth, -123.25f, 2, 1);
  const miVector n = {.6f, 0, -.8f};
  mi_img_put_normal(&normal, &n, 1, 1);
  mi_img_put_label(&tag, 0xfedcba98u, 0, 1);
  const miColor c = {1000, 20, .5f, 1};
  mi_img_put_color(&rgbe, &c, 0, 0);
  float z;
  miVector m;
  miUint label;
  miColor d;
  mi_img_get_depth(&depth, &z, 2, 1);
  mi_img_get_normal(&normal, &m, 1, 1);
  mi_img_get_label(&tag, &label, 0, 1);
  mi_img_get_color(&rgbe, &d, 0, 0);
  EXPECT_EQ(z, -123.25f);
  EXPECT_EQ(m.z, -.8f);
  EXPECT_EQ(label, 0xfedcba98u);
  EXPECT_NEAR(d.r, 1000, 4);
  EXPECT_NEAR(d.g, 20, 4);
  mi_img_get_color(&rgbe, &d, 1, 0);
  EXPECT_EQ(d.r, 0) << "black stays black";
}

TEST(ShaderImages, GiveTheirRows) {
  Picture picture(miIMG_TYPE_RGB, 5, 3);
  const miColor c = {0, 1, .2f, 1};
  mi_img_put_color(&picture, &c, 4, 2);
  EXPECT_EQ(miIMG_ACCESS(&picture, 2, miIMG_G)[4], 255);
  EXPECT_EQ(miIMG_ACCESS(&picture, 2, miIMG_B)[4], 51);
  EXPECT_EQ(miIMG_ACCESS(&picture, 3, miIMG_R), nullptr);
  EXPECT_EQ(mi_img_get_width(&picture), 5);
  EXPECT_EQ(mi_img_get_height(&picture), 3);
}

TEST(ShaderImages, OutsideOfThePictureAreZero) {
  Picture picture(miIMG_TYPE_RGBA_FP, 2, 2);
  miColor c = {1, 1, 1, 1};
  mi_img_put_color(&picture, &c, 2, 0);
  mi_img_put_color(&picture, &c, 0, -1);
  mi_img_get_color(&picture, &c, 5, 5);
  EXPECT_EQ(c.r, 0);
  c.r = 1;
  mi_img_get_color(nullptr, &c, 0, 0);
  EXPECT_EQ(c.r, 0);
}

TEST(ShaderImages, HaveTypesAndFormatsByName) {
  EXPECT_EQ(mi_img_type_identify("rgba_fp"), miIMG_TYPE_RGBA_FP);
  EXPECT_EQ(mi_img_type_identify("coverage"), miIMG_TYPE_COVERAGE);
  EXPECT_EQ(mi_img_type_identify("nothing"), miIMG_NTYPES);
  for (int t = 0; t < miIMG_NTYPES; ++t)
    EXPECT_EQ(mi_img_type_identify(mi_img_type_name(static_cast<miImg_type>(t))), t);
  EXPECT_EQ(mi_img_format_identify("exr"), miIMG_FORMAT_EXR);
  EXPECT_EQ(mi_img_format_identify("tiff"), miIMG_FORMAT_TIFF);
  EXPECT_EQ(mi_img_format_identify("tifu"), miIMG_FORMAT_TIFF_U);
  EXPECT_STREQ(mi_img_format_name(miIMG_FORMAT_TIFF_U), "tifu");
  EXPECT_STREQ(mi_img_format_name(miIMG_FORMAT_TARGA), "tga");
}

}  // namespace image_test
}  // namespace oriel::sdk
