// SPDX-License-Identifier: Apache-2.0
#include "base/input_files.h"

#include <sys/stat.h>

#include <array>
#include <fstream>
#include <mutex>
#include <vector>

#include "base/checksum.h"

namespace oriel {
namespace {

struct InputList {
  std::mutex mutex;
  std::array<std::set<std::string>, 2> files;
  std::set<std::string>& of(InputKind kind) { return files[static_cast<std::size_t>(kind)]; }
};

InputList& input_list() {
  static InputList list;
  return list;
}

}  // namespace

void note_input_file(const std::string& path, InputKind kind) {
  InputList& list = input_list();
  const std::lock_guard lock(list.mutex);
  list.of(kind).insert(path);
}

std::set<std::string> input_files(InputKind kind) {
  InputList& list = input_list();
  const std::lock_guard lock(list.mutex);
  return list.of(kind);
}

void forget_frame_inputs() {
  InputList& list = input_list();
  const std::lock_guard lock(list.mutex);
  list.of(InputKind::Frame).clear();
}

std::uint64_t file_checksum(const std::string& path, std::uint64_t most) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  Checksum64 sum;
  if (size > most) {
    const std::array<std::int64_t, 3> values = {status.st_size, status.st_mtim.tv_sec,
                                                status.st_mtim.tv_nsec};
    sum.add(values.data(), sizeof values);
    return sum.value();
  }
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(std::size_t{1} << 20);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    sum.add(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  return file.bad() ? 0 : sum.value();
}

}  // namespace oriel
