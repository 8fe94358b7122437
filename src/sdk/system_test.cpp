// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "oriel/sdk/shader/system.h"
#include "sdk/current.h"
#include "sdk/testing/bare_state.h"

namespace oriel::sdk {
namespace system_test {

using testing::BareState;

TEST(Memory, IsZeroAfterGrowth) {
  auto* bytes = static_cast<unsigned char*>(mi_mem_allocate(1000));
  EXPECT_TRUE(std::all_of(bytes, bytes + 1000, [](int b) { return b == 0; }));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bytes) % alignof(std::max_align_t), 0u);
  std::memset(bytes, 0xff, 1000);
  bytes = static_cast<unsigned char*>(mi_mem_reallocate(bytes, 50000));
  EXPECT_TRUE(std::all_of(bytes, bytes + 1000, [](int b) { return b == 0xff; }));
  EXPECT_TRUE(std::all_of(bytes + 1000, bytes + 50000, [](int b) { return b == 0; }));
  bytes = static_cast<unsigned char*>(mi_mem_test_reallocate(bytes, 10));
  EXPECT_EQ(bytes[9], 0xff);
  mi_mem_release(bytes);
  mi_mem_release(nullptr);
  void* fresh = mi_mem_test_reallocate(nullptr, 0);
  EXPECT_NE(fresh, nullptr);
  mi_mem_release(fresh);
}

TEST(Memory, FailedAllocationIsNull) {
  EXPECT_EQ(mi_mem_test_allocate(std::numeric_limits<std::size_t>::max()), nullptr);
  EXPECT_EQ(mi_mem_test_allocate(std::size_t{1} << 60), nullptr);
}

TEST(Memory, HoldsCopiesOfText) {
  char* copy = mi_mem_strdup("miXMST");
  EXPECT_STREQ(copy, "miXMST");
  mi_mem_release(copy);
}

TEST(Locks, AreMutuallyExclusive) {
  miLock lock;
  mi_init_lock(&lock);
  long count = 0;
  const auto work = [&] {
    for (int i = 0; i < 20000; ++i) {
      mi_lock(lock);
      ++count;
      mi_unlock(lock);
    }
  };
  std::thread other(work);
  work();
  other.join();
  EXPECT_EQ(count, 40000);
  mi_lock(lock);
  std::thread([&] { EXPECT_FALSE(mi_trylock(lock)); }).join();
  mi_unlock(lock);
  std::thread([&] {
    EXPECT_TRUE(mi_trylock(lock));
    mi_unlock(lock);
  }).join();
  mi_delete_lock(&lock);
  EXPECT_EQ(lock.p, nullptr);
}

TEST(Messages, ReachTheRendererWithTheirSeverity) {
  BareState bare;
  set_current_host(&bare.host());
  mi_error("no %s at %d\n", "light", 7);
  mi_nwarning(31, "odd");
  mi_info("done");
  const auto& all = bare.diagnostics().all();
  const auto said = [&](Severity severity, const char* text) {
    return std::count_if(all.begin(), all.end(), [&](const Diagnostic& d) {
      return d.severity == severity && d.message.find(text) != std::string::npos;
    });
  };
  EXPECT_EQ(said(Severity::Error, "no light at 7"), 1);
  EXPECT_EQ(said(Severity::Warning, "odd (31)"), 1);
  EXPECT_EQ(said(Severity::Note, "done"), 1);
}

TEST(Messages, OfOtherThreadsReachTheProcess) {
  BareState bare;
  set_current_host(&bare.host());
  std::thread([&] { EXPECT_EQ(current_host(), &bare.host()); }).join();
  forget_host(&bare.host());
  EXPECT_EQ(current_host(), nullptr);
}

TEST(Abort, IsReturnedByQueries) {
  BareState bare;
  set_current_host(&bare.host());
  EXPECT_FALSE(mi_par_aborted());
  mi_abort();
  EXPECT_TRUE(mi_par_aborted());
}

TEST(StringSubstitute, ReplacesVariablesAndBackslashes) {
  setenv("ORIEL_TEST_FOLDER", "/pictures", 1);
  char text[64];
  EXPECT_STREQ(mi_string_substitute(text, "$ORIEL_TEST_FOLDER\\a/b.tif", 64), "/pictures/a/b.tif");
  mi_string_substitute(text, "${ORIEL_TEST_FOLDER}x$ORIEL_TEST_NONE.", 64);
  EXPECT_STREQ(text, "/picturesx.");
  mi_string_substitute(text, "0123456789", 4);
  EXPECT_STREQ(text, "012");
}

}  // namespace system_test
}  // namespace oriel::sdk
