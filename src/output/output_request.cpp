// SPDX-License-Identifier: Apache-2.0
#include "output/output_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>

#include "output/camera_output.h"

namespace oriel {
namespace {

struct Format {
  std::string_view name;       ///< name in the .mi language, or suffix
  std::string_view extension;  ///< extension for the image writers
  bool linear = false;
};

// Supported formats of the .mi language, and further suffixes of the image library.
// clang-format off
constexpr std::array<Format, 22> kFormats = {{
    {"exr", "exr", true}, {"hdr", "hdr", true}, {"png", "png"}, {"jpg", "jpg"}, {"jpeg", "jpg"},
    {"tif", "tif"}, {"tiff", "tif"}, {"tifu", "tif"}, {"tga", "tga"}, {"bmp", "bmp"},
    {"ppm", "ppm"}, {"iff", "iff"}, {"sgi", "sgi"}, {"rgb", "sgi"}, {"rla", "rla"},
    {"dpx", "dpx"}, {"fits", "fits"}, {"gif", "gif"}, {"jp2", "jp2"}, {"pgm", "pgm"},
    {"pnm", "pnm"}, {"webp", "webp"}}};
// clang-format on

/// Obsolete formats of the .mi language and their nearest replacement: EXR for data, for pictures a
/// format with the same depth and alpha.
struct Nearest {
  std::string_view format, nearest;
};
constexpr std::array<Nearest, 21> kNearest = {
    {{"pic", "png"}, {"zpic", "exr"}, {"als", "tif"},  {"rlb", "rla"},    {"map", "exr"},
     {"dds", "png"}, {"ps", "tif"},   {"eps", "tif"},  {"qntpal", "tga"}, {"qntntsc", "tga"},
     {"ct", "tif"},  {"ct16", "tif"}, {"ctfp", "exr"}, {"st", "tif"},     {"st16", "tif"},
     {"vt", "exr"},  {"wt", "exr"},   {"zt", "exr"},   {"nt", "exr"},     {"mt", "exr"},
     {"tt", "exr"}}};

/// The most precise sample format that a file type supports.
SampleFormat finest(std::string_view extension) {
  if (extension == "exr" || extension == "hdr" || extension == "tif" || extension == "fits")
    return SampleFormat::Float;
  for (const std::string_view deep :
       {"png", "sgi", "dpx", "jp2", "rla", "iff", "pgm", "ppm", "pnm"})
    if (extension == deep) return SampleFormat::U16;
  return SampleFormat::U8;
}

const Format* find_format(std::string_view name) {
  const auto at = std::find_if(kFormats.begin(), kFormats.end(),
                               [&](const Format& f) { return f.name == name; });
  return at == kFormats.end() ? nullptr : &*at;
}

std::string suffix_of(const std::string& path) {
  const std::string suffix = lower_case(std::filesystem::path(path).extension().string());
  return suffix.empty() ? suffix : suffix.substr(1);
}

/// Meaning of one word in the list of types.
struct Type {
  PixelView view;
  LayerSet layer = {};
  SampleFormat samples = SampleFormat::U8;
};

std::optional<Type> read_type(std::string word) {
  if (!word.empty() && (word[0] == '+' || word[0] == '-')) word.erase(0, 1);
  Type type{PixelView::ColorAlpha};
  const auto take = [&](std::string_view suffix, SampleFormat samples) {
    if (!word.ends_with(suffix)) return;
    word.resize(word.size() - suffix.size());
    type.samples = samples;
  };
  take("_16", SampleFormat::U16);
  take("_fp", SampleFormat::Float);
  take("_h", SampleFormat::Half);
  if (word == "rgba") return type;
  if (word == "rgb") return type.view = PixelView::Color, type;
  if (word == "rgbe") return type.view = PixelView::Color, type.samples = SampleFormat::Float, type;
  if (word == "a") return type.view = PixelView::Alpha, type;
  if (word == "s") return type.view = PixelView::Intensity, type;
  if (word == "bit") return type.view = PixelView::Bit, type.samples = SampleFormat::U8, type;
  const LayerSpec* row = layer_of_type(word);
  if (!row) return std::nullopt;
  type.view = row->view;
  type.layer = LayerSet(row->name);
  // Integers cannot represent these.
  const bool is_depth = type.view == PixelView::Depth || type.view == PixelView::Normal;
  const bool is_matte = row->need == LayerNeed::Mattes;
  if (is_matte || (is_depth && type.samples == SampleFormat::U8))
    type.samples = SampleFormat::Float;
  return type;
}

/// "fb0", "+fb12": a numbered buffer of the options block.
bool is_user_buffer(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  if (!word.starts_with("fb") || word.size() == 2) return false;
  return std::all_of(word.begin() + 2, word.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    std::string word = text.substr(at, end - at);
    std::erase(word, ' ');
    if (!word.empty()) words.push_back(lower_case(word));
    at = end + 1;
  }
  return words;
}

class RequestReader {
 public:
  RequestReader(const scene::Output& output, std::string_view statement,
                const std::vector<UserBuffer>& user_buffers, Diagnostics& diagnostics)
      : output_(output),
        statement_(statement),
        user_buffers_(user_buffers),
        diagnostics_(diagnostics) {}

