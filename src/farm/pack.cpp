// SPDX-License-Identifier: Apache-2.0
#include "farm/pack.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <system_error>

#include "base/durable_file.h"
#include "farm/pack_layout.h"
#include "farm/pack_text.h"
#include "mi/source.h"
#include "scene/asset_path.h"

namespace oriel::farm {
namespace {

namespace fs = std::filesystem;
using Kind = FileReference::Kind;

std::runtime_error system_fault(const std::string& what) {
  return std::runtime_error(fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

std::uint64_t copy_content(OpenFile& in, const Descriptor& out, const fs::path& to);

/// Copies a regular file to a new file, with its modification time, by which checkpoints recognise
/// large files.
std::uint64_t copy_file(const std::string& from, const fs::path& to) {
  OpenFile in = open_regular(from);
  if (!in) throw std::runtime_error(fmt::format("cannot read '{}': {}", from, in.reason()));
  fs::create_directories(to.parent_path());
  const Descriptor out(
      ::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (out.get() < 0) throw system_fault(fmt::format("cannot write '{}'", to.string()));
  const std::uint64_t copied = copy_content(in, out, to);
  struct stat about {};
  if (::fstat(in.descriptor(), &about) == 0) {
    const timespec times[2] = {about.st_atim, about.st_mtim};
    ::futimens(out.get(), times);
  }
  return copied;
}

std::uint64_t copy_content(OpenFile& in, const Descriptor& out, const fs::path& to) {
  // The kernel shares blocks where the file system can.
  std::uint64_t copied = 0;
  for (;;) {
    const ssize_t n =
        ::copy_file_range(in.descriptor(), nullptr, out.get(), nullptr, std::size_t{1} << 30, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && copied == 0) break;  // unsupported here
    if (n < 0) throw system_fault(fmt::format("cannot write '{}'", to.string()));
    if (n == 0) return copied;
    copied += static_cast<std::uint64_t>(n);
  }
  for (;;) {
    const std::string block = in.read(std::size_t{1} << 20);
    if (block.empty()) return copied;
    for (std::size_t at = 0; at < block.size();) {
      const ssize_t n = ::write(out.get(), block.data() + at, block.size() - at);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) throw system_fault(fmt::format("cannot write '{}'", to.string()));
      at += static_cast<std::size_t>(n);
    }
    copied += block.size();
  }
}

/// The name of the TILT file of an IES profile, without folders; empty if it has none.
std::string tilt_file(const std::string& profile) {
  constexpr std::size_t kHead = std::size_t{1} << 16;
  const std::string text = open_regular(profile).read(kHead);
  const std::size_t at = text.find("TILT=");
  if (at == std::string::npos) return {};
  std::string name = text.substr(at + 5, text.find_first_of("\r\n", at) - at - 5);
  name.erase(name.find_last_not_of(" \t") + 1);
  return name == "NONE" || name == "INCLUDE" ? "" : name.substr(name.find_last_of("/\\:") + 1);
}

/// A folder that takes its final name when it is complete, and is removed otherwise.
class FolderInProgress {
 public:
  explicit FolderInProgress(const std::string& folder) : target_(fs::absolute(folder)) {
    if (target_.filename().empty()) target_ = target_.parent_path();
    std::error_code error;
    if (fs::exists(fs::symlink_status(target_, error)) &&
        !(fs::is_directory(fs::symlink_status(target_, error)) && fs::is_empty(target_, error)))
      throw std::runtime_error(fmt::format(
          "'{}' exists and is not an empty folder; remove it or choose another name", folder));
    if (fs::create_directories(target_.parent_path(), error); error)
      throw std::runtime_error(
          fmt::format("cannot create '{}': {}", target_.parent_path().string(), error.message()));
    std::string name =
        (target_.parent_path() / ("." + target_.filename().string() + "-XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr)
      throw system_fault(fmt::format("cannot create a folder beside '{}'", folder));
    path_ = name;
    // mkdtemp() permits the owner only; other users render on other machines.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::chmod(path_.c_str(), 0777 & ~mask);
  }
  ~FolderInProgress() {
    std::error_code ignored;
    if (!done_) fs::remove_all(path_, ignored);
  }
  FolderInProgress(const FolderInProgress&) = delete;
  FolderInProgress& operator=(const FolderInProgress&) = delete;

  const fs::path& path() const { return path_; }
  void finish() {
    if (::rename(path_.c_str(), target_.c_str()) != 0)
      throw system_fault(fmt::format("cannot write '{}'", target_.string()));
    done_ = true;
  }

 private:
  fs::path target_, path_;
  bool done_ = false;
};

class Packer {
 public:
  Packer(const SceneSource& source, Diagnostics& diagnostics)
      : source_(source), diagnostics_(diagnostics), layout_(source.path) {}

  PackReport run(const std::string& folder, bool keep_missing) {
    files_ = find_files(source_, diagnostics_);
    report_.frames = files_.frames;
    report_.scene = layout_.place(source_.path);
    texts_[report_.scene] = source_.path;
    for (const FileReference& reference : files_.references) {
      place(reference);
      if (!reference.path.empty() && reference.kind != Kind::Library)
        by_text_[packed_name(diagnostics_.file(reference.where.file))].push_back(&reference);
    }
    if (!report_.missing.empty() && !keep_missing) return std::move(report_);
    FolderInProgress out(folder);
    for (const auto& [path, name] : layout_.places()) {
      const fs::path target = out.path() / name;
      report_.bytes +=
          texts_.contains(name) ? write_text(name, target) : copy_file(path.string(), target);
      ++report_.files;
    }
    write_manifest(out.path());
    out.finish();
    return std::move(report_);
  }

 private:
  void place(const FileReference& r) {
    if (r.path.empty()) {
      report_.missing.push_back(r);
      return;
    }
    if (r.kind == Kind::Library) {
      layout_.place_library(r.path);
      report_.has_libraries = true;
      return;
    }
    const std::string name = packed_name(r.path);
    if (r.kind == Kind::Include || r.kind == Kind::Placeholder) texts_[name] = r.path;
    const fs::path folder = fs::path(r.path).parent_path();
    if (r.kind == Kind::Profile) {
      const std::string tilt = tilt_file(r.path);
      if (!tilt.empty() && open_regular((folder / tilt).string())) layout_.place(folder / tilt);
    }
    if (r.kind == Kind::Code) {
      report_.has_code = true;
      std::error_code error;
      for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
        if (entry.path().extension().string().starts_with(".h")) layout_.place(entry.path());
    }
  }

  const std::string& packed_name(const std::string& path) {
    std::string& name = names_[path];
    if (name.empty()) name = layout_.place(path);
    return name;
  }

  /// The name of a file in the text `text`, relative to the folder in which Oriel looks for it.
  static std::string name_in(const FileReference& r, const std::string& text,
                             const std::string& file) {
    const bool below_scene = r.kind == Kind::Map || r.kind == Kind::Code || r.kind == Kind::String;
    const fs::path folder = below_scene ? fs::path() : fs::path(text).parent_path();
    return fs::path(file).lexically_relative(folder.empty() ? "." : folder).generic_string();
  }

  std::uint64_t write_text(const std::string& name, const fs::path& target) {
    const std::string& path = texts_.at(name);
    std::vector<NewName> names;
    for (const FileReference* r : by_text_[name]) {
      std::string wanted = name_in(*r, name, packed_name(r->path));
      if (fs::path(r->written).lexically_normal() != wanted)
        names.push_back({r, std::move(wanted)});
    }
    if (names.empty()) return copy_file(path, target);
    OpenFile file = open_regular(path);
    mi::SourceFault fault;
    const auto source = mi::Source::load(file, path, {}, fault);
    if (!source) throw std::runtime_error(fmt::format("cannot read '{}': {}", path, fault.reason));
    fs::create_directories(target.parent_path());
    std::string text;
    try {
      text = with_names({source->begin(), source->size()}, source->newline(), names);
    } catch (const std::runtime_error& e) {
      throw std::runtime_error(fmt::format("cannot pack '{}': {}", path, e.what()));
    }
    write_durably(target.string(), text);
    return text.size();
  }

  void write_manifest(const fs::path& folder) const {
    nlohmann::json files = nlohmann::json::array();
    for (const auto& place : layout_.places()) files.push_back(place.second);
    std::sort(files.begin(), files.end());
    const nlohmann::json manifest = {
        {"oriel", ORIEL_VERSION},   {"scene", report_.scene},
        {"frames", report_.frames}, {"libraries", report_.has_libraries},
        {"code", report_.has_code}, {"files", files}};
    write_durably((folder / kPackManifest).string(),
                  manifest.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }

  const SceneSource& source_;
  Diagnostics& diagnostics_;
  PackLayout layout_;
  SceneFiles files_;
  PackReport report_;
  std::map<std::string, std::string> names_;  // packed names by path as found
  std::map<std::string, std::string> texts_;  // sources by packed name
  std::map<std::string, std::vector<const FileReference*>> by_text_;  // by packed name
};

}  // namespace

PackReport pack_scene(const SceneSource& source, const std::string& folder, bool keep_missing,
                      Diagnostics& diagnostics) {
  return Packer(source, diagnostics).run(folder, keep_missing);
}

}  // namespace oriel::farm
