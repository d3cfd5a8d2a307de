#include "src/system/sandbox.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <initializer_list>
#include <vector>

namespace ninebit::posix {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasSanitizer = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool kHasSanitizer = true;
#else
constexpr bool kHasSanitizer = false;
#endif
#else
constexpr bool kHasSanitizer = false;
#endif

void lower_limit(decltype(RLIMIT_AS) resource, rlim_t soft, rlim_t hard) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_max = std::min(limit.rlim_max, hard);
  limit.rlim_cur = std::min({limit.rlim_cur, soft, limit.rlim_max});
  ::setrlimit(resource, &limit);
}

// 0 without /proc: the limit is then computed as if nothing were mapped.
std::uint64_t mapped_bytes() {
  std::FILE* const file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return 0;
  unsigned long long pages = 0;
  if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
  std::fclose(file);
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

// All file access rights that this version of Landlock can restrict.
std::uint64_t rights_of_version(long version) {
  constexpr int kRefer = 13, kTruncate = 14, kDevices = 15;  // bit numbers of rights added by later versions
  int rights = kRefer;
  if (version >= 2) rights = kTruncate;
  if (version >= 3) rights = kDevices;
  if (version >= 5) rights = kDevices + 1;
  return (std::uint64_t{1} << static_cast<unsigned>(rights)) - 1;
}

#if defined(__x86_64__)
constexpr std::uint32_t kProcessor = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kProcessor = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kProcessor = 0;
#endif

constexpr int kAllowed[] = {
    SYS_read,
    SYS_readv,
    SYS_pread64,
    SYS_preadv,
    SYS_write,
    SYS_writev,
    SYS_pwrite64,
    SYS_lseek,
    SYS_close,
    SYS_dup,
    SYS_fstat,
    SYS_newfstatat,
    SYS_statx,
    SYS_faccessat,
    SYS_readlinkat,
    SYS_getcwd,
    SYS_getdents64,
    SYS_fadvise64,
    SYS_fcntl,
    SYS_ppoll,
    SYS_mmap,
    SYS_munmap,
    SYS_mprotect,
    SYS_mremap,
    SYS_madvise,
    SYS_brk,
    SYS_membarrier,
    SYS_futex,
    SYS_set_robust_list,
    SYS_rseq,
    SYS_sched_yield,
    SYS_sched_getaffinity,
    SYS_getcpu,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_sigaltstack,
    SYS_restart_syscall,
    SYS_nanosleep,
    SYS_clock_nanosleep,
    SYS_clock_gettime,
    SYS_clock_getres,
    SYS_gettimeofday,
    SYS_times,
    SYS_getrusage,
    SYS_getrandom,
    SYS_getpid,
    SYS_getppid,
    SYS_gettid,
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_uname,
    SYS_sysinfo,
    SYS_exit,
    SYS_exit_group,
#if defined(__x86_64__)
    SYS_stat,
    SYS_lstat,
    SYS_access,
    SYS_readlink,
    SYS_poll,
    SYS_time,
    SYS_arch_prctl,
#endif
};

// The offset of the low half of a call's argument; it comes first on both processors.
constexpr std::uint32_t argument(std::size_t number) {
  return static_cast<std::uint32_t>(offsetof(seccomp_data, args) + number * sizeof(std::uint64_t));
}

sock_filter load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}

sock_filter answer(std::uint32_t what) {
  return BPF_STMT(BPF_RET | BPF_K, what);
}

// Skips `skipped` instructions unless the loaded number equals `number`.
sock_filter unless_equal(std::uint32_t number, std::uint8_t skipped) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, skipped);
}

sock_filter unless_any_bit(std::uint32_t bits, std::uint8_t skipped) {
  return BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, 0, skipped);
}

std::vector<sock_filter> filter_of_calls() {
  constexpr std::uint32_t kAllow = SECCOMP_RET_ALLOW;
  constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
  constexpr std::uint32_t kWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;
  std::vector<sock_filter> code{
      load(offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kProcessor, 1, 0),  // other processors have other call numbers
      answer(SECCOMP_RET_KILL_PROCESS), load(offsetof(seccomp_data, nr))};
  for (const int call : kAllowed) {
    code.push_back(unless_equal(static_cast<std::uint32_t>(call), 1));
    code.push_back(answer(kAllow));
  }
  const auto when = [&](int call, std::initializer_list<sock_filter> then) {
    code.push_back(unless_equal(static_cast<std::uint32_t>(call), static_cast<std::uint8_t>(then.size())));
    code.insert(code.end(), then);
  };
  // A sanitizer asks with a pipe whether memory can be read, and takes a refusal for damaged memory.
  if (kHasSanitizer) when(SYS_pipe2, {answer(kAllow)});
  when(SYS_openat, {load(argument(2)), unless_any_bit(kWriting, 1), answer(kRefuse), answer(kAllow)});
#if defined(__x86_64__)
  when(SYS_open, {load(argument(1)), unless_any_bit(kWriting, 1), answer(kRefuse), answer(kAllow)});
#endif
  // Threads are allowed, processes are not. A filter cannot read the arguments of clone3; without clone3, the C library
  // uses clone.
  when(SYS_clone, {load(argument(0)), unless_any_bit(CLONE_THREAD, 1), answer(kAllow), answer(kRefuse)});
  when(SYS_clone3, {answer(SECCOMP_RET_ERRNO | ENOSYS)});
  // abort() sends a signal to this process.
  when(SYS_tgkill,
       {load(argument(0)), unless_equal(static_cast<std::uint32_t>(::getpid()), 1), answer(kAllow), answer(kRefuse)});
  // For reading this process's limits; lowered hard limits cannot be raised again.
  when(SYS_prlimit64, {load(argument(0)), unless_equal(0, 1), answer(kAllow), answer(kRefuse)});
  code.push_back(answer(kRefuse));
  return code;
}

// A file that does not exist is skipped.
void allow_reading(int ruleset, const std::filesystem::path& file) {
  landlock_path_beneath_attr allowed{};
  allowed.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE;
  allowed.parent_fd = ::open(file.c_str(), O_PATH | O_CLOEXEC);
  if (allowed.parent_fd < 0) return;
  ::syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &allowed, 0);
  ::close(allowed.parent_fd);
}

}  // namespace

// A sanitizer maps terabytes.
bool can_limit_memory() {
  return !kHasSanitizer;
}

void limit_resources(std::uint64_t more_memory, int seconds, std::uint64_t file_bytes) {
  if (!kHasSanitizer) {
    const std::uint64_t all = mapped_bytes() + more_memory;
    lower_limit(RLIMIT_AS, all, all);
  }
  const auto time = static_cast<rlim_t>(seconds);
  lower_limit(RLIMIT_CPU, time, time + 1);
  lower_limit(RLIMIT_FSIZE, file_bytes, file_bytes);
  lower_limit(RLIMIT_CORE, 0, 0);
}

void allow_only_reading(std::span<const std::filesystem::path> files) {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return;
  landlock_ruleset_attr rules{};
  rules.handled_access_fs = rights_of_version(version);
  const auto ruleset = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &rules, sizeof rules, 0));
  if (ruleset < 0) return;
  for (const std::filesystem::path& file : files) allow_reading(ruleset, file);
  if (kHasSanitizer)
    allow_reading(ruleset, "/proc");  // a sanitizer reads the stack's bounds when an exception is thrown
  ::syscall(SYS_landlock_restrict_self, ruleset, 0);
  ::close(ruleset);
}

void forbid_system_calls() {
  if (kProcessor == 0) return;
  std::vector<sock_filter> code = filter_of_calls();
  sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

}  // namespace ninebit::posix
