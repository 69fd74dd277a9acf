#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>

#include "anthrob_core/files.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  AtomicFileTest() : folder_("/tmp/anthrob_atomic_file_" + std::to_string(getpid())) {
    fs::create_directory(folder_);
  }
  ~AtomicFileTest() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string text(const std::string& name) const {
    std::ifstream in(path(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  std::string folder_;
};

TEST_F(AtomicFileTest, TheOldOneStaysUntilTheNewOneIsWhole) {
  write_file_atomically(path("a"), "old");
  {
    AtomicFile file(path("a"));
    file.stream() << "new";
    file.close();
    EXPECT_EQ(text("a"), "old");
    file.move_into_place();
    EXPECT_EQ(text("a"), "new");
  }
  {
    AtomicFile file(path("a"));
    file.stream() << "half";
  }
  EXPECT_EQ(text("a"), "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, WhatWasNotFinishedLiesBesideTheOldOne) {
  write_file_atomically(path("a"), "old");
  AtomicFile file(path("a"));
  file.stream() << "half";
  file.close();
  EXPECT_EQ(file.move_beside(), path("a.partial"));
  EXPECT_EQ(text("a"), "old");
  EXPECT_EQ(text("a.partial"), "half");
}

TEST_F(AtomicFileTest, OfSeveralAllAreReplacedOrNone) {
  write_files_atomically({{path("a"), "1"}, {path("b"), "2"}});
  EXPECT_EQ(text("a") + text("b"), "12");
  try {
    write_files_atomically({{path("a"), "3"}, {path("nowhere/b"), "4"}});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              path("nowhere/b") + ": cannot be written: No such file or directory");
  }
  EXPECT_EQ(text("a") + text("b"), "12");
  EXPECT_EQ(files(), 2);
}

TEST_F(AtomicFileTest, FoldersThatWereMadeForNothingGoAgain) {
  MadeFolder made(path("new/a/b"));
  EXPECT_TRUE(made.exists());
  EXPECT_TRUE(fs::is_directory(path("new/a/b")));
  made.take_back();
  EXPECT_FALSE(fs::exists(path("new")));
  fs::create_directory(path("old"));
  MadeFolder beside(path("old/c/"));
  write_file_atomically(path("old/file"), "x");
  beside.take_back();
  EXPECT_FALSE(fs::exists(path("old/c")));
  EXPECT_EQ(text("old/file"), "x");
  MadeFolder used(path("used/d"));
  write_file_atomically(path("used/d/file"), "x");
  used.take_back();
  EXPECT_EQ(text("used/d/file"), "x");
  MadeFolder impossible(path("old/file/e"));
  EXPECT_FALSE(impossible.exists());
}

}  // namespace
}  // namespace anthrob
