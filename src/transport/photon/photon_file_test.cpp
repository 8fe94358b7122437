// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace oriel {
namespace photon_file_test {

class PhotonFile : public ::testing::Test {
 protected:
  ~PhotonFile() override { std::filesystem::remove(path_); }

  static PhotonMaps maps() {
    std::vector<Photon> photons(100);
    for (int i = 0; i < 100; ++i) {
      Photon& p = photons[static_cast<std::size_t>(i)];
      p.position = Vec3(float(i * 37 % 100), float(i * 11 % 17), .1f * float(i));
      p.power = Rgb(.1f * float(i), 1, 2);
    }
    PhotonMaps result;
    result.global = PhotonMap(photons);
    photons.resize(7);
    result.caustic = PhotonMap(photons);
    return result;
  }
  std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  std::string reason() const {
    try {
      load_photon_maps(path_);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return {};
  }

  const std::string path_ = ::testing::TempDir() + "photons.map";
};

// acceptance: H3
TEST_F(PhotonFile, RoundTripIsExact) {
  const PhotonMaps out = maps();
  save_photon_maps(path_, out);
  const PhotonMaps in = load_photon_maps(path_);
  const auto expect_same = [](const PhotonMap& a, const PhotonMap& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.photons().data(), b.photons().data(), a.size() * sizeof(Photon)), 0);
  };
  expect_same(in.global, out.global);
  expect_same(in.caustic, out.caustic);
}

TEST_F(PhotonFile, EmptyMapsRoundTrip) {
  save_photon_maps(path_, {});
  EXPECT_TRUE(load_photon_maps(path_).global.empty());
}

TEST_F(PhotonFile, ForeignFilesAreRefused) {
  EXPECT_NE(reason().find("cannot be opened"), std::string::npos);
  write("");
  EXPECT_NE(reason().find("not a photon map of Oriel"), std::string::npos);
  write(std::string(5000, 'x'));
  EXPECT_NE(reason().find("not a photon map of Oriel"), std::string::npos);
}

TEST_F(PhotonFile, BrokenFilesAreRefused) {
  save_photon_maps(path_, maps());
  const std::string good = bytes();
  const auto refused = [&](std::size_t at, const std::string& replaced, const std::string& why) {
    std::string bad = good;
    bad.replace(at, replaced.size(), replaced);
    write(bad);
    EXPECT_NE(reason().find(why), std::string::npos) << reason();
  };
  refused(8, std::string("\x02\0\0\0", 4), "version 2");
  refused(12, "\x01\x02\x03\x04", "byte order");
  refused(16, std::string(8, '\xff'), "more photons");
  refused(24, std::string(8, '\xff'), "more photons");
  refused(16, std::string("\xff\xff\xff\x03\0\0\0\0", 8), "size does not fit");
  refused(32, std::string(4, '\xff'), "no valid position");
  refused(32 + 36, std::string("\0\0\0\0\0\0\0\0\0\0\0\0", 12), "no valid position");
  write(good.substr(0, good.size() - 1));
  EXPECT_NE(reason().find("size does not fit"), std::string::npos);
  write(good.substr(0, 20));
  EXPECT_NE(reason().find("not a photon map"), std::string::npos);
}

}  // namespace photon_file_test
}  // namespace oriel
