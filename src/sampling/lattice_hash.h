// SPDX-License-Identifier: Apache-2.0
// Random numbers of lattice points and of positions, for procedural textures.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace oriel::sampling {

/// Hash of one to four words.
///
/// Source:  Jenkins, "Hash Functions for Hash Table Lookup" (lookup3), 2006, public domain; length
///          and initial value as in Open Shading Language and Blender.
/// Checked: LatticeHash.*
std::uint32_t lattice_hash(std::span<const std::uint32_t> words);

/// Hash of one to four numbers, by their bits, as a number in [0, 1].
float position_hash(std::span<const float> numbers);

/// Three independent numbers in [0, 1] of one to four numbers: colours of cells and of places.
///
/// Model:   the hash of the position, and of the position with 1 and 2 as a further number; of four
///          numbers those of two other orders.
/// Source:  the random numbers of Blender's textures.
/// Checked: LatticeHash.*
std::array<float, 3> position_color(std::span<const float> numbers);

}  // namespace oriel::sampling
