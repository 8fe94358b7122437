// SPDX-License-Identifier: Apache-2.0
// oriel profile.
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace oriel {
namespace profile_test {

using nlohmann::json;

class ProfileProgram : public ProgramTest {};

const char* const kLamp =
    "IESNA:LM-63-2002\n[LUMINAIRE] A & B <lamp>\nTILT=NONE\n2 300 1 3 1 1 2 0 0 0 1 1 40\n"
    "0 90 180\n0\n100 100 100\n";

// acceptance: H6
TEST_F(ProfileProgram, ReportsFluxPeakAndWidths) {
  write("lamp.ies", kLamp);
  const RunResult r = run({"profile", "lamp.ies", "--json"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const json j = json::parse(r.out);
  EXPECT_EQ(j["version"], "LM-63-2002");
  EXPECT_EQ(j["lamp_lumens"], 600);
  EXPECT_NEAR(j["flux"].get<double>(), 1256.637, .01);
  EXPECT_EQ(j["peak"], 100);
  EXPECT_NEAR(j["beam"][0].get<double>(), 360, .3);
  const RunResult table = run({"profile", "lamp.ies"});
  EXPECT_NE(table.out.find("1256.6 lm, 209.4 % of the lamps'"), std::string::npos) << table.out;
}

TEST_F(ProfileProgram, DrawsAPolarPlot) {
  write("lamp.ies", kLamp);
  ASSERT_EQ(run({"profile", "lamp.ies", "-o", "plot.svg"}).exit_code, 0);
  const std::string svg = text_of(file("plot.svg"));
  EXPECT_EQ(svg.substr(0, 4), "<svg");
  EXPECT_NE(svg.find("A &amp; B &lt;lamp>"), std::string::npos);
  EXPECT_NE(svg.find("100 cd"), std::string::npos);
  EXPECT_EQ(run({"profile", "lamp.ies", "-o", "plot.bmp"}).exit_code, 2);
}

TEST_F(ProfileProgram, ABadFileIsOneLineWithPlaceAndAdvice) {
  write("bad.ies", "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 40\n0 180\n0\n100 -5\n");
  const RunResult r = run({"profile", "bad.ies"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(r.error_lines(), 1);
  EXPECT_NE(r.err.find("bad.ies:6: negative intensity"), std::string::npos) << r.err;
  EXPECT_EQ(run({"profile", "none.ies"}).exit_code, 1);
}

}  // namespace profile_test
}  // namespace oriel
