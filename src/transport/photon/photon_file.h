// SPDX-License-Identifier: Apache-2.0
// Photon maps in files, to be used again for another view of the same scene.
#pragma once

#include <string>

#include "transport/photon/photon_map.h"

namespace oriel {

/// What is traced once and asked for many times.
struct PhotonMaps {
  PhotonMap global;   ///< came by at least one diffuse bounce
  PhotonMap caustic;  ///< came by mirrors, glass and glossy surfaces alone, at least one
};

// Conventions
//   Binary, little endian: the 8 bytes "ORIELPHO", version (uint32, 1), a mark of the byte order
//   (uint32, 0x01020304), the number of photons in the global and in the caustic map (uint64 each),
//   then 12 floats for each photon: position, direction, power, normal. The tree is not stored.

/// Largest number of photons a file may hold, both maps together: 6 GiB.
inline constexpr std::uint64_t kMaxPhotonsInFile = std::uint64_t{1} << 27;

/// Replaces the file as a whole (DurableFile), and only if it is a photon map of Oriel or empty.
/// Errors:  std::runtime_error with path and reason.
/// Checked: PhotonFile.RoundTripIsExact
void save_photon_maps(const std::string& path, const PhotonMaps& maps);

/// Reads what save_photon_maps wrote. The size is checked before memory is taken.
/// Inputs:  most: maximum number of photons, both maps together.
/// Errors:  std::runtime_error with path and reason: missing, of another program or version, cut
///          short, numbers that are none.
/// Checked: PhotonFile.*
PhotonMaps load_photon_maps(const std::string& path, std::uint64_t most = kMaxPhotonsInFile);

}  // namespace oriel
