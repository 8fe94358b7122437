// SPDX-License-Identifier: Apache-2.0
// The facts of `oriel check` as a page to read and to print.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace oriel::app {

/// A page that is complete in itself: no scripts, no other files.
///
/// Model:   scenes are untrusted: all text from them is escaped, and the page forbids itself
///          whatever it does not hold.
/// Inputs:  facts: as `oriel check --json` prints them; picture: a PNG file's bytes, empty: `why`
///          says why there is none.
/// Checked: tests/cli/check_report_test.cpp
std::string check_html(const nlohmann::json& facts, const std::string& picture,
                       const std::string& why);

/// `text` as it may stand in HTML, in attributes as well: characters that mean something there are
/// written out, control characters become question marks.
std::string escape_html(std::string_view text);

/// RFC 4648.
std::string base64(std::string_view bytes);

}  // namespace oriel::app
