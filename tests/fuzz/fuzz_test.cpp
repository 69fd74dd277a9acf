#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "give.h"
#include "mutator.h"
#include "readers.h"

namespace anthrob {
namespace fuzz {
namespace {

/// A thousandth of what `./catkin_ws.sh study fuzz` gives each reader.
constexpr std::uint64_t kInputs = 300;

TEST(Fuzz, ReadersAcceptOrRefuseWithOneLine) {
  const auto work =
      std::filesystem::temp_directory_path() / ("anthrob_fuzz_" + std::to_string(::getpid()));
  for (const Reader& reader : all_readers(ANTHROB_CONFIG_DIR, work.string())) {
    SCOPED_TRACE(reader.name);
    EXPECT_NO_THROW(give_sound(reader));
    std::uint64_t refused = 0;
    for (std::uint64_t number = 0; number < kInputs; ++number) {
      SCOPED_TRACE(number);
      try {
        refused += give(reader, mutated(reader.sound, number)) ? 0 : 1;
      } catch (const std::logic_error& error) {
        ADD_FAILURE() << error.what();
      }
    }
    // All accepted: it does not look. All refused: the damage is too coarse to get far.
    EXPECT_GT(refused, kInputs / 20);
    EXPECT_LT(refused, kInputs);
  }
  std::filesystem::remove_all(work);
}

TEST(Fuzz, TheSameNumberGivesTheSameFile) {
  const std::vector<std::string> sound = {"a: [1, 2.5]\n", "b: {c: d}\n"};
  EXPECT_EQ(mutated(sound, 7), mutated(sound, 7));
  EXPECT_NE(mutated(sound, 7), mutated(sound, 8));
}

}  // namespace
}  // namespace fuzz
}  // namespace anthrob
