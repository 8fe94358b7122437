// SPDX-License-Identifier: Apache-2.0
#include "check_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace oriel::app {
namespace {

using nlohmann::json;

/// Rows of a table before the rest is only counted: a broken scene may hold millions.
constexpr std::size_t kMaxRows = 2000;

constexpr std::string_view kStyle = R"(
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; margin: 2em auto;
       max-width: 62em; padding: 0 1em; }
h1 { font-size: 1.6em; margin-bottom: .2em; } h2 { font-size: 1.2em; margin-top: 2em; }
h3 { font-size: 1em; margin: 1.4em 0 .3em; }
table { border-collapse: collapse; width: 100%; font-size: .92em; }
th, td { text-align: left; vertical-align: top; padding: .3em .6em; border-bottom: 1px solid #ddd;
         overflow-wrap: anywhere; }
th { color: #666; font-weight: 600; }
code { font: .95em ui-monospace, monospace; }
.picture { max-width: 100%; border: 1px solid #ddd; }
.exact, .native, .found, .phenomenon { color: #1a7f37; } .approximated, .guessed { color: #9a6700; }
.ignored, .unknown, .missing, .error { color: #b3261e; } .warning { color: #9a6700; }
.muted { color: #777; }
@media print { body { margin: 0; max-width: none; } h2, h3, tr { break-inside: avoid; } }
)";

std::string text(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return {};
  return escape_html(found->is_string() ? found->get<std::string>() : found->dump());
}

std::string place(const json& entry) {
  if (!entry.contains("line")) return {};
  return fmt::format("<code>{}:{}</code>", text(entry, "file"), text(entry, "line"));
}

/// A word that is also the class of its colour; only our own words come here.
std::string mark(const std::string& word) {
  return fmt::format("<span class=\"{0}\">{0}</span>", escape_html(word));
}

struct Table {
  std::string html;
  std::size_t rows = 0;

  explicit Table(const std::vector<std::string>& heads) {
    html = "<table><tr>";
    for (const std::string& head : heads) html += "<th>" + escape_html(head) + "</th>";
    html += "</tr>\n";
  }
  /// Cells are HTML.
  void row(const std::vector<std::string>& cells) {
    if (++rows > kMaxRows) return;
    html += "<tr>";
    for (const std::string& cell : cells) html += "<td>" + cell + "</td>";
    html += "</tr>\n";
  }
  std::string end() const {
    const std::string more =
        rows > kMaxRows ? fmt::format("<p class=\"muted\">and {} more</p>\n", rows - kMaxRows)
                        : std::string();
    return html + "</table>\n" + more;
  }
};

const json& list_of(const json& object, const char* key) {
  static const json kEmpty = json::array();
  const auto found = object.find(key);
  return found == object.end() ? kEmpty : *found;
}

std::size_t count_if(const json& list, const char* key, const json& value) {
  return static_cast<std::size_t>(std::count_if(list.begin(), list.end(), [&](const json& entry) {
    return entry.value(key, json()) == value;
  }));
}

std::string summary(const json& facts) {
  const json& shaders = list_of(facts, "used_shaders");
  Table table({"", "", ""});
  std::string words;
  for (const char* status :
       {"exact", "approximated", "ignored", "native", "phenomenon", "guessed", "unknown"})
    if (const std::size_t n = count_if(shaders, "status", status); n > 0)
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", n, mark(status));
  table.row({"shaders", std::to_string(shaders.size()), words});

  std::map<std::string, std::size_t> parameters;
  for (const json& shader : shaders)
    for (const json& p : shader["parameters"]) ++parameters[p["support"]];
  words.clear();
  std::size_t all = 0;
  for (const auto& [support, n] : parameters)
    all += n, words += fmt::format("{}{} {}", words.empty() ? "" : ", ", n, mark(support));
  table.row({"parameters that are written", std::to_string(all), words});

  const json options = facts.value("options", json::object());
  const json without = options.value("without_effect", json::object());
  const std::size_t not_yet = list_of(without, "not_yet").size();
  const std::size_t kept = list_of(without, "kept").size();
  const std::size_t unknown = list_of(options, "unknown_strings").size();
  table.row({"statements of the options", text(options, "statements"),
             fmt::format("{} without effect, {} only kept, {} unknown", not_yet, kept, unknown)});
  const json& textures = list_of(facts, "textures");
  table.row({"texture files", std::to_string(textures.size()),
             fmt::format("{} missing", count_if(textures, "state", "missing"))});
  const json& libraries = list_of(facts, "libraries");
  table.row({"C libraries", std::to_string(libraries.size()),
             fmt::format("{} found and trusted", count_if(libraries, "found", true))});
  const json& diagnostics = list_of(facts, "diagnostics");
  table.row({"messages", std::to_string(diagnostics.size()),
             fmt::format("{} errors, {} warnings", count_if(diagnostics, "severity", "error"),
                         count_if(diagnostics, "severity", "warning"))});
  return "<h2>Summary</h2>\n" + table.end();
}

std::string scene_words(const json& facts) {
  if (!facts.contains("picture")) return "<p class=\"error\">It cannot be rendered.</p>\n";
  const json &p = facts["picture"], &g = facts["geometry"];
  return fmt::format(
      "<p>{} frames of {} x {} pixels; {} objects, {} instances, {} triangles, {} lights; indirect "
      "light: {}.</p>\n",
      text(facts, "frames"), text(p, "width"), text(p, "height"), text(g, "objects"),
      text(g, "instances"), text(g, "triangles"), text(g, "lights"), text(p, "indirect_light"));
}

/// What to do where a parameter is not followed exactly.
const char* remedy(const std::string& support) {
  if (support == "approximated") return "Compare the picture with an old one.";
  if (support == "ignored") return "Remove it, or use other parameters for its effect.";
  return support == "unknown" ? "Correct the name or leave it out." : "";
}

std::string shader(const json& s) {
  std::string html = fmt::format("<h3><code>{}</code> {}, {} calls {}</h3>\n", text(s, "type"),
                                 mark(s.value("status", "")), text(s, "calls"), place(s));
  if (s.contains("doc")) html += "<p>" + text(s, "doc") + "</p>\n";
  if (s.contains("note")) html += "<p class=\"muted\">" + text(s, "note") + "</p>\n";
  const json& parameters = list_of(s, "parameters");
  if (parameters.empty()) return html;
  Table table({"parameter", "", "value", "written", "place", "reason and remedy"});
  for (const json& p : parameters) {
    const std::string support = p.value("support", "");
    std::string why = text(p, "reason");
    if (const std::string act = remedy(support); !act.empty())
      why += (why.empty() ? "" : " ") + act;
    table.row({"<code>" + text(p, "name") + "</code>", mark(support),
               "<code>" + text(p, "value") + "</code>", text(p, "count"), place(p), why});
  }
  return html + table.end();
}

/// Shaders that need a look first.
std::string shaders(const json& facts) {
  const std::vector<std::string> order = {"unknown", "guessed",    "ignored", "approximated",
                                          "native",  "phenomenon", "exact"};
  std::string html = "<h2>Shaders</h2>\n";
  for (const std::string& status : order)
    for (const json& s : list_of(facts, "used_shaders"))
      if (s.value("status", "") == status) html += shader(s);
  return html;
}

std::string files(const json& facts) {
  std::string html;
  if (const json& textures = list_of(facts, "textures"); !textures.empty()) {
    Table table({"texture", "file", "", "place"});
    for (const json& t : textures)
      table.row({"<code>" + text(t, "name") + "</code>", "<code>" + text(t, "written") + "</code>",
                 mark(t.value("state", "")), place(t)});
    html += "<h2>Textures</h2>\n" + table.end();
  }
  if (const json& libraries = list_of(facts, "libraries"); !libraries.empty()) {
    Table table({"linked", "", "path", "place"});
    for (const json& l : libraries)
      table.row({"<code>" + text(l, "written") + "</code>",
                 mark(l.value("found", false) ? "found" : "missing"),
                 "<code>" + text(l, "path") + "</code>", place(l)});
    html +=
        "<h2>C libraries</h2>\n<p>Libraries are loaded from folders that you trust alone: "
        "<code>--shader-path</code> or the variable <code>ORIEL_SHADER_PATH</code> names "
        "them.</p>\n" +
        table.end();
  }
  return html;
}

std::string statements(const json& facts) {
  const json options = facts.value("options", json::object());
  const json without = options.value("without_effect", json::object());
  Table table({"statement", "", "place"});
  const std::map<std::string, std::string> meanings = {
      {"not_yet", "nothing acts on it"},
      {"kept", "kept and written back, without effect"},
      {"harmless", "the picture does not depend on it"}};
  for (const auto& [key, meaning] : meanings)
    for (const json& w : list_of(without, key.c_str()))
      table.row({"<code>" + text(w, "keyword") + "</code>", meaning, place(w)});
  for (const json& name : list_of(options, "unknown_strings"))
    table.row({"<code>" + escape_html(name.get<std::string>()) + "</code>", mark("unknown"), ""});
  for (const auto& [name, n] : facts.value("kept_without_effect", json::object()).items())
    table.row({"<code>" + escape_html(name) + "</code>",
               fmt::format("kept and written back, without effect; {} times", n.get<int>()), ""});
  return table.rows == 0 ? std::string()
                         : "<h2>Statements that do not act on the picture</h2>\n" + table.end();
}

std::string messages(const json& facts) {
  const json& list = list_of(facts, "diagnostics");
  if (list.empty()) return {};
  Table table({"", "message", "what to do", "place"});
  for (const json& d : list)
    table.row({mark(d.value("severity", "")),
               text(d, "message") + " <span class=\"muted\">" + text(d, "code") + "</span>",
               text(d, "hint"), place(d)});
  return "<h2>Messages</h2>\n" + table.end();
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default: {
        const auto byte = static_cast<unsigned char>(c);
        const bool control = byte < 0x20 && c != '\n' && c != '\t';
        out += control || byte == 0x7f ? '?' : c;
      }
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= n ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string check_html(const json& facts, const std::string& picture, const std::string& why) {
  const std::string name = text(facts, "scene");
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'\">\n<title>{0}: Oriel report</title>\n"
      "<style>{1}</style></head><body>\n<h1>{0}</h1>\n",
      name, kStyle);
  html += scene_words(facts);
  if (picture.empty())
    html += fmt::format("<p class=\"error\">No picture: {}</p>\n", escape_html(why));
  else
    html += fmt::format(
        "<p><img class=\"picture\" alt=\"quick rendering of the scene\" "
        "src=\"data:image/png;base64,{}\"></p>\n<p class=\"muted\">A quick rendering by path "
        "tracing, with few samples.</p>\n",
        base64(picture));
  html += summary(facts) + shaders(facts) + files(facts) + statements(facts) + messages(facts);
  return html + "</body></html>\n";
}

}  // namespace oriel::app
