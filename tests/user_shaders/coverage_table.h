// SPDX-License-Identifier: Apache-2.0
// Test support: supported parts of the mental ray shader interface, as tables of the documentation.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace oriel {
namespace functions_test {

struct Offered {
  std::string name, header, kind, since;

  bool is_of_mental_ray() const { return since != "oriel"; }
  std::string group() const {
    const bool makes = header.rfind("geoshader", 0) == 0 || header == "shader/declare.h" ||
                       header == "shader/elements.h";
    return makes ? "geometry" : "shader";
  }
};

/// functions.txt
inline std::vector<Offered> offered_functions(const std::filesystem::path& headers) {
  std::vector<Offered> all;
  std::ifstream file(headers / "functions.txt");
  for (std::string line; std::getline(file, line);) {
    Offered one;
    std::string priority;
    if (line.empty() || line[0] == '#') continue;
    std::istringstream(line) >> one.name >> one.header >> one.kind >> priority >> one.since;
    all.push_back(one);
  }
  return all;
}

/// A line of coverage.txt.
struct CoverageLine {
  std::string text;  ///< the whole line, unparsed
  std::string group, name, reason;

  bool names() const { return !name.empty(); }
  bool declared() const { return group == "declared"; }
};

inline std::vector<CoverageLine> coverage_lines(const std::filesystem::path& headers) {
  std::vector<CoverageLine> all;
  std::ifstream file(headers / "coverage.txt");
  for (CoverageLine line; std::getline(file, line.text); line = {}) {
    if (!line.text.empty() && line.text[0] != '#') {
      std::istringstream words(line.text);
      words >> line.group >> line.name >> std::ws;
      std::getline(words, line.reason);
    }
    all.push_back(line);
  }
  return all;
}

/// A line of names/names.txt.
struct NameLine {
  std::string kind, name, more;  ///< more: the member, or "declared" where it has no effect
};

inline std::vector<NameLine> name_lines() {
  std::vector<NameLine> all;
  std::ifstream file(ORIEL_SOURCE_DIR "/tests/user_shaders/names/names.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    NameLine& one = all.emplace_back();
    std::istringstream(line) >> one.kind >> one.name >> one.more;
    std::replace(one.name.begin(), one.name.end(), '@', ' ');
  }
  return all;
}

/// Rows of the names beside functions, for the table of counts.
inline std::string counts_of_names() {
  static const std::pair<const char*, const char*> kKinds[] = {
      {"type", "types"},
      {"opaque", "types that only pointers are used of"},
      {"constant", "constants"},
      {"member", "members of structures"},
      {"class", "classes of C++, by both names of their namespace"}};
  const std::vector<NameLine> lines = name_lines();
  std::string text;
  for (const auto& [kind, title] : kKinds) {
    int works = 0, declared = 0;
    for (const NameLine& line : lines)
      if (line.kind == kind) ++(line.more == "declared" ? declared : works);
    text += std::string("| ") + title + " | " + std::to_string(works) + " | " +
            std::to_string(declared) + " | 0 |\n";
  }
  return text;
}

/// Each name with one of three answers.
class CoverageTable {
 public:
  explicit CoverageTable(const std::filesystem::path& headers)
      : offered_(offered_functions(headers)), lines_(coverage_lines(headers)) {
    for (const CoverageLine& line : lines_)
      if (line.names()) rows_[line.name] = {line.declared() ? 1 : 2, line.group, line.reason};
    for (const Offered& one : offered_) {
      if (!one.is_of_mental_ray()) continue;
      Row& row = rows_[one.name];
      if (row.answer == 2) superfluous_.push_back(one.name);
      if (row.answer != 1) row = {0, "", ""};
      row.group = one.group();
    }
    for (const auto& [name, row] : rows_)
      if (row.group == "declared") not_offered_.push_back(name);
  }

  /// Names that coverage.txt calls absent, and that are offered.
  const std::vector<std::string>& superfluous() const { return superfluous_; }
  /// Names that coverage.txt calls declared, and that are not offered.
  const std::vector<std::string>& not_offered() const { return not_offered_; }
  const std::vector<CoverageLine>& lines() const { return lines_; }

  /// Writes coverage.txt without lines of names that are offered by now.
  void prune(const std::filesystem::path& headers) const {
    std::string text;
    for (const CoverageLine& line : lines_)
      if (std::find(superfluous_.begin(), superfluous_.end(), line.name) == superfluous_.end())
        text += line.text + "\n";
    std::ofstream(headers / "coverage.txt") << text;
  }

  std::string names() const {
    std::string text =
        "\n## All names\n\n"
        "Names of mental ray's function index and of shaders in use. Functions that are declared "
        "and "
        "have no\neffect return miFALSE, NULL or 0. A name that ends in `*` is a family.\n\n"
        "| name | works | declared, no effect | not offered | reason |\n|---|---|---|---|---|\n";
    for (const auto& [name, row] : rows_) {
      text += "| `" + name + "` |";
      for (int answer = 0; answer < 3; ++answer) text += row.answer == answer ? " x |" : " |";
      text += row.reason.empty() ? " |\n" : " " + row.reason + " |\n";
    }
    return text;
  }

  /// How many names have which answer.
  std::string counts() const {
    static const struct {
      const char *group, *title;
    } kGroups[] = {{"shader", "functions for shaders of all kinds"},
                   {"geometry", "functions for geometry shaders"},
                   {"program", "functions for programs that embed mental ray, and exporters"}};
    std::string text = "| group | works | declared, no effect | not offered |\n|---|---|---|---|\n";
    for (const auto& [group, title] : kGroups) {
      text += std::string("| ") + title + " |";
      for (int answer = 0; answer < 3; ++answer)
        text += " " +
                std::to_string(std::count_if(rows_.begin(), rows_.end(),
                                             [&](const auto& r) {
                                               return r.second.group == group &&
                                                      r.second.answer == answer;
                                             })) +
                " |";
      text += "\n";
    }
    return text + counts_of_names();
  }

 private:
  struct Row {
    int answer = 0;  ///< 0 works, 1 declared, 2 not offered
    std::string group, reason;
  };
  std::vector<Offered> offered_;
  std::vector<CoverageLine> lines_;
  std::map<std::string, Row> rows_;
  std::vector<std::string> superfluous_, not_offered_;
};

}  // namespace functions_test
}  // namespace oriel
