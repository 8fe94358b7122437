// SPDX-License-Identifier: Apache-2.0
// Processes that read untrusted files, with one that does its worst.
#include "base/confined_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>

#include "base/packet.h"

namespace oriel {
namespace confined_process_test {

ConfinedOptions hostile() {
  ConfinedOptions options;
  options.program = ORIEL_HOSTILE_READER;
  options.argument = "--read-anything";
  options.shared_bytes = 1 << 20;
  return options;
}

void say(ConfinedProcess& process, std::string_view text, int descriptor = -1) {
  EXPECT_TRUE(process.send(text.data(), text.size(), descriptor));
}

std::string answer(ConfinedProcess& process, double seconds = 30) {
  std::string text(65536, '\0');
  text.resize(process.receive(text.data(), text.size(), seconds));
  return text;
}

/// What ProcessEnded says; empty if it was not thrown.
std::string end_of(ConfinedProcess& process, double seconds = 30) {
  try {
    answer(process, seconds);
    return {};
  } catch (const ProcessEnded& e) {
    EXPECT_FALSE(process.is_running());
    return e.what();
  }
}

TEST(ConfinedProcess, AnswersPackets) {
  ConfinedProcess process(hostile());
  say(process, "echo this");
  EXPECT_EQ(answer(process), "echo this");
  EXPECT_TRUE(process.is_running());
}

TEST(ConfinedProcess, CrashesAndEndsAreNoticed) {
  for (const char* what : {"crash", "leave", "large"}) {
    ConfinedProcess process(hostile());
    say(process, what);
    EXPECT_EQ(end_of(process), "crashed") << what;
    EXPECT_FALSE(process.send("more", 4)) << what;
  }
}

TEST(ConfinedProcess, HangingProcessesAreEnded) {
  ConfinedProcess process(hostile());
  say(process, "hang");
  const auto start = std::chrono::steady_clock::now();
  const pid_t id = process.id();
  EXPECT_EQ(end_of(process, .2), "took more than 0.2 s");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_NE(kill(id, 0), 0);
}

TEST(ConfinedProcess, ProcessorTimeIsLimited) {
  ConfinedOptions options = hostile();
  options.processor_seconds = 1;
  ConfinedProcess process(options);
  say(process, "spin");
  EXPECT_EQ(end_of(process, 300), "crashed");  // by SIGXCPU
}

TEST(ConfinedProcess, MemoryIsLimited) {
  ConfinedOptions options = hostile();
  options.memory_mb = 64;
  ConfinedProcess process(options);
  say(process, "eat");
  const int megabytes = std::stoi(answer(process));
  EXPECT_GT(megabytes, 32);
  EXPECT_LE(megabytes, 64);
}

TEST(ConfinedProcess, InheritsNoFilesAndNoSecrets) {
  const Descriptor secret(open("/dev/null", O_RDONLY));  // without O_CLOEXEC
  setenv("ORIEL_TEST_SECRET", "secret", 1);
  ConfinedProcess first(hostile());
  say(first, "descriptors");
  EXPECT_EQ(answer(first), "0 1 2 3 4 ");
  ConfinedProcess second(hostile());
  say(second, "environment");
  EXPECT_EQ(answer(second).find("secret"), std::string::npos);
  unsetenv("ORIEL_TEST_SECRET");
}

TEST(ConfinedProcess, SignalsDoNotEndTheWait) {
  struct sigaction action {
  }, before{};
  action.sa_handler = [](int) {};
  sigaction(SIGUSR2, &action, &before);
  ConfinedProcess process(hostile());
  const pthread_t waiting = pthread_self();
  std::thread other([&] {
    for (int i = 0; i < 20; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      pthread_kill(waiting, SIGUSR2);
    }
  });
  say(process, "hang");
  EXPECT_EQ(end_of(process, .5), "took more than 0.5 s");
  other.join();
  sigaction(SIGUSR2, &before, nullptr);
}

TEST(ConfinedProcess, MemoryCannotShrink) {
  ConfinedProcess process(hostile());
  EXPECT_EQ(process.memory().size(), std::size_t{1} << 20);
  say(process, "crash");
  EXPECT_EQ(end_of(process), "crashed");
  EXPECT_EQ(process.memory()[(1 << 20) - 1], std::byte{0});  // still there
}

TEST(ConfinedProcess, MissingProgramsAreReported) {
  ConfinedOptions options = hostile();
  options.program = "/nowhere/program";
  EXPECT_THROW(ConfinedProcess{options}, std::runtime_error);
}

}  // namespace confined_process_test
}  // namespace oriel
