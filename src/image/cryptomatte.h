// SPDX-License-Identifier: Apache-2.0
// Cryptomatte: mattes by name in the channels of a picture, as compositing programs read them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

// Source: J. Friedman, A. Jones, "Fully Automatic ID Mattes with Support for Motion Blur and
//         Transparency", SIGGRAPH 2015; Psyop, "Cryptomatte Specification".

/// The 32 bit hash of a name (MurmurHash3_x86_32).
/// Checked: Cryptomatte.* in cryptomatte_test.cpp, as all below
std::uint32_t murmur3_32(std::string_view text, std::uint32_t seed = 0);

/// The number that stands for a name in pixels: the bits of its hash, the exponent kept within
/// 1...254 so that it is no infinity, no denormal and never 0, which is what nothing has.
float cryptomatte_id(std::string_view name);

/// How much of a pixel a name covers.
struct CryptomatteShare {
  float id = 0;  ///< 0 = nothing is there
  float coverage = 0;
};

/// Joins shares of the same id and writes id, coverage, id, coverage... the largest first; the rest
/// is 0. Equal coverages stand by id, so that pictures do not depend on the order of samples.
void rank_shares(std::vector<CryptomatteShare>& shares, std::span<float> out);

/// The attributes of an EXR header that tell of layers `type`00, `type`01...: its name, hash and
/// conversion, and the manifest of names.
std::map<std::string, std::string> cryptomatte_metadata(std::string_view type,
                                                        std::span<const std::string> names);

}  // namespace oriel
