// SPDX-License-Identifier: Apache-2.0
#include "scene/references.h"

#include <gtest/gtest.h>

namespace oriel::scene {
namespace references_test {

ShaderElement shader(const std::string& name) {
  ShaderElement element;
  element.name = name;
  return element;
}

ShaderList reference(const std::string& name) {
  return {{.reference = name, .type = {}, .arguments = {}, .where = {}}};
}

TEST(References, DotsArePartOfANameOrBeginTheNameOfAResult) {
  Scene scene;
  scene.add(shader("wood.001"));
  scene.add(shader("paint"));
  References references(scene);
  references.follow(reference("wood.001"));
  references.follow(reference("wood.001.result"));
  references.follow(reference("paint.result"));
  references.follow(reference("missing.result"));
  EXPECT_EQ(references.names(), (std::vector<std::string>{"wood.001", "paint", "missing"}));
}

}  // namespace references_test
}  // namespace oriel::scene
