// SPDX-License-Identifier: Apache-2.0
// The files of the page.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace oriel::studio {

/// A file to send.
struct PageFile {
  std::string bytes;
  std::string_view type;  ///< for Content-Type
  std::string tag;        ///< for ETag
};

/// The files of a folder, found once by their names; a request can name no other file.
/// Checked: StudioServerTest.PathsLeadToPageFilesOnly
class PageFiles {
 public:
  /// Files of known types below the folder, without links and hidden ones.
  explicit PageFiles(const std::filesystem::path& folder);

  /// Inputs:  target: path of the request without its query; "/" is /index.html.
  std::optional<PageFile> find(std::string_view target) const;
  bool empty() const { return files_.empty(); }

 private:
  struct Entry {
    std::filesystem::path path;
    std::string_view type;
  };
  std::map<std::string, Entry, std::less<>> files_;
};

}  // namespace oriel::studio
