// Pages: the program that makes them writes numbers as the tools do, and says in one line what is
// wrong.
#include "anthrob_recording/page.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "anthrob_core/random.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;

class Page : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void put(const std::string& name, const std::string& text) const {
    write_files(folder_.string(), {{name, text}});
  }
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }
  /// The page of this template over this JSON.
  std::string page(const std::string& form, const std::string& data) const {
    put("form.html.j2", form);
    put("data.json", data);
    write_page(path("form.html.j2"), path("data.json"), path("page.html"));
    return content("page.html");
  }
  std::string complaint(const std::string& name) const {
    try {
      write_page(name, path("data.json"), path("page.html"));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("anthrob_page_test_" + std::to_string(getpid()));
};

TEST_F(Page, HasNumbersAsTheToolsWriteThem) {
  const CounterRandom random(3, 1);
  std::vector<double> values = {0.0, 0.04212, 999.4, 999.6, -26123.4, 2.5e8, 61.4, 119.9, 1040.0};
  for (std::uint64_t i = 0; i < 200; ++i) {
    values.push_back(random.normal(i) * std::pow(10.0, 4.0 * random.normal(1000 + i)));
  }
  std::string data = "{\"values\": [", expected;
  for (const double value : values) {
    char exact[40];
    std::snprintf(exact, sizeof(exact), "%.17g", value);
    data += (expected.empty() ? "" : ", ") + std::string(exact);
    expected += short_number(value) + "|" + significant(value, 5) + "|" +
                duration_text(std::abs(value)) + "\n";
  }
  EXPECT_EQ(page("{% for v in report['values'] %}\n"
                 "{{ v | short }}|{{ v | significant(5) }}|{{ v | abs | duration }}\n"
                 "{% endfor %}\n",
                 data + "]}"),
            expected);
}

TEST_F(Page, WritesWhatIsUnknownInWords) {
  EXPECT_EQ(page("{{ x | short }} {{ x | significant(3) }} {{ 1.0 | probability }} "
                 "{{ 1.005924 | resolved([1.005081, 1.006812]) }}",
                 "{\"x\": null}"),
            "unlimited invalid probability above 0.999 1.0059");
}

TEST_F(Page, EscapesNamesAndDrawsTheFiguresOfTheReportOnly) {
  put("figures/mine.svg", "<svg>mine</svg>");
  put("figures/old.svg", "<svg>old</svg>");
  EXPECT_EQ(page("{{ name }}{{ figure('mine') }}{{ figure('old') }}",
                 R"({"name": "<b>", "figures": ["figures/mine.svg"]})"),
            "&lt;b&gt;<figure><svg>mine</svg></figure>");
}

TEST_F(Page, SaysInOneLineWhatIsWrongAndLeavesNoOldPage) {
  page("{{ name }}", R"({"name": "good"})");
  ASSERT_TRUE(fs::exists(path("page.html")));
  put("data.json", "{}");
  const std::string text = complaint(path("form.html.j2"));
  EXPECT_NE(text.find("'name' is undefined"), std::string::npos) << text;
  EXPECT_NE(text.find("data.json is complete"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  EXPECT_FALSE(fs::exists(path("page.html")));
  EXPECT_NE(complaint("nonsense").find("no such template; expected one of: "), std::string::npos);
  put("data.json", "{");
  EXPECT_NE(complaint("discovery").find("is no JSON"), std::string::npos);
  put("data.json", R"({"name": "x", "figures": ["figures/gone.svg"]})");
  put("form.html.j2", "{{ figure('gone') }}");
  EXPECT_NE(complaint(path("form.html.j2")).find("gone.svg"), std::string::npos);
}

TEST_F(Page, RemovesOnlyFiguresThatSuchAReportMayHave) {
  for (const char* name : {"gap_1", "gap_2", "gap_x", "photo", "fitness"}) {
    put(std::string("figures/") + name + ".svg", "");
  }
  remove_other_figures(folder_.string(), {"gap", "fitness"}, {{"figures/gap_1.svg", ""}});
  EXPECT_TRUE(fs::exists(path("figures/gap_1.svg")));
  EXPECT_FALSE(fs::exists(path("figures/gap_2.svg")));
  EXPECT_FALSE(fs::exists(path("figures/fitness.svg")));
  EXPECT_TRUE(fs::exists(path("figures/gap_x.svg")));
  EXPECT_TRUE(fs::exists(path("figures/photo.svg")));
}

TEST(Figures, AreTheDrawingsAmongTheFiles) {
  EXPECT_EQ(figures_of({{"report.json", ""}, {"figures/a.svg", ""}, {"b.svg", ""}}),
            (std::vector<std::string>{"b.svg", "figures/a.svg"}));
}

}  // namespace
}  // namespace anthrob
