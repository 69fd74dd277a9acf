// Which libraries a model may load.
#include "effects/trusted_libraries.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace anthrob {
namespace {

namespace fs = std::filesystem;

TEST(TrustedLibraries, ByName) {
  EXPECT_TRUE(is_trusted("my_effects", "libmy_effects.so", "other:my_effects"));
  EXPECT_TRUE(is_trusted("my_effects", "libmy_effects.so", "libmy_effects.so"));
  EXPECT_FALSE(is_trusted("my_effects", "libmy_effects.so", ""));
  EXPECT_FALSE(is_trusted("my_effects", "libmy_effects.so", "my"));
  EXPECT_FALSE(is_trusted("my_effects", "libmy_effects.so", "/"));  // found on LD_LIBRARY_PATH
  EXPECT_FALSE(is_trusted("", "", ":"));
}

TEST(TrustedLibraries, ByFolder) {
  EXPECT_TRUE(is_trusted("lib/a.so", "/lab/robot/lib/a.so", "/lab/robot"));
  EXPECT_TRUE(is_trusted("lib/a.so", "/lab/robot/lib/a.so", "/else:/lab/robot/lib/"));
  EXPECT_TRUE(is_trusted("lib/a.so", "/lab/robot/lib/a.so", "/lab/robot/lib/a.so"));
  EXPECT_FALSE(is_trusted("lib/a.so", "/lab/robot/lib/a.so", "/lab/rob"));
  EXPECT_FALSE(is_trusted("lib/a.so", "/lab/robot/lib/a.so", "/lab/robot/lib/b.so"));
  EXPECT_FALSE(is_trusted("../a.so", "/lab/robot/../a.so", "/lab/robot"));
}

TEST(TrustedLibraries, ALinkIsWhatItLeadsTo) {
  const fs::path top = fs::temp_directory_path() / ("anthrob_trust_" + std::to_string(getpid()));
  fs::create_directories(top / "mine");
  fs::create_directories(top / "theirs");
  std::ofstream(top / "theirs/a.so") << "code";
  fs::create_symlink(top / "theirs/a.so", top / "mine/a.so");
  EXPECT_FALSE(is_trusted("a.so", (top / "mine/a.so").string(), (top / "mine").string()));
  EXPECT_TRUE(is_trusted("a.so", (top / "mine/a.so").string(), (top / "theirs").string()));
  fs::remove_all(top);
}

}  // namespace
}  // namespace anthrob
