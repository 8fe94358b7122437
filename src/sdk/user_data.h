// SPDX-License-Identifier: Apache-2.0
// User data of the scene as shaders read it: miUserdata and the bytes behind it.
#pragma once

#include <cstddef>
#include <memory>

#include "scene/element_settings.h"
#include "sdk/host.h"

namespace oriel::sdk {

/// A miUserdata with its parameters, and its size in bytes.
///
/// Model:   declared parameters stand as in a C struct, as those of shaders do, with the declared
///          defaults where nothing is written; strings and further data are tags, names of other
///          elements null. Without a declaration they are the bytes as written or as in the file.
/// Errors:  OR-SDK-012 the file cannot be read, OR-SDK-013 nothing declares the layout; no
///          parameters then.
/// Checked: UserData.* in tests/user_shaders
std::unique_ptr<std::byte[]> user_data_record(const scene::UserData& data, Host& host,
                                              std::size_t& size);

/// The data that is attached to an element; null: none.
miTag attached_data(const scene::Attachments& attachments, Host& host);

}  // namespace oriel::sdk
