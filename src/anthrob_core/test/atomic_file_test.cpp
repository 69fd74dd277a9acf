#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>
#include <vector>

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

/// @return the number of a process that was there and is gone
pid_t gone() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return child;
}

TEST_F(AtomicFileTest, WhatAKilledProcessLeftIsSwept) {
  const auto part = [&](const std::string& file, pid_t process) {
    const std::string name = file + ".part" + std::to_string(process);
    std::ofstream(path(name)) << "half";
    return path(name);
  };
  const std::string left = part("a", gone());
  const std::string left_by_our_number = part("a", getpid());  // as in a container
  const std::string at_work = part("a", getppid()), of_another = part("b", gone());
  const std::vector<std::string> of_somebody = {path("a.part"), path("a.part0"), path("a.part1x"),
                                                path("a.part-1")};
  for (const std::string& file : of_somebody) std::ofstream(file) << "precious";
  write_file_atomically(path("a"), "whole");
  EXPECT_EQ(text("a"), "whole");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_FALSE(fs::exists(left_by_our_number));
  EXPECT_TRUE(fs::exists(at_work));
  EXPECT_TRUE(fs::exists(of_another));
  for (const std::string& file : of_somebody) EXPECT_TRUE(fs::exists(file)) << file;
}

TEST_F(AtomicFileTest, NobodysLinkIsFollowed) {
  std::ofstream(path("precious")) << "precious";
  const std::string part = path("a.part" + std::to_string(getpid()));
  fs::create_symlink(path("precious"), part);
  write_file_atomically(path("a"), "whole");
  EXPECT_EQ(text("precious"), "precious");
  EXPECT_EQ(text("a"), "whole");
  fs::create_symlink(path("not_there"), part);
  write_file_atomically(path("a"), "again");
  EXPECT_FALSE(fs::exists(path("not_there")));
  fs::create_directories(part + "/kept");  // cannot be swept
  EXPECT_THROW(write_file_atomically(path("a"), "other"), std::runtime_error);
  EXPECT_TRUE(fs::exists(part + "/kept"));
  EXPECT_EQ(text("a"), "again");
}

TEST_F(AtomicFileTest, TwoWritersOfOneProcessDoNotShareAPart) {
  AtomicFile first(path("a"));
  first.stream() << "first";
  EXPECT_THROW(AtomicFile(path("a")), std::runtime_error);
  EXPECT_THROW(AtomicFile(path("./a")), std::runtime_error);
  first.close();
  first.move_into_place();
  write_file_atomically(path("a"), "second");
  EXPECT_EQ(text("a"), "second");
}

TEST_F(AtomicFileTest, OnePlaceHasOnePath) {
  fs::create_directory(path("same"));
  fs::create_directory_symlink(path("same"), path("link"));
  const fs::path place = fs::canonical(path("same"));
  for (const char* name : {"same", "same/", "./same", "nox/../same", "nox/deep/../../same",
                           "nox/../link", "link/new/.."}) {
    const fs::path found = place_of(path(name));
    EXPECT_EQ(found.has_filename() ? found : found.parent_path(), place) << name;
  }
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_EQ(place_of("nox/../same"), place);
  EXPECT_EQ(place_of("new"), fs::canonical(folder_) / "new");
  fs::current_path(before);
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
