// SPDX-License-Identifier: Apache-2.0
// Names in scenes that would control a terminal.
#include "fault_test.h"

namespace oriel {
namespace escapes_test {

class EscapesTest : public FaultTest {
 protected:
  /// ESC and the other control characters that no output contains.
  static std::string controls_in(const std::string& text) {
    std::string found;
    for (const char c : text)
      if ((static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f) found += c;
    return found;
  }
};

TEST_F(EscapesTest, NamesDoNotControlTheTerminal) {
  const std::string evil =
      "x\x1b[2J\x1b]0;owned\x07\r\x7f\xc2\x9b"
      "31m";
  std::string text = small_scene();
  for (std::size_t at; (at = text.find("\"grey\"")) != std::string::npos;)
    text.replace(at, 6, "\"" + evil + "\"");
  write("scene.mi", "shader \"" + evil + "2\" \"no_" + evil + "\" ( )\n$include \"" + evil +
                        ".mi\"\ncolor texture \"" + evil + "t\" \"" + evil + ".png\"\n" + text);
  write(evil.substr(0, 3) + ".mi", "object \"" + evil + "\" ,");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check", "scene.mi"},
        {"check", "scene.mi", "--json"},
        {"render", "scene.mi", "-o", "p.png", "--samples", "1"},
        {"render", "scene.mi", "-o", "p.exr", "--samples", "1", "--json", "--cryptomatte"},
        {"explain", "scene.mi", "24", "20"},
        {"explain", "scene.mi", "24", "20", "--json"},
        {"render", evil + ".mi"},
        {"check", evil.substr(0, 3) + ".mi"},
        {evil}}) {
    const RunResult r = run(words);
    EXPECT_EQ(controls_in(r.out), "") << words[0] << r.out;
    EXPECT_EQ(controls_in(r.err), "") << words[0] << r.err;
    EXPECT_EQ((r.out + r.err).find("\xc2\x9b"), std::string::npos) << words[0];
  }
  EXPECT_NE(run({"render", evil + ".mi"}).err.find("\\x1b[2J"), std::string::npos);
}

// A name with a line feed must not look like a message of its own.
TEST_F(EscapesTest, NamesDoNotForgeMessages) {
  write("scene.mi", "color texture \"t\" \"a\nscene.mi:1:1: error: forged\"\n" + small_scene());
  const RunResult r = run({"check", "scene.mi"});
  EXPECT_EQ(r.err.find("\nscene.mi:1:1: error: forged"), std::string::npos) << r.err;
}

}  // namespace escapes_test
}  // namespace oriel
