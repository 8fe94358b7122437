// SPDX-License-Identifier: Apache-2.0
// Element tables: the parser reads each row, and the row sets its field.
#include "scene/element_settings.h"

#include <functional>

#include "mi/testing/test_support.h"
#include "scene/option_table.h"

namespace oriel::mi {
namespace element_tables_test {

using scene::StatementRow;

/// The keywords of a row: `bsp: size|depth` has two, `filter (clip)` has one.
std::vector<std::string> spellings(const StatementRow& row) {
  const std::string keyword(row.keyword);
  const auto colon = keyword.find(": ");
  if (colon == std::string::npos) return {scene::name_of(row)};
  std::vector<std::string> all;
  std::istringstream words(keyword.substr(colon + 2));
  for (std::string word; std::getline(words, word, '|');)
    all.push_back(keyword.substr(0, colon) + " " + word);
  return all;
}

/// Values to try after a keyword: usual forms, and the words in the form of the row.
std::vector<std::string> candidates(const StatementRow& row) {
  std::vector<std::string> all = {"",        "off",         "on",      "3",           ".25",
                                  "2 .25",   ".5 .25",      "7 .5 1",  "1 2 3 4",     "\"s\"",
                                  "4 \"s\"", ".5 .4 .3 .2", "[\"s\"]", "grid \"s\" 2"};
  std::string words(row.form);
  for (char& c : words)
    if (c == '|' || c == '[' || c == ']' || c == '<' || c == '>') c = ' ';
  std::istringstream in(words);
  for (std::string word; in >> word;) {
    std::replace(word.begin(), word.end(), '_', ' ');
    all.push_back(scene::is_string_option(row) ? '"' + word + '"' : word);
    all.push_back(word + " 2");
  }
  return all;
}

/// Whether the statement was read by this row only, and changes its field.
struct Outcome {
  bool parsed = false, sets = false;
};

template <class T>
void expect_rows_act(const scene::ElementTable<T>& table,
                     const std::function<Outcome(const std::string&, const StatementRow&)>& attempt,
                     const std::set<std::string>& without_change = {}) {
  for (const scene::Row<T>& row : table.rows()) {
    EXPECT_FALSE(row.meaning.empty()) << row.keyword;
    if (row.form == "<text>") continue;
    for (const std::string& keyword : spellings(row)) {
      Outcome best;
      for (const std::string& values : candidates(row)) {
        const Outcome outcome = attempt(keyword + " " + values, row);
        best.parsed |= outcome.parsed;
        best.sets |= outcome.parsed && outcome.sets;
      }
      EXPECT_TRUE(best.parsed) << keyword;
      EXPECT_EQ(best.sets, row.set && !without_change.contains(keyword)) << keyword;
    }
  }
}

/// Tries rows in `head "e" ... tail`; `statements` are those of the element.
template <class Element, class T>
void expect_element_rows_act(const scene::ElementTable<T>& table, const std::string& head,
                             const std::string& tail,
                             std::vector<scene::Statement> Element::*statements,
                             const std::set<std::string>& without_change = {}) {
  expect_rows_act(
      table,
      [&](const std::string& statement, const StatementRow& row) -> Outcome {
        const Snippet snippet(head + "\n" + statement + "\n" + tail + "\n");
        const Element* element = snippet.scene.get<Element>("e");
        if (!element || !snippet.diagnostics.all().empty()) return {};
        std::vector<scene::FormItem> items;
        const auto& list = element->*statements;
        if (list.size() != 1) return {};
        const auto match = table.match(list[0], items);
        return {match.row == &row && match.fits, !(table.read(list) == T{})};
      },
      without_change);
}

TEST(ElementTables, RowsOfOptionsAreParsedAndSetTheirFields) {
  const auto attempt = [](const std::string& statement, const StatementRow& row) -> Outcome {
    const Snippet snippet("options \"e\"\n" + statement + "\nend options\n");
    const auto* options = snippet.scene.get<scene::Options>("e");
    if (!options || !snippet.diagnostics.all().empty() || options->statements.size() != 1)
      return {};
    std::vector<scene::FormItem> items;
    const auto match = scene::option_table().match(options->statements[0], items);
    Diagnostics diagnostics;
    scene::RenderOptions read = scene::interpret_options(*options, diagnostics);
    read.without_effect.clear();
    return {match.row == &row && match.fits && diagnostics.all().empty(),
            !(read == scene::RenderOptions{})};
  };
  // The first sets the default value; the second is parsed by scene/approximation.h.
  expect_rows_act(scene::option_table(), attempt, {"object space", "approximate"});
}

TEST(ElementTables, RowsOfOtherElementsAreParsedAndSetTheirFields) {
  expect_element_rows_act(scene::camera_table(), "camera \"e\"", "end camera",
                          &scene::Camera::other);
  expect_element_rows_act(scene::light_table(), "light \"e\" \"s\" ()", "end light",
                          &scene::Light::other);
  expect_element_rows_act(scene::light_profile_table(), "lightprofile \"e\"", "end lightprofile",
                          &scene::LightProfile::statements);
  expect_element_rows_act(scene::object_table(), "object \"e\"", "end object",
                          &scene::Object::flags);
  expect_element_rows_act(scene::instance_table(), "instance \"e\" \"o\"", "end instance",
                          &scene::Instance::flags);
  expect_element_rows_act(scene::instance_group_table(), "instgroup \"e\"", "end instgroup",
                          &scene::InstanceGroup::settings);
  expect_element_rows_act(scene::assembly_table(), "assembly \"e\"", "end assembly",
                          &scene::Assembly::statements);
}

TEST(ElementTables, ReferenceOptionsAreInTheTable) {
  for (const char* keyword : {"samples",
                              "contrast",
                              "\"contrast all buffers\"",
                              "filter",
                              "filter clip",
                              "jitter",
                              "samplelock",
                              "trace depth",
                              "shadow",
                              "shadow sort",
                              "shadow segments",
                              "\"light relative scale\"",
                              "finalgather",
                              "finalgather accuracy",
                              "finalgather accuracy view",
                              "\"finalgather mode\"",
                              "\"finalgather points\"",
                              "finalgather presample density",
                              "finalgather filter",
                              "finalgather falloff",
                              "finalgather trace depth",
                              "finalgather secondary scale",
                              "finalgather scale",
                              "finalgather rebuild",
                              "caustic",
                              "caustic accuracy",
                              "caustic filter",
                              "caustic scale",
                              "\"caustic merge\"",
                              "globillum",
                              "globillum accuracy",
                              "globillum scale",
                              "\"globillum merge\"",
                              "photonvol accuracy",
                              "photon trace depth",
                              "luminance weight",
                              "luminance weight ntsc",
                              "gamma",
                              "colorclip",
                              "desaturate",
                              "dither",
                              "premultiply",
                              "frame buffer"})
    EXPECT_NE(scene::option_table().find(keyword), nullptr) << keyword;
}

}  // namespace element_tables_test
}  // namespace oriel::mi
