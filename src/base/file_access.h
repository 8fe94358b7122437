// SPDX-License-Identifier: Apache-2.0
// Policy for files that scenes and models name: which of them may be read, and how they are opened.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.h"

namespace oriel {

/// Whether `path` is `folder` or below it. Both must be canonical; false if `folder` is empty.
/// Checked: FileAccess.PathsBelowAFolderShareWholeNames
bool lies_below(std::string_view path, std::string_view folder);

/// Whether the name has the form scheme://rest with a scheme of at least two characters.
/// Checked: FileAccess.UrlsAreNotOpened
bool is_url(std::string_view name);

/// A regular file, opened for reading; closed by the destructor.
class OpenFile {
 public:
  enum class Fault : std::uint8_t {
    None,
    Missing,     ///< does not exist or is not readable
    NotRegular,  ///< a folder, pipe, device or socket, or a file made by the kernel (/proc)
    Url,
    Outside,  ///< outside of the folders that may be read
  };

  OpenFile() = default;
  static OpenFile failed(Fault fault, std::string reason, std::string hint = {});
  /// A file that another process opened as a regular one; `path` is its name without links.
  static OpenFile received(Descriptor descriptor, std::string path);

  explicit operator bool() const { return fault_ == Fault::None; }
  Fault fault() const { return fault_; }
  /// Whether the file was refused by the policy rather than being unusable.
  bool is_refused() const { return fault_ == Fault::Outside || fault_ == Fault::Url; }
  const std::string& reason() const { return reason_; }  ///< for messages; empty without a fault
  /// Option that permits the file; empty if there is none.
  const std::string& hint() const { return hint_; }

  int descriptor() const { return descriptor_.get(); }
  std::uint64_t size() const { return size_; }
  /// The path without symbolic links, for libraries that open files themselves.
  const std::string& path() const { return path_; }
  /// A path that opens this very file, whatever happens to its name; valid as long as this object.
  std::string descriptor_path() const;
  /// The rest of the content, at most `most` bytes; shorter after an error.
  std::string read(std::size_t most = SIZE_MAX);

 private:
  Descriptor descriptor_;
  std::uint64_t size_ = 0;
  Fault fault_ = Fault::Missing;
  std::string path_, reason_, hint_;
};

/// Opens a file that the user named. Never blocks: pipes and devices are refused, also if they
/// replace the file meanwhile.
/// Checked: FileAccess.OnlyRegularFilesAreOpened
OpenFile open_regular(const std::string& path);

/// What a file is to the scene that names it.
enum class FileUse : std::uint8_t {
  Asset,  ///< picture, light profile or buffer of a model
  Scene,  ///< include, material library, user data or map
};

/// The files that one scene or model may read.
///
/// Model:   own scenes (default): assets may be regular files anywhere, everything else must be
///          below a permitted folder. Untrusted scenes: everything must be below one. Permitted are
///          the folders given to permit(): those of the scene, of its search paths and of --allow.
///          Symbolic links are resolved before the check, and the opened file is checked again, so
///          that a link that changes in between does not lead outside.
/// Checked: FileAccess.*, tests/faults/confinement_test.cpp
class FileAccess {
 public:
  using Opener = std::function<OpenFile(const std::string& path, FileUse use)>;

  /// For a process that may not open files: another process opens them by its own policy, and this
  /// one has none.
  static FileAccess by(Opener opener);
  void set_untrusted(bool untrusted) { untrusted_ = untrusted; }
  bool is_untrusted() const { return untrusted_; }
  /// Permits a file, or a folder with everything below it; an empty path is the current folder.
  void permit(const std::string& path);

  /// Whether the policy permits the path; the file need not exist.
  bool permits(const std::string& path, FileUse use) const;
  OpenFile open(const std::string& path, FileUse use) const;

 private:
  bool permits_resolved(const std::string& path, FileUse use) const;

  bool untrusted_ = false;
  std::vector<std::string> permitted_;  // canonical
  Opener opener_;
};

}  // namespace oriel
