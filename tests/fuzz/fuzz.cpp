// Gives damaged files to the readers of this suite, all in one process. What a reader does not
// refuse with an exception of one line ends the process: a signal, a finding of a sanitizer, more
// than 10 s.
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "give.h"
#include "mutator.h"
#include "readers.h"

/// Of malformed STL files assimp leaks 2.5 kB each.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libassimp\n";
}

namespace {

using anthrob::fuzz::Reader;

constexpr unsigned kLongest = 10;          // [s] of the processor
constexpr unsigned kLongestWaiting = 120;  // [s] on a busy machine

struct Counts {
  std::uint64_t accepted = 0, refused = 0;
  double slowest = 0.0;  ///< [s]
};

void hang(int) {
  const char text[] = "anthrob_fuzz: an input takes more than 10 s\n";
  (void)!::write(2, text, sizeof(text) - 1);
  std::abort();
}

void watch_for_hangs() {
  itimerval longest{};
  longest.it_value.tv_sec = kLongest;
  ::setitimer(ITIMER_PROF, &longest, nullptr);
  ::alarm(kLongestWaiting);
}

void tell(const Counts& counts, std::uint64_t next) {
  std::cout << next << " " << counts.accepted << " " << counts.refused << " " << counts.slowest
            << std::endl;
}

void run(const Reader& reader, std::uint64_t first, std::uint64_t end, std::uint64_t every) {
  using Clock = std::chrono::steady_clock;
  Counts counts;
  for (std::uint64_t number = first; number < end; ++number) {
    const std::string input = anthrob::fuzz::mutated(reader.sound, number);
    watch_for_hangs();
    const auto begin = Clock::now();
    ++(anthrob::fuzz::give(reader, input) ? counts.accepted : counts.refused);
    const std::chrono::duration<double> taken = Clock::now() - begin;
    counts.slowest = std::max(counts.slowest, taken.count());
    if ((number + 1) % every != 0 && number + 1 != end) continue;
    tell(counts, number + 1);
    counts = {};
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Gives damaged files to a reader, in one process.");
  std::string name, config, work;
  std::uint64_t first = 0, end = 1000, every = 1000;
  bool list = false;
  app.add_option("--config", config, "the folder config/ of this suite")->required();
  app.add_option("--work", work, "folder for files")->required();
  app.add_option("--reader", name, "which one");
  app.add_option("--first", first, "number of the first input");
  app.add_option("--end", end, "one more than the number of the last");
  app.add_option("--every", every,
                 "inputs of each line: next number, accepted, refused, slowest [s]");
  app.add_flag("--list", list, "only list the readers");
  CLI11_PARSE(app, argc, argv);
  ::signal(SIGALRM, hang);
  ::signal(SIGPROF, hang);
  for (const Reader& reader : anthrob::fuzz::all_readers(config, work)) {
    if (list) std::cout << reader.name << "\n";
    if (!list && reader.name == name) {
      anthrob::fuzz::give_sound(reader);
      run(reader, first, end, every);
      return 0;
    }
  }
  return list ? 0 : 2;
}