  std::optional<PictureFile> read(const OutputRoots& roots) {
    std::string types = output_.types;
    const Format* format = choose_format(types);
    std::vector<std::string> words = split(types);
    const int user_buffer = words.empty() ? -1 : find_user_buffer(words.front());
    if (!leave_out_user_buffers(words)) return std::nullopt;
    const OutputPlace place = output_place(output_.file, roots);
    PictureFile file{.path = place.path};
    if (file.path.empty()) {
      fail("OR-RN-050",
           fmt::format("{} \"{}\" is outside of the scene folder and is not written", statement_,
                       output_.file),
           roots.hint);
      return std::nullopt;
    }
    if (place.moved)
      diagnostics_.note(
          "OR-RN-064", output_.where,
          fmt::format("{} \"{}\" is written to '{}'", statement_, output_.file, file.path),
          roots.hint);
    if (!format) {
      fail("OR-RN-051",
           fmt::format("unsupported file format \"{}\"; {} \"{}\" is skipped",
                       output_.format.empty() ? suffix_of(output_.file) : output_.format,
                       statement_, output_.file),
           nearest_to(
               lower_case(output_.format.empty() ? suffix_of(output_.file) : output_.format)));
      return std::nullopt;
    }
    file.format = format->extension;
    file.float_pixels = format->linear;
    file.user_buffer = user_buffer;
    file.only_user_buffer = user_buffer >= 0;
    if (!read_types(words, file)) return std::nullopt;
    for (const scene::Statement& m : output_.modifiers)
      if (m.keyword == "quality" && !m.values.empty() && !m.values[0].numbers.empty())
        file.quality = static_cast<int>(std::clamp(m.values[0].numbers[0], 1.0, 100.0));
    return file;
  }

 private:
  /// Reports precision that the file type loses.
  void report_loss(const std::string& word, const Type& type, const PictureFile& file) {
    const SampleFormat most = finest(file.format);
    const bool is_data = type.view == PixelView::Depth || type.view == PixelView::Normal ||
                         type.view == PixelView::Tag;
    const bool wants_float =
        type.samples == SampleFormat::Float || type.samples == SampleFormat::Half || is_data;
    if (most == SampleFormat::Float || (!wants_float && type.samples <= most)) return;
    diagnostics_.note("OR-RN-061", output_.where,
                      fmt::format("{} files store {} bits of \"{}\"{}", file.format,
                                  most == SampleFormat::U16 ? 16 : 8, word,
                                  wants_float ? ", and values outside of 0 to 1 are clipped" : ""),
                      "use exr to store all values");
  }

  static std::string nearest_to(std::string_view format) {
    const auto at = std::find_if(kNearest.begin(), kNearest.end(),
                                 [&](const Nearest& n) { return n.format == format; });
    if (at != kNearest.end()) return fmt::format("the nearest supported format is {}", at->nearest);
    return "use exr, hdr, png, jpg, tif, tga, bmp, ppm, iff, sgi, rla, webp, jp2 or dpx";
  }

  static std::string_view word_without_sign(std::string_view word) {
    if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
    return word;
  }

  /// Reports an error if the file is not written.
  void report(Severity severity, std::string_view code, std::string message, std::string hint) {
    diagnostics_.report(severity, code, output_.where, std::move(message), std::move(hint));
  }
  void fail(std::string_view code, std::string message, std::string hint) {
    report(Severity::Error, code, std::move(message), std::move(hint));
  }

