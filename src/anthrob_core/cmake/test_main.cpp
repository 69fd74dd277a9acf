// The main of every test program. `--file=test/path/cylinder_test.cpp` runs the tests of that file only, so that one
// program can be run file by file.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The filter that lets the tests of one file pass; empty if it has none.
std::string filter_of(const std::string& file) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      if (!ends_with(test.file(), "/" + file)) continue;
      filter += std::string(filter.empty() ? "" : ":") + suite.name() + "." + test.name();
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const std::string option = "--file=";
  if (argc > 1 && std::string(argv[1]).rfind(option, 0) == 0) {
    const std::string file = argv[1] + option.size(), filter = filter_of(file);
    if (filter.empty()) {
      std::fprintf(stderr, "%s: this program has no test in %s\n", argv[0], file.c_str());
      return 2;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  return RUN_ALL_TESTS();
}
