// SPDX-License-Identifier: Apache-2.0
#include "ray_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/diagnostic.h"
#include "command.h"
#include "scene/option_table.h"
#include "suggest.h"

namespace oriel::app {
namespace {

using scene::Value;
using enum RayTarget;

struct Row {
  std::string_view name, form;
  RayTarget target;
  std::string_view statement, meaning;
};

// One row, one flag. Source: the published manual's chapter on the command line, and the options
// and camera statements that it says flags stand for.
// clang-format off
constexpr Row kRows[] = {
    // The run
    {"help", "", Program, "", "this list"},
    {"version", "", Program, "", "the program's version"},
    {"copyright", "", Program, "", "the program's licence"},
    {"verbose", "bool|int", Program, "", "messages: 0 none ... 2 errors, 3 warnings, 4 all"},
    {"v", "bool|int", Program, "", "as -verbose"},
    {"threads", "int", Program, "", "threads to use"},
    {"render", "bool", Program, "", "off: only reads"},
    {"norendering", "", Program, "", "only reads"},
    {"include_path", "string", Program, "", "folders for includes, colons between"},
    {"I", "string", Program, "", "as -include_path"},
    {"ld_path", "string", Program, "", "folders of trusted shader libraries, colons between"},
    {"L", "string", Program, "", "as -ld_path"},
    {"link", "...", Program, "", "shader libraries, up to --"},
    {"echo", "...", Program, "", "[options] FILE: writes the scene as it was read"},
    {"file_name", "string", Program, "", "the picture's file"},
    {"fn", "string", Program, "", "as -file_name"},
    {"file_type", "string", Program, "", "the picture's format"},
    {"file_dir", "string", Program, "", "folder of all pictures"},
    {"untrusted", "", Program, "", "as --untrusted of oriel render"},
    {"allow", "string", Program, "", "as --allow of oriel render"},
    {"budget", "string", Program, "", "as --budget of oriel render"},
    // The camera
    {"resolution", "int int", Camera, "resolution", "pixels"},
    {"aperture", "float", Camera, "aperture", "film width"},
    {"aspect", "float", Camera, "aspect", "width / height"},
    {"focal", "float|infinity", Camera, "focal", "focal length"},
    {"window", "int int int int", Camera, "window", "xl yl xh yh, ends included"},
    {"offset", "float float", Camera, "offset", "shift in pixels"},
    {"stereo", "bool|offset|toein|offaxis", Camera, "stereo", "a picture for each eye"},
    {"eye_separation", "float", Camera, "eye separation", "between the eyes"},
    {"parallax_distance", "float", Camera, "parallax distance", "where both see the same"},
    {"clip", "float float", Camera, "clip", "near and far plane"},
    // Options spelled in another way, or whose values the language leaves open
    {"maxdisplace", "float", Options, "max displace", "greatest displacement"},
    {"sample_lock", "bool", Options, "samplelock", "same pattern in every frame"},
    {"photon_depth", "int [int [int]]", Options, "photon trace depth", "as -photon_trace_depth"},
    {"finalgather_depth", "int [int [int [int]]]", Options, "finalgather trace depth",
     "as -finalgather_trace_depth"},
    {"finalgather_points", "int", Options, "\"finalgather points\"", "interpolated points"},
    {"finalgather_rays", "int", Options, "\"finalgather rays\"", "rays"},
    {"finalgather_mode", "string", Options, "\"finalgather mode\"", "how points are weighted"},
    {"caustic_merge", "float", Options, "\"caustic merge\"", "distance"},
    {"globillum_merge", "float", Options, "\"globillum merge\"", "distance"},
    // Speed, other methods and the machinery of another program
    {"acceleration", "bsp|bsp2|largebsp|large_bsp|grid|raycl", Nothing, "", ""},
    {"approx", "...", Nothing, "", "tessellation of every object"},
    {"approx_displace", "...", Nothing, "", "tessellation of every object"},
    {"ao", "bool", Nothing, "", ""},
    {"ao_rays", "int", Nothing, "", ""},
    {"ao_cache", "bool", Nothing, "", ""},
    {"ao_cache_density", "float", Nothing, "", ""},
    {"ao_cache_points", "int", Nothing, "", ""},
    {"ao_cache_rays", "int", Nothing, "", ""},
    {"ao_cache_max_frames", "int", Nothing, "", ""},
    {"bsp_depth", "int", Nothing, "", ""},
    {"bsp_size", "int", Nothing, "", ""},
    {"bsp_memory", "int", Nothing, "", ""},
    {"bsp_shadow", "bool", Nothing, "", ""},
    {"grid_depth", "int", Nothing, "", ""},
    {"grid_size", "int|float", Nothing, "", ""},
    {"grid_resolution", "int [int int]", Nothing, "", ""},
    {"c_compiler", "string", Nothing, "", "see oriel shader-build"},
    {"c_flags", "string", Nothing, "", "see oriel shader-build"},
    {"c_linker", "string", Nothing, "", "see oriel shader-build"},
    {"ld_flags", "string", Nothing, "", "see oriel shader-build"},
    {"ld_libs", "string", Nothing, "", "see oriel shader-build"},
    {"code", "...", Nothing, "", "scenes run no compiler: see oriel shader-build"},
    {"code_verbose", "bool", Nothing, "", ""},
    {"contour_contrast", "float float", Nothing, "", ""},
    {"diagnostic", "string [float]", Nothing, "", ""},
    {"field", "off|even|odd", Nothing, "", "half pictures"},
    {"geo_cache", "string", Nothing, "", ""},
    {"hardware", "bool|all|cg|native|fast|force", Nothing, "", ""},
    {"hosts", "...", Nothing, "", "one machine renders"},
    {"host", "string", Nothing, "", "one machine renders"},
    {"ibl", "bool", Nothing, "", ""},
    {"imgpipe", "int", Nothing, "", ""},
    {"importon", "bool", Nothing, "", ""},
    {"irradiance_particles", "bool", Nothing, "", ""},
    {"jobs", "int", Nothing, "", ""},
    {"memory", "int", Nothing, "", ""},
    {"message_level", "int", Nothing, "", ""},
    {"message_host", "bool", Nothing, "", ""},
    {"message_time", "bool", Nothing, "", ""},
    {"nice", "int", Nothing, "", ""},
    {"nomaster", "", Nothing, "", "one machine renders"},
    {"pass", "bool", Nothing, "", ""},
    {"preview_animation", "bool", Nothing, "", ""},
    {"preview_convert", "bool", Nothing, "", ""},
    {"preview_narrow", "bool", Nothing, "", ""},
    {"preview_tiles", "bool", Nothing, "", ""},
    {"priority", "int", Nothing, "", ""},
    {"progressive", "bool", Nothing, "", "pictures are always progressive"},
    {"recycle", "int", Nothing, "", ""},
    {"registry", "string [string]", Nothing, "", ""},
    {"shadowmap_bias", "float", Nothing, "", "shadows are traced"},
    {"shadowmap_motion", "bool", Nothing, "", "shadows are traced"},
    {"shadowmap_rebuild", "bool|merge", Nothing, "", "shadows are traced"},
    {"shadowmap_trace", "bool", Nothing, "", "shadows are traced"},
    {"shadowmap_window", "bool", Nothing, "", "shadows are traced"},
    {"swap_dir", "string", Nothing, "", ""},
    {"swap_limit", "int", Nothing, "", ""},
    {"texture_continue", "bool", Nothing, "", "missing textures never stop a picture"},
    {"view_hosts", "...", Nothing, "", "one machine renders"},
    {"xcolor", "string", Nothing, "", "no window is opened"},
};
// clang-format on

std::vector<RayFlag> make_flags() {
  std::vector<RayFlag> flags;
  for (const Row& row : kRows)
    flags.push_back({std::string(row.name), std::string(row.form), row.target,
                     std::string(row.statement), std::string(row.meaning), row.target != Nothing});
  for (const scene::StatementRow& row : scene::option_table().rows()) {
    if (scene::is_string_option(row) || scene::is_open(row.form)) continue;
    const std::string statement = scene::name_of(row);
    std::string name = statement;
    std::replace(name.begin(), name.end(), ' ', '_');
    const bool known = std::any_of(flags.begin(), flags.end(),
                                   [&](const RayFlag& flag) { return flag.name == name; });
    // "x y" as a value of "x": read with it.
    if (known || name == "filter_clip" || name == "finalgather_accuracy_view") continue;
    flags.push_back({std::move(name), std::string(row.form), Options, statement,
                     std::string(row.meaning), row.support == scene::Support::Effective});
  }
  std::sort(flags.begin(), flags.end(),
            [](const RayFlag& a, const RayFlag& b) { return a.name < b.name; });
  return flags;
}

std::vector<std::string> flag_names() {
  std::vector<std::string> names;
  for (const RayFlag& flag : ray_flags()) names.push_back(flag.name);
  return names;
}

const RayFlag& find_flag(const std::string& name) {
  std::vector<const RayFlag*> begin_so;
  for (const RayFlag& flag : ray_flags()) {
    if (flag.name == name) return flag;
    if (flag.name.starts_with(name)) begin_so.push_back(&flag);
  }
  if (begin_so.size() == 1) return *begin_so.front();
  if (begin_so.empty()) {
    const std::vector<std::string> names = flag_names();
    const std::string near = nearest_name(name, names);
    throw UsageError(fmt::format("unknown flag -{}{}", name,
                                 near.empty() ? "" : fmt::format("; did you mean -{}?", near)));
  }
  std::string choices;
  for (const RayFlag* flag : begin_so) choices += " -" + flag->name;
  throw UsageError(fmt::format("-{} is ambiguous:{}", name, choices));
}

bool read_number(const std::string& word, double& number) {
  const char* begin = word.c_str() + (word.starts_with('+') ? 1 : 0);
  const char* end = word.c_str() + word.size();
  const auto [at, error] = std::from_chars(begin, end, number);
  // "infinity" is a word here.
  return error == std::errc() && at == end && begin != end && std::isfinite(number);
}

bool is_flag(const std::string& word) {
  double number = 0;
  return word.size() > 1 && word[0] == '-' && !read_number(word, number);
}

/// Strings of the language stand in quotes, words do not.
Value typed(const std::string& word) {
  Value value;
  double number = 0;
  if (word == "on" || word == "true" || word == "off" || word == "false") {
    value.kind = Value::Kind::Boolean;
    value.boolean = word == "on" || word == "true";
  } else if (read_number(word, number)) {
    value.kind = Value::Kind::Numbers;
    value.numbers = {number};
    value.integral = word.find_first_of(".eE") == std::string::npos;
  } else {
    value.kind = Value::Kind::Text;
    value.text = word;
  }
  return value;
}

bool is_word_of(std::string_view form, std::string_view word) {
  for (std::size_t at = form.find(word); at != form.npos; at = form.find(word, at + 1)) {
    const auto bound = [&](std::size_t i) {
      return i >= form.size() || std::string_view(" |[]").find(form[i]) != form.npos;
    };
    if ((at == 0 || bound(at - 1)) && bound(at + word.size())) return true;
  }
  return false;
}

std::vector<std::string> words_of_form(const std::string& form) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = form.find_first_not_of(" |[]", at)) != form.npos;) {
    const std::size_t end = std::min(form.find_first_of(" |[]", at), form.size());
    words.push_back(form.substr(at, end - at));
    at = end;
  }
  return words;
}