  /// With three strings the format is explicit. With two the suffix selects it, else the single
  /// word does, which is then removed from the types.
  const Format* choose_format(std::string& types) const {
    const std::string written = lower_case(output_.format);
    if (!types.empty() && !written.empty()) return find_format(written);
    const std::string word = written.empty() ? types : written;
    if (read_type(word)) types = word;
    if (const Format* by_suffix = find_format(suffix_of(output_.file))) return by_suffix;
    return find_format(word);
  }

  /// Index of the buffer "fbN"; -1 if it does not exist.
  int find_user_buffer(std::string_view word) const {
    if (!is_user_buffer(word)) return -1;
    const std::string_view digits = word.substr(word.find_first_of("0123456789"));
    int number = -1;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const auto at = std::find_if(user_buffers_.begin(), user_buffers_.end(), [&](const auto& b) {
      return b.name.empty() && b.number == number;
    });
    return at == user_buffers_.end() ? -1 : static_cast<int>(at - user_buffers_.begin());
  }

  /// Removes user buffers from the types. The first type selects the content, and EXR files of the
  /// picture contain all buffers anyway. Returns false if nothing is left to write.
  bool leave_out_user_buffers(std::vector<std::string>& words) {
    const bool is_shown = !words.empty() && find_user_buffer(words.front()) >= 0;
    const auto user = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
      return is_user_buffer(word) && find_user_buffer(word) < 0;
    });
    const auto erase = [&] {
      std::erase_if(words, is_user_buffer);
      return is_shown || !words.empty();
    };
    if (user == words.end()) return words.empty() || erase();
    const std::string_view why = user_buffers_.empty()
                                     ? "is a buffer that only user shaders can write"
                                     : "is not a buffer of the options";
    const bool nothing_left = !is_shown && words.size() == 1;
    report(nothing_left ? Severity::Error : Severity::Warning, "OR-RN-054",
           fmt::format("\"{}\" {}; {} \"{}\" {}", *user, why, statement_, output_.file,
                       words.size() > 1 ? "is written without it" : "is skipped"),
           "to write a part of the picture, name a framebuffer after a material output such as "
           "\"diffuse_result\", or use --layers outputs");
    return erase();
  }

  bool read_types(const std::vector<std::string>& words, PictureFile& file) {
    std::optional<Type> first;
    file.layers = {};
    for (const std::string& word : words) {
      const std::optional<Type> type = read_type(word);
      if (!type) {
        report(words.size() == 1 ? Severity::Error : Severity::Warning, "OR-RN-051",
               fmt::format("unsupported picture type \"{}\"; it is ignored in {} \"{}\"", word,
                           statement_, output_.file),
               "use rgb, rgba, rgbe, a, s, bit, z, n, m, tag or coverage, optionally with _16, _h "
               "or _fp");
        continue;
      }
      file.layers |= type->layer;
      if (!first) first = type;
    }
    if (!first && !words.empty()) return false;
    const Type type = first.value_or(Type{PixelView::ColorAlpha});
    file.view = type.view;
    file.samples = type.samples;
    // A float file can store the values of an integer type exactly.
    const bool is_integer = type.samples == SampleFormat::U8 || type.samples == SampleFormat::U16;
    if (file.float_pixels && is_integer) file.samples = SampleFormat::Float;
    if (!is_integer) file.float_pixels = true;
    const bool half = file.samples == SampleFormat::Half;
    file.precision = half ? ExrPrecision::Half : ExrPrecision::Float;
    report_loss(words.empty() ? std::string{} : words.front(), type, file);
    return true;
  }

  const scene::Output& output_;
  std::string_view statement_;
  const std::vector<UserBuffer>& user_buffers_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string_view writable_format(std::string_view name) {
  const Format* format = find_format(name);
  return format ? format->extension : std::string_view{};
}

bool has_picture_suffix(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return find_format(suffix) || std::any_of(kNearest.begin(), kNearest.end(),
                                            [&](const Nearest& n) { return n.format == suffix; });
}

std::optional<PictureFile> requested_file(const scene::Output& output, std::string_view statement,
                                          const OutputRoots& roots,
                                          const std::vector<UserBuffer>& user_buffers,
                                          Diagnostics& diagnostics) {
  return RequestReader(output, statement, user_buffers, diagnostics).read(roots);
}

}  // namespace oriel
