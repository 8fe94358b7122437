// SPDX-License-Identifier: Apache-2.0
// Binary messages of pixels, see docs/dev/studio-protocol.md.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "interactive/picture.h"

namespace oriel::studio {

inline constexpr std::size_t kWireHeaderBytes = 32;
inline constexpr std::size_t kMaxStripBytes = std::size_t{1} << 20;

/// All strips of a picture: a header and rows from the top each.
/// Checked: StudioSessionTest.PixelsArriveReducedFirstAndAtFullSizeInTheEnd
std::vector<std::shared_ptr<const std::string>> wire_strips(const interactive::Picture& picture,
                                                            std::uint32_t frame);

}  // namespace oriel::studio
