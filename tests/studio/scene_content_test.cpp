// SPDX-License-Identifier: Apache-2.0
#include "studio/scene_content.h"

#include <gtest/gtest.h>

namespace oriel::studio {
namespace {

using Edits = std::vector<std::string>;

TEST(SceneContent, IsTheSameAfterEditsWereWritten) {
  SceneContent content;
  const Edits edits = {"floor.diffuse=1 0 0", "sun.haze=3"}, inverse = {"floor.diffuse=.5 .5 .5"};
  const std::string first = content.name({}), edited = content.name(edits);
  EXPECT_NE(first, edited);
  EXPECT_EQ(content.name(edits), edited);
  EXPECT_NE(content.name({"floor.diffuse=1 0 0sun.haze=3"}),
            content.name({"floor.diffuse=1 0 0", "sun.haze=3"}));
  content.save(edits, inverse);
  EXPECT_EQ(content.name({}), edited) << "the files contain the edits";
  EXPECT_EQ(content.name(inverse), first) << "the edits were taken back";
  EXPECT_NE(content.name(edits), edited) << "edits of other files";
  content.save({}, {});
  EXPECT_EQ(content.name({}), edited) << "nothing was written";
}

TEST(SceneContent, DiffersAfterTheFilesChanged) {
  SceneContent content;
  const std::string before = content.name({});
  content.forget();
  EXPECT_NE(content.name({}), before);
  EXPECT_NE(SceneContent().name({}), SceneContent().name({}));
}

}  // namespace
}  // namespace oriel::studio
