// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_file.h"

#include <bit>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "base/durable_file.h"
#include "base/file_access.h"

namespace oriel {
namespace {

static_assert(std::endian::native == std::endian::little, "photon files are little endian");

constexpr char kPhotonMagic[8] = {'O', 'R', 'I', 'E', 'L', 'P', 'H', 'O'};
constexpr std::uint32_t kPhotonVersion = 1, kPhotonByteOrder = 0x01020304;
/// Unit vectors may be this much off after rounding.
constexpr float kUnitTolerance = 1e-2f;
/// What a file holds of each photon: its vectors, which stand first.
constexpr std::size_t kBytesInFile = 12 * sizeof(float);
static_assert(offsetof(Photon, layer) == kBytesInFile);

struct PhotonHeader {
  char magic[8];
  std::uint32_t version, byte_order;
  std::uint64_t global, caustic;
};
static_assert(sizeof(PhotonHeader) == 32);

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::runtime_error("cannot read the photon map '" + path + "': " + why);
}

bool is_unit(const Vec3& v) { return std::abs(dot(v, v) - 1) < kUnitTolerance; }

std::vector<Photon> read_photons(std::ifstream& in, std::uint64_t count, const std::string& path) {
  std::vector<Photon> photons(count);
  for (Photon& p : photons)
    in.read(reinterpret_cast<char*>(&p), static_cast<std::streamsize>(kBytesInFile));
  if (!in) refuse(path, "it ends early");
  for (const Photon& p : photons)
    if (!is_finite(p.position) || !is_finite(p.power) || !is_unit(p.direction) ||
        !is_unit(p.normal))
      refuse(path, "a photon in it has no valid position, direction or power");
  return photons;
}

}  // namespace

void save_photon_maps(const std::string& path, const PhotonMaps& maps) try {
  const std::string fault =
      own_file_fault(path, {kPhotonMagic, sizeof kPhotonMagic}, "photon map of Oriel");
  if (!fault.empty()) throw std::runtime_error(fault);
  DurableFile out(path);
  PhotonHeader header{
      {}, kPhotonVersion, kPhotonByteOrder, maps.global.size(), maps.caustic.size()};
  std::memcpy(header.magic, kPhotonMagic, sizeof(kPhotonMagic));
  out.write(&header, sizeof(header));
  for (const PhotonMap* map : {&maps.global, &maps.caustic})
    for (const Photon& p : map->photons()) out.write(&p, kBytesInFile);
  out.commit();
} catch (const std::runtime_error& e) {
  throw std::runtime_error("cannot write the photon map '" + path + "': " + e.what());
}

PhotonMaps load_photon_maps(const std::string& path, std::uint64_t most) {
  const OpenFile file = open_regular(path);
  if (!file) refuse(path, "it cannot be opened: " + file.reason());
  std::ifstream in(file.descriptor_path(), std::ios::binary);
  const std::uint64_t bytes = file.size();
  PhotonHeader header;
  in.read(reinterpret_cast<char*>(&header), sizeof(header));
  if (!in || std::memcmp(header.magic, kPhotonMagic, sizeof(kPhotonMagic)) != 0)
    refuse(path, "it is not a photon map of Oriel; other programs' maps cannot be used");
  if (header.byte_order != kPhotonByteOrder) refuse(path, "it has another byte order");
  if (header.version != kPhotonVersion)
    refuse(path, "it has version " + std::to_string(header.version) + ", this program reads " +
                     std::to_string(kPhotonVersion));
  if (header.global > most || header.caustic > most - header.global)
    refuse(path, "it claims more photons than a map may hold");
  if (bytes != sizeof(PhotonHeader) + (header.global + header.caustic) * kBytesInFile)
    refuse(path, "its size does not fit the number of its photons");
  PhotonMaps maps;
  maps.global = PhotonMap(read_photons(in, header.global, path));
  maps.caustic = PhotonMap(read_photons(in, header.caustic, path));
  return maps;
}

}  // namespace oriel
