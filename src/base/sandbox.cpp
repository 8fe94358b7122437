// SPDX-License-Identifier: Apache-2.0
#include "base/sandbox.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace oriel {
namespace {

// Read by the handler of SIGSYS.
const char* granted_path = nullptr;
int granted_descriptor = -1;

/// The descriptor that a path stands for; -1 if the process may not know of it.
int descriptor_of(greg_t path) {
  constexpr char kOwn[] = "/proc/self/fd/";
  constexpr std::size_t kStart = sizeof kOwn - 1;
  const auto* const text = reinterpret_cast<const char*>(path);
  if (!text) return -1;
  if (granted_path && std::strcmp(text, granted_path) == 0) return granted_descriptor;
  if (std::strncmp(text, kOwn, kStart) != 0) return -1;
  int number = 0;
  const char* digit = text + kStart;
  for (; *digit >= '0' && *digit <= '9' && number < 100'000; ++digit)
    number = number * 10 + (*digit - '0');
  return *digit == 0 && digit > text + kStart ? number : -1;
}

long open_granted(greg_t path, greg_t flags) {
  const int descriptor = descriptor_of(path);
  if (descriptor < 0) return -EACCES;
  if ((flags & O_ACCMODE) != O_RDONLY) return -EACCES;
  const long copy = syscall(SYS_dup, descriptor);
  if (copy < 0) return -errno;
  lseek(static_cast<int>(copy), 0, SEEK_SET);
  return copy;
}

long examine(greg_t path, greg_t status) {
  const int descriptor = descriptor_of(path);
  if (descriptor < 0) return -EACCES;
  return syscall(SYS_fstat, descriptor, status) == 0 ? 0 : -errno;
}

long examine_at(const greg_t* r) {
  const auto* const path = reinterpret_cast<const char*>(r[REG_RSI]);
  if ((r[REG_R10] & AT_EMPTY_PATH) != 0 && (!path || !*path))
    return syscall(SYS_fstat, r[REG_RDI], r[REG_RDX]) == 0 ? 0 : -errno;
  return examine(r[REG_RSI], r[REG_RDX]);
}

void on_path_call(int, siginfo_t* info, void* context) {
  const int kept = errno;
  greg_t* const r = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  long result = -EACCES;
  switch (info->si_syscall) {
    case SYS_open:
      result = open_granted(r[REG_RDI], r[REG_RSI]);
      break;
    case SYS_openat:
      result = open_granted(r[REG_RSI], r[REG_RDX]);
      break;
    case SYS_stat:
    case SYS_lstat:
      result = examine(r[REG_RDI], r[REG_RSI]);
      break;
    case SYS_newfstatat:
      result = examine_at(r);
      break;
    case SYS_access:
      result = descriptor_of(r[REG_RDI]) >= 0 ? 0 : -EACCES;
      break;
    default:
      break;
  }
  r[REG_RAX] = result;
  errno = kept;
}

constexpr int kPathCalls[] = {SYS_open,       SYS_openat, SYS_stat,      SYS_lstat,
                              SYS_newfstatat, SYS_access, SYS_faccessat, SYS_readlink};

constexpr int kAllowed[] = {SYS_read,
                            SYS_pread64,
                            SYS_readv,
                            SYS_write,
                            SYS_writev,
                            SYS_lseek,
                            SYS_fstat,
                            SYS_fstatfs,
                            SYS_getcwd,
                            SYS_close,
                            SYS_dup,
                            SYS_fcntl,
                            SYS_sendmsg,
                            SYS_recvmsg,
                            SYS_poll,
                            SYS_munmap,
                            SYS_mremap,
                            SYS_brk,
                            SYS_madvise,
                            SYS_futex,
                            SYS_rt_sigaction,
                            SYS_rt_sigprocmask,
                            SYS_rt_sigreturn,
                            SYS_sigaltstack,
                            SYS_getpid,
                            SYS_gettid,
                            SYS_clock_gettime,
                            SYS_gettimeofday,
                            SYS_time,
                            SYS_getrusage,
                            SYS_sched_yield,
                            SYS_getrandom,
                            SYS_sysinfo,
                            SYS_uname,
                            SYS_sched_getaffinity,
                            SYS_clock_nanosleep,
                            SYS_restart_syscall,
                            SYS_exit,
                            SYS_exit_group};

/// Builds the program of the filter.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    skip_unless_equal(AUDIT_ARCH_X86_64, 1, true);
    finish(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
    for (const int number : kAllowed) when(number, SECCOMP_RET_ALLOW);
    for (const int number : kPathCalls) when(number, SECCOMP_RET_TRAP);
    // Memory must not become executable.
    for (const int number : {SYS_mmap, SYS_mprotect}) {
      code_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number), 0, 4));
      load(offsetof(seccomp_data, args) + 2 * sizeof(std::uint64_t));
      code_.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, PROT_EXEC, 1, 0));
      finish(SECCOMP_RET_ALLOW);
      finish(SECCOMP_RET_ERRNO | EPERM);
    }
    // abort() sends a signal to its own thread.
    code_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_tgkill, 0, 3));
    load(offsetof(seccomp_data, args));
    skip_unless_equal(static_cast<unsigned>(getpid()), 1, false);
    finish(SECCOMP_RET_ALLOW);
    finish(SECCOMP_RET_ERRNO | EPERM);
  }
  void install() {
    const sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program) != 0)
      throw std::runtime_error("the kernel does not support seccomp filters");
  }

 private:
  void load(std::size_t offset) {
    code_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset)));
  }
  void finish(unsigned action) { code_.push_back(BPF_STMT(BPF_RET | BPF_K, action)); }
  /// Skips the next instruction if the value is equal (`if_equal`) or if it is not.
  void skip_unless_equal(unsigned value, unsigned char count, bool if_equal) {
    code_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value,
                             if_equal ? count : static_cast<unsigned char>(0),
                             if_equal ? static_cast<unsigned char>(0) : count));
  }
  void when(int number, unsigned action) {
    skip_unless_equal(static_cast<unsigned>(number), 1, false);
    finish(action);
  }

  std::vector<sock_filter> code_;
};

void limit(__rlimit_resource resource, rlim_t most) {
  rlimit now{};
  getrlimit(resource, &now);
  now.rlim_max = std::min(now.rlim_max, most);
  now.rlim_cur = std::min(now.rlim_cur, now.rlim_max);
  setrlimit(resource, &now);
}

}  // namespace

void grant_file(const char* path, int descriptor) {
  granted_path = path;
  granted_descriptor = descriptor;
}

void enter_sandbox(const SandboxLimits& limits) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  if (limits.memory_bytes > 0) limit(RLIMIT_DATA, limits.memory_bytes);
  if (limits.processor_seconds > 0) limit(RLIMIT_CPU, limits.processor_seconds);
  struct sigaction action = {};
  action.sa_sigaction = on_path_call;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  sigaction(SIGSYS, &action, nullptr);
  prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
  Filter().install();
}

}  // namespace oriel
