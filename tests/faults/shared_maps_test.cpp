// SPDX-License-Identifier: Apache-2.0
// Final gather points that several processes compute together, with threads in place of processes.
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "base/checkpoint_file.h"
#include "base/file_text.h"
#include "base/temporary_folder.h"
#include "support/picture.h"
#include "support/scene_text.h"

namespace oriel {
namespace shared_maps_test {

using testing::Probe;
using testing::SceneText;

constexpr std::size_t kProcesses = 3;

/// Messages between the threads.
class Exchange {
 public:
  /// Waits for all of them.
  std::vector<std::string> all(std::size_t number, const std::string& own) {
    std::unique_lock lock(mutex_);
    given_.resize(kProcesses);
    given_[number] = own;
    const int round = round_;
    if (++count_ == kProcesses) {
      last_ = std::exchange(given_, {});
      count_ = 0;
      ++round_;
      condition_.notify_all();
    }
    condition_.wait(lock, [&] { return round_ != round; });
    return last_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  std::vector<std::string> given_, last_;
  std::size_t count_ = 0;
  int round_ = 0;
};

class Share final : public WorkShare {
 public:
  Share(Exchange& exchange, std::size_t number) : exchange_(exchange), number_(number) {}
  bool leads() const override { return number_ == 0; }
  bool owns(std::size_t i) const override { return i % kProcesses == number_; }
  std::string from_leader(std::string bytes) override { return exchange_.all(number_, bytes)[0]; }
  std::vector<std::string> exchange(const std::string& own) override {
    sent += own.size();
    std::vector<std::string> all = exchange_.all(number_, own);
    ++rounds;
    return ends_after > 0 && rounds >= ends_after ? std::vector<std::string>() : all;
  }

  std::size_t sent = 0;
  int rounds = 0, ends_after = 0;

 private:
  Exchange& exchange_;
  std::size_t number_;
};

SceneText room(const std::string& method) {
  SceneText scene(
      "trace depth 4 4 8 shadow segments finalgather accuracy 32 photon trace depth 4 4 8");
  scene.method(method);
  scene.lambert("white", .6f).box("white", Vec3(-2), Vec3(2), true);
  scene.light("lamp",
              "\"mib_light_point\" (\"color\" 5 5 5) origin 0 1 0 energy 9 9 9 "
              "globillum photons 500");
  return scene.camera("focal 1 aperture 1 aspect 1 resolution 60 60");
}

std::string maps_of(RenderSession& session) {
  const TemporaryFolder folder;
  CheckpointWriter out(folder.file("maps"), {});
  session.save_maps(out);
  out.commit();
  return file_text(folder.file("maps"));
}

// The maps and their number of rays are those of one process, and each process sent some of them.
// acceptance: F2
TEST(SharedMaps, HaveTheBytesOfOneProcess) {
  for (const char* method : {"fg", "fg+photons", "path+cache", "path"}) {
    const Probe probe(room(method));
    const SessionSettings settings = {.budget = {.samples = 4}};
    RenderSession alone(probe.world(), settings), together(probe.world(), settings);
    alone.prepare();
    Exchange exchange;
    std::vector<std::unique_ptr<Share>> shares;
    for (std::size_t i = 0; i < kProcesses; ++i)
      shares.push_back(std::make_unique<Share>(exchange, i));
    std::vector<std::thread> others;
    for (std::size_t i = 1; i < kProcesses; ++i)
      others.emplace_back([&, i] {
        RenderSession session(probe.world(), settings);
        session.help_prepare(*shares[i], nullptr);
      });
    EXPECT_TRUE(together.prepare({}, nullptr, shares[0].get()));
    for (std::thread& other : others) other.join();
    EXPECT_TRUE(maps_of(together) == maps_of(alone)) << method;
    if (!std::string_view(method).starts_with("fg")) continue;
    EXPECT_GT(together.integrator().gather_points(), 10u);
    for (const auto& share : shares) EXPECT_GT(share->sent, 1000u) << method;
  }
}

TEST(SharedMaps, EndWithAnInterruptedProcess) {
  const Probe probe(room("fg"));
  const SessionSettings settings = {.budget = {.samples = 4}};
  Exchange exchange;
  std::vector<std::unique_ptr<Share>> shares;
  for (std::size_t i = 0; i < kProcesses; ++i) {
    shares.push_back(std::make_unique<Share>(exchange, i));
    shares.back()->ends_after = 2;
  }
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < kProcesses; ++i)
    others.emplace_back([&, i] {
      RenderSession session(probe.world(), settings);
      session.help_prepare(*shares[i], nullptr);
    });
  RenderSession session(probe.world(), settings);
  session.prepare({}, nullptr, shares[0].get());
  for (std::thread& other : others) other.join();
  for (const auto& share : shares) EXPECT_EQ(share->rounds, 2);
}

}  // namespace shared_maps_test
}  // namespace oriel