class LineReader {
 public:
  explicit LineReader(std::span<const std::string> arguments) : rest_(arguments) {}

  RayLine read() {
    RayLine line;
    while (!rest_.empty()) {
      const std::string word = rest_.front();
      rest_ = rest_.subspan(1);
      if (is_flag(word))
        line.calls.push_back(read_call(find_flag(word.substr(word.starts_with("--") ? 2 : 1))));
      else
        line.scenes.push_back(word);
    }
    return line;
  }

 private:
  RayCall read_call(const RayFlag& flag) {
    RayCall call{&flag, flag.statement, {}, {}};
    if (flag.name == "echo") return read_echo(call), call;
    if (flag.form == "...") return read_to_end(call), call;
    std::string form = flag.form;
    lengthen_keyword(call, form);
    if (take(call, form)) return call;
    throw UsageError(
        fmt::format("-{}: expected {}{}", flag.name, form.empty() ? "no value" : form,
                    rest_.empty() ? "" : suggestion(rest_.front(), words_of_form(form))));
  }

  /// "filter clip", "finalgather accuracy view": statements of their own in the language.
  void lengthen_keyword(RayCall& call, std::string& form) {
    if (call.flag->target != Options || rest_.empty()) return;
    const std::string longer = call.keyword + " " + rest_.front();
    const scene::StatementRow* row = scene::option_table().find(longer);
    if (!row) return;
    call.keyword = longer;
    form = row->form;
    rest_ = rest_.subspan(1);
  }

