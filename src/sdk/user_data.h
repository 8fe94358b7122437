// SPDX-License-Identifier: Apache-2.0
// User data of the scene for shaders: miUserdata and its bytes.
#pragma once

#include <cstddef>
#include <memory>

#include "scene/element_settings.h"
#include "sdk/host.h"

namespace oriel::sdk {

/// A miUserdata with its parameters, and its size in bytes.
///
/// Model:   declared parameters are laid out as a C struct like shader parameters, with the
///          declared defaults for missing values. Strings and nested data are tags; names of other
///          elements are null. Without a declaration the bytes are those of the scene or of the
///          file.
/// Errors:  OR-SDK-012 the file cannot be read, OR-SDK-013 the layout is not declared and there are
///          no parameters.
/// Checked: UserData.* in tests/user_shaders
std::unique_ptr<std::byte[]> user_data_record(const scene::UserData& data, Host& host,
                                              std::size_t& size);

/// The data that is attached to an element; null: none.
miTag attached_data(const scene::Attachments& attachments, Host& host);

}  // namespace oriel::sdk
