// SPDX-License-Identifier: Apache-2.0
// URIs of a model file: file names or data.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/file_access.h"

namespace oriel::models::gltf {

/// Decodes percent escapes; an invalid escape is copied.
/// Source:  RFC 3986, 2.1.
std::string unescaped(std::string_view uri);

struct DataUri {
  std::string media_type;  ///< "image/png"
  std::string bytes;
};
/// Unset if this is not a data URI or its base64 is invalid.
/// Source:  RFC 2397; RFC 4648, 4.
std::optional<DataUri> data_of(std::string_view uri);

/// Name of a file in `folder` that exists: the decoded URI or, for files with unescaped names, the
/// URI as written. If neither exists, the decoded URI.
std::string file_name(const std::string& uri, const std::string& folder, const FileAccess& files);

}  // namespace oriel::models::gltf
