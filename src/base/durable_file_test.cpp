// SPDX-License-Identifier: Apache-2.0
#include "base/durable_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/files.h"

namespace oriel {
namespace durable_file_test {

namespace fs = std::filesystem;

/// What the calls of fsync() found; they fail while `error` is not 0.
struct Flushes {
  int error = 0;
  std::string target;                ///< file that is observed
  std::vector<std::string> content;  ///< of the target at each call
};
Flushes flushes;

}  // namespace durable_file_test
}  // namespace oriel

/// Replaces the function of the C library in this program.
extern "C" int fsync(int file) {
  using oriel::durable_file_test::flushes;
  if (!flushes.target.empty()) flushes.content.push_back(oriel::text_of(flushes.target));
  if (flushes.error != 0) return errno = flushes.error, -1;
  return static_cast<int>(syscall(SYS_fsync, file));
}

namespace oriel {
namespace durable_file_test {

/// Limits the size of files that this process writes; the write fails instead of a signal.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : signal_(::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, signal_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*signal_)(int);
};

TEST(DurableFile, ReplacesTheTargetOnlyWhenCommitted) {
  const TestFolder folder;
  const std::string path = folder.file("a.txt");
  write_durably(path, "old");
  {
    DurableFile file(path);
    file.write("new");
    EXPECT_EQ(text_of(path), "old");
  }
  EXPECT_EQ(text_of(path), "old") << "a file without commit is dropped";
  EXPECT_EQ(folder.count(), 1) << "and its temporary file is removed";
  write_durably(path, "new");
  EXPECT_EQ(text_of(path), "new");
  EXPECT_EQ(folder.count(), 1);
}

TEST(DurableFile, DataAreOnTheDiskBeforeTheTargetIsReplaced) {
  const TestFolder folder;
  const std::string path = folder.file("a.txt");
  write_durably(path, "old");
  flushes = {.target = path};
  write_durably(path, "new");
  EXPECT_EQ(flushes.content, (std::vector<std::string>{"old", "new"}))
      << "the file, then its folder";
  flushes = {.error = EIO};
  EXPECT_THROW(write_durably(path, "lost"), std::runtime_error);
  flushes = {};
  EXPECT_EQ(text_of(path), "new");
  EXPECT_EQ(folder.count(), 1);
}

TEST(DurableFile, WritesAtPositions) {
  const TestFolder folder;
  const std::string big(200000, 'x');
  DurableFile file(folder.file("a"));
  file.write("....");
  file.write(big);
  EXPECT_EQ(file.position(), 200004u);
  file.seek(1);
  file.write("ab");
  EXPECT_EQ(file.position(), 3u);
  file.commit();
  EXPECT_EQ(text_of(folder.file("a")), ".ab." + big);
}

TEST(DurableFile, EverySizeLimitKeepsTheOldFile) {
  const TestFolder folder;
  const std::string path = folder.file("a"), content(150000, 'x');
  for (const rlim_t limit : {0, 1, 65535, 65536, 65537, 149999}) {
    write_durably(path, "old");
    const FileSizeLimit limited(limit);
    EXPECT_THROW(write_durably(path, content), std::runtime_error) << limit;
    EXPECT_EQ(text_of(path), "old") << limit;
    EXPECT_EQ(folder.count(), 1) << limit;
  }
  const FileSizeLimit limited(content.size());
  EXPECT_NO_THROW(write_durably(path, content));
}

TEST(DurableFile, ErrorsAreRepeatedByCommit) {
  const TestFolder folder;
  DurableFile file(folder.file("a"));
  const FileSizeLimit limited(10);
  EXPECT_THROW(file.write(std::string(100000, 'x')), std::runtime_error);
  EXPECT_THROW(file.write("x"), std::runtime_error);
  EXPECT_THROW(file.commit(), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder.file("a")));
}

TEST(DurableFile, LinksFoldersAndPipesAreRefused) {
  const TestFolder folder;
  write_durably(folder.file("target"), "old");
  fs::create_symlink("target", folder.file("link"));
  fs::create_symlink("missing", folder.file("dangling"));
  fs::create_directory(folder.file("folder"));
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  for (const char* name : {"link", "dangling", "folder", "pipe", "folder/", "target/x"})
    EXPECT_THROW(write_durably(folder.file(name), "new"), std::runtime_error) << name;
  EXPECT_EQ(text_of(folder.file("target")), "old");
  EXPECT_FALSE(fs::exists(folder.file("missing")));
  EXPECT_EQ(folder.count(), 5);
}

TEST(DurableFile, NamesOfTheLargestLengthAreWritten) {
  const TestFolder folder;
  const std::string longest(255, 'x');
  write_durably(folder.file(longest), "text");
  EXPECT_EQ(text_of(folder.file(longest)), "text");
  EXPECT_THROW(write_durably(folder.file(longest + "x"), "text"), std::runtime_error);
}

TEST(DurableFile, OwnFormatsReplaceOnlyTheirOwnFiles) {
  const TestFolder folder;
  const auto fault = [&](const char* name) {
    return own_file_fault(folder.file(name), "MAGIC", "map");
  };
  write_durably(folder.file("own"), "MAGIC and data");
  write_durably(folder.file("other"), "MAGI");
  write_durably(folder.file("empty"), "");
  for (const char* name : {"own", "empty", "new"}) EXPECT_EQ(fault(name), "") << name;
  for (const char* name : {"other", ".hidden"}) EXPECT_NE(fault(name), "") << name;
}

TEST(DurableFile, FirstBytesAreOfRegularFilesOnly) {
  const TestFolder folder;
  write_durably(folder.file("a"), "abcdef");
  fs::create_symlink("a", folder.file("link"));
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  EXPECT_EQ(first_bytes(folder.file("a"), 3), "abc");
  EXPECT_EQ(first_bytes(folder.file("a"), 30), "abcdef");
  for (const char* name : {"link", "pipe", "missing", "."})
    EXPECT_EQ(first_bytes(folder.file(name), 3), "") << name;
}

}  // namespace durable_file_test
}  // namespace oriel
