// SPDX-License-Identifier: Apache-2.0
// What the URIs of a model file mean: names of files beside it, or the data itself.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace oriel::models::gltf {

/// The name that a URI spells, "%20" as a space; a percent sign that begins nothing stays.
/// Source:  RFC 3986, 2.1.
std::string unescaped(std::string_view uri);

struct DataUri {
  std::string media_type;  ///< "image/png"
  std::string bytes;
};
/// Unset where it is no data URI or its base64 is none.
/// Source:  RFC 2397; RFC 4648, 4.
std::optional<DataUri> data_of(std::string_view uri);

/// The name of a picture or buffer that is there in `folder`: as the URI spells it, or, for files
/// that were never escaped, as it is written. As it spells where neither is.
std::string file_name(const std::string& uri, const std::string& folder);

/// Whether the name leads nowhere but to the folder or below it.
bool stays_below(const std::string& name);

}  // namespace oriel::models::gltf