  /// As many values as fit.
  bool take(RayCall& call, const std::string& form) {
    constexpr std::size_t kMaxValues = 8;
    std::vector<Value> values;
    for (const std::string& word : rest_.first(std::min(rest_.size(), kMaxValues))) {
      if (is_flag(word)) break;
      values.push_back(typed(word));
    }
    for (;; values.pop_back()) {
      std::vector<scene::FormItem> items;
      items.reserve(values.size());
      for (const Value& v : values)
        items.push_back(
            {.value = &v, .number = v.numbers.empty() ? 0 : v.numbers[0], .text = v.text});
      if (scene::fits_form(form, items)) break;
      if (values.empty()) return false;
    }
    for (Value& v : values) v.bare = v.kind == Value::Kind::Text && is_word_of(form, v.text);
    for (std::size_t i = 0; i < values.size(); ++i) call.words.push_back(rest_[i]);
    rest_ = rest_.subspan(values.size());
    call.values = std::move(values);
    return true;
  }

  void read_to_end(RayCall& call) {
    while (!rest_.empty() && rest_.front() != "--") {
      call.words.push_back(rest_.front());
      rest_ = rest_.subspan(1);
    }
    if (rest_.empty())
      throw UsageError(fmt::format("-{}: the list of values must end with --", call.flag->name));
    rest_ = rest_.subspan(1);
  }

  /// Options, the file, options. The text that is written is the same for all of them.
  void read_echo(RayCall& call) {
    static constexpr std::array<std::string_view, 14> kOptions = {
        "ascii",  "binary",  "norm",       "nonorm",   "comment", "nocomment",   "compress",
        "source", "explode", "explodeall", "includes", "approx",  "incremental", "append"};
    const auto skip = [&] {
      while (!rest_.empty() &&
             std::find(kOptions.begin(), kOptions.end(), rest_.front()) != kOptions.end())
        rest_ = rest_.subspan(1);
    };
    skip();
    if (rest_.empty() || is_flag(rest_.front())) throw UsageError("-echo: expected a file name");
    call.words.push_back(rest_.front());
    rest_ = rest_.subspan(1);
    skip();
  }

  std::span<const std::string> rest_;
};

}  // namespace

const std::vector<RayFlag>& ray_flags() {
  static const std::vector<RayFlag> flags = make_flags();
  return flags;
}

RayLine read_ray_line(std::span<const std::string> arguments) {
  return LineReader(arguments).read();
}

}  // namespace oriel::app
