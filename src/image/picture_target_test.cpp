// SPDX-License-Identifier: Apache-2.0
#include "image/picture_target.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "image/files.h"
#include "support/files.h"

namespace oriel {
namespace picture_target_test {

TEST(PictureTarget, PicturesOfEveryFormatMayBeReplaced) {
  const TestFolder folder;
  for (const char* type : {"exr", "png", "hdr", "jpg", "tif", "tga", "bmp", "ppm", "pgm", "pnm",
                           "iff", "sgi", "rla", "dpx", "fits", "gif", "jp2", "webp"}) {
    const std::string path = folder.file(std::string("a.") + type);
    try {
      write_image(path, Image(40, 30, 3));
    } catch (const std::exception& e) {
      continue;  // the image library was built without this format
    }
    EXPECT_EQ(picture_fault(path), "") << type;
    EXPECT_NO_THROW(write_image(path, Image(40, 30, 3))) << type;
  }
}

TEST(PictureTarget, OtherFilesAreKept) {
  const TestFolder folder;
  const std::string text = "render \"root\" \"camera\" \"options\"\n";
  for (const char* name : {"a.exr", "a.png", "a.tif"}) {
    write_bytes(folder.file(name), {text.begin(), text.end()});
    EXPECT_NE(picture_fault(folder.file(name)), "");
    EXPECT_THROW(write_image(folder.file(name), Image(4, 4, 3)), std::runtime_error);
    EXPECT_EQ(text_of(folder.file(name)), text);
  }
  EXPECT_EQ(folder.count(), 3);
}

TEST(PictureTarget, LinksPipesFoldersAndHiddenNamesAreRefused) {
  const TestFolder folder;
  write_image(folder.file("a.png"), Image(4, 4, 3));
  std::filesystem::create_symlink("a.png", folder.file("link.png"));
  std::filesystem::create_directory(folder.file("folder.png"));
  ASSERT_EQ(mkfifo(folder.file("pipe.png").c_str(), 0600), 0);
  for (const char* name : {"link.png", "folder.png", "pipe.png", ".hidden.png", ".png"})
    EXPECT_NE(picture_fault(folder.file(name)), "") << name;
  EXPECT_EQ(picture_fault(folder.file("new.png")), "");
  write_bytes(folder.file("empty.png"), {});
  EXPECT_EQ(picture_fault(folder.file("empty.png")), "") << "nothing is lost";
}

}  // namespace picture_target_test
}  // namespace oriel
