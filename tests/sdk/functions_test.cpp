// SPDX-License-Identifier: Apache-2.0
// functions.txt lists exactly the functions declared in the shader headers.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>

namespace oriel {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(ORIEL_SOURCE_DIR) / "include/oriel/sdk";

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// name -> "header kind"
using Offer = std::map<std::string, std::string>;

void collect(const std::string& text, const std::regex& pattern, const std::string& what,
             Offer& offer) {
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    EXPECT_TRUE(offer.emplace((*match)[1], what).second) << (*match)[1] << " stands there twice";
}

/// What the headers declare: functions at the start of a line, macros with arguments.
Offer declared() {
  static const std::regex comment("//[^\n]*"), directive("(^|\n)#([^\n]*\\\\\n)*[^\n]*");
  static const std::regex macro("#define (mi(?:_|IMG_|IRRAD_|AMBOCCL_|APPROX_)\\w*)\\(");
  static const std::regex function("\n[\\w* ]*?\\b((?:mi|oriel|mayabase)_\\w+)\\(");
  Offer offer;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
    if (entry.path().extension() != ".h") continue;
    const std::string header = entry.path().lexically_relative(kFolder).generic_string();
    const std::string text = std::regex_replace(text_of(entry.path()), comment, "");
    collect(text, macro, header + " macro", offer);
    if (header != "mi_shader_if.h")
      collect(std::regex_replace(text, directive, "\n"), function, header + " function", offer);
  }
  return offer;
}

TEST(SdkFunctions, TheListIsThatOfTheHeaders) {
  const Offer offer = declared();
  EXPECT_GT(offer.size(), 300u);
  Offer listed;
  std::ifstream file(kFolder / "functions.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string name, header, kind, priority, since, callers;
    ASSERT_TRUE(words >> name >> header >> kind >> priority >> since >> callers) << line;
    EXPECT_NE(std::string("ABCD").find(priority), std::string::npos) << line;
    EXPECT_EQ(callers.find_first_not_of("GDPELMVISCOT*"), std::string::npos) << line;
    EXPECT_TRUE(listed.emplace(name, header + " " + kind).second) << line;
  }
  for (const auto& [name, what] : offer)
    EXPECT_EQ(listed.count(name), 1u) << name << " is not in functions.txt";
  for (const auto& [name, what] : listed) {
    const auto found = offer.find(name);
    ASSERT_NE(found, offer.end()) << name << " is in no header";
    EXPECT_EQ(found->second, what) << name;
  }
}

TEST(SdkFunctions, EachHasADescription) {
  static const std::regex offered(
      "\n([^\n]*)\n(?:(?! )[\\w* ]+?\\b((?:mi|oriel|mayabase)_\\w+)|#define (mi\\w+))\\(");
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
    if (entry.path().extension() != ".h" || entry.path().filename() == "mi_shader_if.h") continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), offered), end; match != end; ++match)
      EXPECT_EQ((*match)[1].str().substr(0, 3), "///") << (*match)[2] << (*match)[3];
  }
}

}  // namespace
}  // namespace oriel
