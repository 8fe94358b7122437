// SPDX-License-Identifier: Apache-2.0
// Layer table: unique names, consistent sets, and agreement with docs/outputs.md.
#include "output/layer_table.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

namespace oriel {
namespace layer_table_test {
namespace {

std::string documentation() {
  std::stringstream text;
  text << std::ifstream(ORIEL_SOURCE_DIR "/docs/outputs.md").rdbuf();
  return text.str();
}

TEST(LayerTable, NamesAndFileNamesAreUnique) {
  std::set<std::string> names, files;
  for (const LayerSpec& row : layer_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(row.expand || files.insert(row.exr).second) << row.exr;
    EXPECT_EQ(row.channels.empty(), row.expand != nullptr) << row.name;
    EXPECT_EQ(int{bool{row.value}} + (row.expand != nullptr) + row.surface_value.has_value(), 1)
        << row.name;
  }
  EXPECT_LE(names.size(), 64u) << "LayerSet holds no more";
}

TEST(LayerTable, SetsMatchTheStoredLayers) {
  EXPECT_FALSE(LayerSet(LayerGroup::Film).needs(LayerNeed::Outputs));
  EXPECT_TRUE(LayerSet("diffuse_raw").needs(LayerNeed::Outputs));
  EXPECT_TRUE(LayerSet("illuminance").needs(LayerNeed::Irradiance));
  EXPECT_FALSE(LayerSet("luminance").needs(LayerNeed::Irradiance));
  EXPECT_EQ(LayerSet("motion").surface_values().count(), 1u);
  EXPECT_TRUE(LayerSet("depth").surface_values().none());
  EXPECT_FALSE(LayerSet::all().needs(LayerNeed::Mattes));
  EXPECT_TRUE(LayerSet("gloss").empty());
  EXPECT_TRUE(LayerSet("fbN").empty()) << "a family";
}

TEST(LayerTable, TypesOfOutputStatementsAreLayers) {
  ASSERT_TRUE(layer_of_type("z"));
  EXPECT_EQ(layer_of_type("z")->exr, "Z");
  EXPECT_EQ(layer_of_type("m")->view, PixelView::Motion);
  EXPECT_EQ(layer_of_type("rgba"), nullptr) << "the picture itself";
  EXPECT_EQ(layer_of_view(PixelView::Alpha), nullptr);
}

TEST(LayerTable, TheDocumentationShowsIt) {
  const std::string page = documentation();
  EXPECT_NE(page.find(layer_documentation()), std::string::npos) << "docs/outputs.md should have:\n"
                                                                 << layer_documentation();
  for (const LayerSpec& row : layer_table())
    if (row.type) {
      const std::string line = "| `" + std::string(row.type) + "` | " + row.about + " |";
      EXPECT_NE(page.find(line), std::string::npos) << line;
    }
}

}  // namespace
}  // namespace layer_table_test
}  // namespace oriel
