#include "jobs/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "anthrob_core/progress_lines.h"

namespace anthrob {
namespace jobs {

namespace {

constexpr int kProgress = 3, kFailure = 4;  // descriptors of the child, after the standard ones
constexpr int kAbove = 16;                  // descriptors that are out of their way
constexpr int kNotStarted = 127;            // status, as of a shell

/// A descriptor that is closed with this object.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return number_; }
  int release() { return std::exchange(number_, -1); }
  void reset() {
    if (number_ >= 0) close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

/// The same file by a number that is out of the way.
int moved_up(int descriptor) {
  const int up = fcntl(descriptor, F_DUPFD_CLOEXEC, kAbove);
  const int reason = errno;
  close(descriptor);
  if (up < 0) throw std::runtime_error(std::string("no file descriptor: ") + strerror(reason));
  return up;
}

struct Pipe {
  Pipe() : Pipe(opened()) {}
  Descriptor read, write;

 private:
  explicit Pipe(const std::array<int, 2>& ends)
      : read(moved_up(ends[0])), write(moved_up(ends[1])) {}
  static std::array<int, 2> opened() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw std::runtime_error(std::string("no pipe: ") + strerror(errno));
    }
    return ends;
  }
};

int opened(const std::string& file, int how) {
  const int descriptor = open(file.c_str(), how | O_CLOEXEC, 0666);
  if (descriptor < 0) throw std::runtime_error(file + ": " + strerror(errno));
  return moved_up(descriptor);
}

/// For execve(), which wants pointers.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

std::vector<std::string> environment_with(const std::string& name, const std::string& value) {
  std::vector<std::string> list;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (std::strncmp(*entry, (name + "=").c_str(), name.size() + 1) != 0) list.emplace_back(*entry);
  }
  list.push_back(name + "=" + value);
  return list;
}

/// All that the child needs, made before it is: a fork of a process with threads may not allocate.
struct Start {
  pid_t parent;
  char* const* arguments;
  char* const* environment;
  int input, log, progress, failure;
  bool gives_way;
};

/// Tells the parent why.
[[noreturn]] void give_up(int failure) {
  const int reason = errno;
  const ssize_t told = write(failure, &reason, sizeof(reason));
  _exit(told == sizeof(reason) ? kNotStarted : kNotStarted + 1);
}

/// Gives other processes the processor first. Where the kernel shares it among sessions before it
/// looks at their processes, the session itself has to.
void give_way() {
  setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + ChildProcess::kNiceness);
  const int session = open("/proc/self/autogroup", O_WRONLY | O_CLOEXEC);
  if (session < 0) return;  // a kernel that does not
  static_assert(ChildProcess::kNiceness == 10, "is written below: nothing is allocated here");
  const ssize_t written = write(session, "10", 2);
  static_cast<void>(written);  // it may be refused
  close(session);
}

[[noreturn]] void become(const Start& start) {
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGINT);
  if (getppid() != start.parent) _exit(kNotStarted);  // it ended before the kernel was asked
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) {
    std::signal(number, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (start.gives_way) give_way();
  const bool placed = dup2(start.input, STDIN_FILENO) >= 0 && dup2(start.log, STDOUT_FILENO) >= 0 &&
                      dup2(start.log, STDERR_FILENO) >= 0 && dup2(start.progress, kProgress) >= 0 &&
                      dup3(start.failure, kFailure, O_CLOEXEC) >= 0;
  if (!placed) give_up(start.failure);
  // Sockets of a node that ends would stay open with the child's copies.
  if (close_range(kFailure + 1, ~0U, 0) != 0) {
    const auto count = static_cast<int>(sysconf(_SC_OPEN_MAX));
    for (int descriptor = kFailure + 1; descriptor < count; ++descriptor) close(descriptor);
  }
  execve(start.arguments[0], start.arguments, start.environment);
  give_up(kFailure);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& log,
                           bool gives_way) {
  std::vector<std::string> words = command;
  std::vector<std::string> settings =
      environment_with(tool::progress_lines::kVariable, std::to_string(kProgress));
  const std::vector<char*> arguments = pointers_to(words), environment = pointers_to(settings);
  const Descriptor input(opened("/dev/null", O_RDONLY));
  const Descriptor output(opened(log, O_WRONLY | O_CREAT | O_APPEND));
  Pipe progress, failure;
  const Start start{getpid(),     arguments.data(),     environment.data(),  input.get(),
                    output.get(), progress.write.get(), failure.write.get(), gives_way};
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error(command[0] + ": " + strerror(errno));
  if (pid_ == 0) become(start);
  failure.write.reset();
  int reason = 0;
  ssize_t count = 0;
  do {
    count = read(failure.read.get(), &reason, sizeof(reason));  // nothing once it has begun
  } while (count < 0 && errno == EINTR);
  if (count == sizeof(reason)) {
    waitpid(pid_, nullptr, 0);
    throw std::runtime_error(command[0] + ": cannot be started: " + strerror(reason));
  }
  fcntl(progress.read.get(), F_SETFL, O_NONBLOCK);
  progress_ = progress.read.release();
}

ChildProcess::~ChildProcess() {
  close(progress_);
}

std::string ChildProcess::read_progress() {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = read(progress_, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::optional<ProcessEnd> ChildProcess::end() {
  int status = 0;
  if (end_ || waitpid(pid_, &status, WNOHANG) != pid_) return end_;
  end_ = ProcessEnd{};
  if (WIFSIGNALED(status)) end_->signal = WTERMSIG(status);
  end_->exit_code = end_->signal ? 128 + *end_->signal : WEXITSTATUS(status);
  return end_;
}

void ChildProcess::interrupt() {
  if (!end()) kill(-pid_, SIGINT);
}

}  // namespace jobs
}  // namespace anthrob
