// SPDX-License-Identifier: Apache-2.0
// Cryptomatte: id mattes by name in EXR channels, in the format of compositing programs.
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
/// Checked: Cryptomatte.* in cryptomatte_test.cpp; these tests also cover the functions below.
std::uint32_t murmur3_32(std::string_view text, std::uint32_t seed = 0);

/// The id of a name as a pixel value: the bits of its hash with the exponent clamped to 1...254, so
/// that the value is never infinite, denormal or 0. 0 means no object.
float cryptomatte_id(std::string_view name);

/// The share of a pixel that one name covers.
struct CryptomatteShare {
  float id = 0;  ///< 0 = no object
  float coverage = 0;
};

/// Merges shares of the same id and writes id, coverage, id, coverage... in descending order of
/// coverage; unused entries are 0. Equal coverages are sorted by id, so the result does not depend
/// on the order of samples.
void rank_shares(std::vector<CryptomatteShare>& shares, std::span<float> out);

/// The EXR header attributes that declare the layers `type`00, `type`01...: name, hash, conversion,
/// and the manifest of names.
std::map<std::string, std::string> cryptomatte_metadata(std::string_view type,
                                                        std::span<const std::string> names);

}  // namespace oriel
