// The offline command: its contract, and one clear line for everything that is wrong; and those
// that calibrate.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "source/image_file.h"
#include "support.h"
#include "temporary_folder.h"

namespace anthrob {
namespace mocap {
namespace {

using test::make_rig;
using test::make_targets;

constexpr int kFrames = 8;

class Offline : public ::testing::Test {
 protected:
  void SetUp() override {
    const StereoRig rig = make_rig();
    folder_.folder("calibration"), folder_.folder("left"), folder_.folder("right");
    folder_.write("calibration/left.yaml", rig.camera(kLeft).to_yaml());
    folder_.write("calibration/right.yaml", rig.camera(kRight).to_yaml());
    folder_.write("targets.yaml", make_targets().to_yaml());
    static Renderer renderer(rig, RenderOptions());
    const test::Motion motion = test::swing(0.4, 1.0);
    for (int i = 0; i < kFrames; ++i) {
      Scene scene = test::scene_of(make_targets(), motion(i / 60.0));
      if (i == 5) scene.spheres.resize(5);  // the humerus is hidden once
      for (const Side side : {kLeft, kRight}) {
        Image image;
        renderer.render(side, {scene}, static_cast<std::uint64_t>(i), image);
        write_grey_image(file(name(side), i), image);
      }
    }
  }
  std::string file(const std::string& side, int i) const {
    char text[16];
    std::snprintf(text, sizeof(text), "/%06d.png", i);
    return folder_.path(side) + text;
  }
  static std::string times_of_pairs() {
    std::string times = "index,t\n";
    for (int i = 0; i < kFrames; ++i) {
      times += std::to_string(i) + "," + std::to_string(100.0 + 0.01 * i) + "\n";
    }
    return times;
  }
  int run(const std::string& more = "", const std::string& left = "left",
          const std::string& right = "right") {
    const std::string command = std::string(ANTHROB_MOCAP_OFFLINE) + " --left " +
                                folder_.path(left) + " --right " + folder_.path(right) +
                                " --calibration " + folder_.path("calibration") + " --targets " +
                                folder_.path("targets.yaml") + " --out " + out_ + " " + more +
                                " > " + folder_.path("out") + " 2> " + folder_.path("err");
    return WEXITSTATUS(std::system(command.c_str()));
  }
  void refuse(const std::string& part, const std::string& left = "left",
              const std::string& right = "right") {
    EXPECT_EQ(run("", left, right), 2);
    const std::string error = folder_.read("err");
    EXPECT_NE(error.find(part), std::string::npos) << error << "expected: " << part;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
  }
  std::vector<std::vector<std::string>> table() const {
    std::istringstream in(folder_.read("poses.csv"));
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(in, line);) {
      std::vector<std::string> cells(1);
      for (const char c : line) {
        if (c == ',')
          cells.emplace_back();
        else
          cells.back() += c;
      }
      rows.push_back(cells);
    }
    return rows;
  }

  test::TemporaryFolder folder_;
  std::string out_ = folder_.path("poses.csv");
};

TEST_F(Offline, WritesPosesAndJoints) {
  ASSERT_EQ(run(), 0) << folder_.read("err");
  const auto rows = table();
  ASSERT_EQ(rows.size(), kFrames + 1u);
  const std::vector<std::string> header{
      "t",           "scapula/valid",  "scapula/x",  "scapula/y",   "scapula/z",     "scapula/qw",
      "scapula/qx",  "scapula/qy",     "scapula/qz", "scapula/rms", "humerus/valid", "humerus/x",
      "humerus/y",   "humerus/z",      "humerus/qw", "humerus/qx",  "humerus/qy",    "humerus/qz",
      "humerus/rms", "shoulder/valid", "shoulder/w", "shoulder/x",  "shoulder/y",    "shoulder/z"};
  EXPECT_EQ(rows[0], header);
  const auto number = [&](int row, std::size_t column) {
    return std::stod(rows[static_cast<std::size_t>(row) + 1][column]);
  };
  for (int i = 0; i < kFrames; ++i) {
    const auto& row = rows[static_cast<std::size_t>(i) + 1];
    ASSERT_EQ(row.size(), header.size());
    EXPECT_DOUBLE_EQ(number(i, 0), i / 60.0);
    EXPECT_EQ(row[1], "1");
    if (i == 5) {
      EXPECT_EQ(row[10], "0");
      EXPECT_EQ(row[19], "0");
      for (const std::size_t column : {11, 17, 18, 20, 23}) EXPECT_EQ(row[column], "");
      continue;
    }
    const auto truth = test::swing(0.4, 1.0)(i / 60.0);
    const Quat q(number(i, 20), number(i, 21), number(i, 22), number(i, 23));
    EXPECT_LT(angular_distance(q.toRotationMatrix(), truth[0].R.transpose() * truth[1].R),
              0.1 * test::kDegree);
    EXPECT_NEAR(number(i, 11), truth[1].p.x(), 2e-4);
    EXPECT_LT(number(i, 18), 1e-3);
  }
}

TEST_F(Offline, GivesTheSameFileThreaded) {
  ASSERT_EQ(run(), 0);
  const std::string sequential = folder_.read("poses.csv");
  ASSERT_EQ(run("--pipeline threaded"), 0);
  EXPECT_EQ(folder_.read("poses.csv"), sequential);
}

TEST_F(Offline, TakesTimesFromAFile) {
  const std::string times = times_of_pairs();
  folder_.write("left/times.csv", times);
  ASSERT_EQ(run(), 0) << folder_.read("err");
  EXPECT_DOUBLE_EQ(std::stod(table()[3][0]), 100.02);
  folder_.write("right/times.csv", test::replaced(times, "100.030000", "100.045000"));
  refuse("right/times.csv: 000004.png: expected times that increase");
  EXPECT_EQ(run("--sync-tolerance nan"), 2);
  folder_.write("right/times.csv", times.substr(0, times.rfind('\n', times.size() - 2) + 1));
  refuse("right/times.csv: no time for");
  folder_.write("right/times.csv", "index,t\n0,zero\n");
  refuse("times.csv:2: 0,zero: expected index,t");
  std::filesystem::remove(folder_.path("right/times.csv"));
  folder_.write("left/times.csv", "index,t\n0,1\n");
  refuse("no time for 000001.png");
}

TEST_F(Offline, PairsByTheTimesOfTwoFiles) {
  const std::string times = times_of_pairs();
  folder_.write("left/times.csv", times);
  folder_.write("right/times.csv", test::replaced(times, "100.030000", "100.034000"));
  ASSERT_EQ(run(), 0) << folder_.read("err");
  EXPECT_EQ(table().size(), kFrames + 0u);
  EXPECT_NE(folder_.read("err").find(
                ": 2 of 16 pictures have no partner within 2 ms and were left out\n"),
            std::string::npos)
      << folder_.read("err");
  EXPECT_EQ(run("--sync-tolerance 0.0045"), 0);
  EXPECT_EQ(folder_.read("err"), "");
  EXPECT_EQ(table().size(), kFrames + 1u);
}

TEST_F(Offline, PairsWhatWasTakenAtOneTimeUnderOtherNames) {
  ASSERT_EQ(run(), 0);
  const auto by_name = table();
  // The right camera missed the first picture, and counts from 0 nevertheless.
  folder_.write("left/times.csv", times_of_pairs());
  std::string times;
  for (int i = 1; i < kFrames; ++i) {
    std::filesystem::rename(file("right", i), file("right", i - 1));
    times += std::to_string(i - 1) + "," + std::to_string(100.0005 + 0.01 * i) + "\n";
  }
  folder_.write("right/times.csv", times);
  ASSERT_EQ(run(), 0) << folder_.read("err");
  const auto by_time = table();
  ASSERT_EQ(by_time.size(), by_name.size() - 1);
  for (std::size_t i = 1; i < by_time.size(); ++i) {
    EXPECT_DOUBLE_EQ(std::stod(by_time[i][0]), 100.0 + 0.01 * static_cast<double>(i));
    EXPECT_EQ(by_time[i][2], by_name[i + 1][2]);
  }
  std::string late = times_of_pairs();
  for (std::size_t at = 0; (at = late.find("0000\n", at)) != std::string::npos; ++at) {
    late.replace(at, 4, "4000");
  }
  folder_.write("right/times.csv", late);
  refuse(
      "unsynchronised pair: 8 left and 7 right images, none within 2.0 ms; nearest 4.0 ms apart");
}

TEST_F(Offline, TakesTheTimesBesideEitherFolder) {
  const std::string times = times_of_pairs();
  ASSERT_EQ(run(), 0);
  EXPECT_NE(folder_.read("err").find("no times.csv: taken to be 60 pairs a second"),
            std::string::npos);
  folder_.folder("other");
  std::filesystem::rename(folder_.path("right"), folder_.path("other/right"));
  folder_.write("other/times.csv", times);
  ASSERT_EQ(run("", "left", "other/right"), 0) << folder_.read("err");
  EXPECT_EQ(folder_.read("err"), "");
  EXPECT_DOUBLE_EQ(std::stod(table()[3][0]), 100.02);
  folder_.write("times.csv", test::replaced(times, "100.030000", "100.035000"));
  ASSERT_EQ(run("", "left", "other/right"), 0) << folder_.read("err");
  EXPECT_NE(folder_.read("err").find("2 of 16 pictures have no partner"), std::string::npos);
}

TEST_F(Offline, RefusesTimesThatAreNone) {
  for (const char* place : {"times.csv", "left/times.csv", "right/times.csv"}) {
    for (const char* none : {"", "index,t\n"}) {
      folder_.write(place, none);
      refuse("times.csv: holds no time: expected lines index,t");
    }
    std::filesystem::remove(folder_.path(place));
  }
  folder_.folder("left/times.csv");
  refuse("left/times.csv: holds no time");
}

TEST_F(Offline, RefusesTimesThatNoStampCanSay) {
  for (const char* t : {"-1", "4294967296", "1e300", "inf", "nan"}) {
    const std::string line = std::string("1,") + t;
    folder_.write("left/times.csv", "index,t\n0,1\n" + line + "\n");
    refuse("left/times.csv:3: " + line + ": expected a time >= 0 and below 2^32 [s]");
  }
  std::filesystem::remove(folder_.path("left/times.csv"));
  for (const std::string side : {"left", "right"}) {
    std::filesystem::rename(file(side, kFrames - 1), folder_.path(side) + "/20260101120000123.png");
  }
  refuse("right: 20260101120000123.png: number 20260101120000123 at 60.0");
}

TEST_F(Offline, RefusesImagesItCannotUse) {
  const std::string good = folder_.read("left/000003.png");
  folder_.write("left/000003.png", good.substr(0, good.size() / 2));
  refuse("left/000003.png: truncated image");
  // A bit of the pixels: one line, none of the decoder's beside it.
  std::string flipped = good;
  flipped[good.find("IDAT") + 100] ^= 0x10;
  folder_.write("left/000003.png", flipped);
  refuse("left/000003.png: damaged image: wrong checksum");
  folder_.write("left/000003.png", "not an image");
  refuse("left/000003.png: not an image that can be decoded");
  for (const std::string header :
       {"P5\n648 488\n255\n", "P5 # by hand\n# white\n648\t488 65535 "}) {
    folder_.write("left/000003.png", header + std::string(648 * 488 - 1, 'a'));
    refuse("left/000003.png: truncated image");
  }
  folder_.write("left/000003.png", "P5\n648");
  refuse("left/000003.png: truncated image");
  folder_.write("left/000003.png", "P5\n648 488\n255\n" + std::string(648 * 488, '\0'));
  EXPECT_EQ(run(), 0) << folder_.read("err");
  folder_.write("left/000003.png", "");
  refuse("left/000003.png: the file is empty");
  cv::imwrite(file("left", 3), cv::Mat(488, 648, CV_16U, cv::Scalar(0)));
  refuse("left/000003.png: 16-bit image of 1 channel(s): expected 8-bit grey");
  cv::imwrite(file("left", 3), cv::Mat(488, 648, CV_8UC3, cv::Scalar(0)));
  refuse("left/000003.png: 8-bit image of 3 channel(s): expected 8-bit grey");
  cv::imwrite(file("left", 3), cv::Mat(487, 647, CV_8U, cv::Scalar(0)));
  refuse("left/000003.png: 647x487 pixels: expected 648x488");
  std::filesystem::remove(file("left", 3));
  refuse("left: no 000003.png");
  refuse("nowhere: no such folder", "nowhere");
  refuse("calibration: holds no image", "calibration");
}

TEST_F(Offline, LeavesOutThePairsOfAFewPicturesItCannotUse) {
  const int count = 3 * kFrames;
  for (const std::string side : {"left", "right"}) {
    for (int i = kFrames; i < count; ++i) {
      std::filesystem::copy(file(side, i % kFrames), file(side, i));
    }
  }
  const std::string good = folder_.read("right/000003.png");
  folder_.write("right/000003.png", good.substr(0, good.size() / 2));
  cv::imwrite(file("left", 10), cv::Mat(487, 647, CV_8U, cv::Scalar(0)));
  for (const char* mode : {"--pipeline sequential", "--pipeline threaded"}) {
    ASSERT_EQ(run(mode), 0) << folder_.read("err");
    const auto rows = table();
    ASSERT_EQ(rows.size(), count + 1u);
    for (int i = 0; i < count; ++i) {
      const auto& row = rows[static_cast<std::size_t>(i) + 1];
      EXPECT_DOUBLE_EQ(std::stod(row[0]), i / 60.0);
      EXPECT_EQ(row[1], i == 3 || i == 10 ? "0" : "1") << i;
      EXPECT_EQ(row[2].empty(), i == 3 || i == 10) << i;
    }
    const std::string error = folder_.read("err");
    EXPECT_NE(error.find("warning: 2 of 24 pairs cannot be used and were left out; the first: "),
              std::string::npos)
        << error;
    EXPECT_NE(error.find("right/000003.png: truncated image"), std::string::npos) << error;
    EXPECT_NE(folder_.read("out").find("22 pairs, "), std::string::npos) << folder_.read("out");
  }
  std::filesystem::remove(file("left", 20));
  refuse("right/000003.png: truncated image; 3 or more of 24 pairs cannot be used: expected at");
}

TEST_F(Offline, RefusesWhatDoesNotBelongTogether) {
  refuse("left and right images are swapped", "right", "left");
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path(""))) {
    EXPECT_NE(entry.path().filename().string().rfind("poses.csv", 0), 0u) << entry.path();
  }
  const std::string left = folder_.read("calibration/left.yaml");
  folder_.write("calibration/left.yaml", folder_.read("calibration/right.yaml"));
  folder_.write("calibration/right.yaml", left);
  refuse("left and right are swapped");
  folder_.write("calibration/right.yaml", "image_width: 648\n");
  refuse("right.yaml:1: key 'image_height' is missing");
}

TEST_F(Offline, WarnsOfARigThatWasBentALittle) {
  folder_.write("times.csv", times_of_pairs());
  ASSERT_EQ(run(), 0);
  EXPECT_EQ(folder_.read("err"), "");
  const std::string out = folder_.read("out");
  EXPECT_NE(out.find("humerus in 7 (residual 0.0"), std::string::npos) << out;
  CameraModel tilted = make_rig().camera(kRight);
  tilted.R = exp_rotation({0.0004, 0.0, 0.0}) * tilted.R;
  folder_.write("calibration/right.yaml", tilted.to_yaml());
  EXPECT_EQ(run(), 0);
  const std::string error = folder_.read("err");
  EXPECT_EQ(error.find("warning: rows of left and right differ by "), 0u) << error;
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
  CameraModel turned = make_rig().camera(kRight);
  turned.R = exp_rotation({0.0, 0.003, 0.0}) * turned.R;
  folder_.write("calibration/right.yaml", turned.to_yaml());
  EXPECT_EQ(run(), 0);
  const std::string other = folder_.read("err");
  EXPECT_EQ(other.find("warning: markers are "), 0u) << other;
  EXPECT_EQ(std::count(other.begin(), other.end(), '\n'), 1) << other;
}

TEST_F(Offline, NamesAFileThatCannotBeWritten) {
  out_ = "/nowhere/poses.csv";
  EXPECT_EQ(run(), 1);
  const std::string error = folder_.read("err");
  EXPECT_NE(error.find("/nowhere/poses.csv"), std::string::npos) << error;
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
}

TEST_F(Offline, KnowsItsArguments) {
  EXPECT_EQ(run("--pipeline parallel"), 2);
  EXPECT_EQ(run("--threshold 400"), 2);
  EXPECT_EQ(run("--help"), 0);
  EXPECT_EQ(run("--out /nowhere/poses.csv"), 2);  // twice
  EXPECT_EQ(std::system((std::string(ANTHROB_MOCAP_OFFLINE) + " 2> /dev/null").c_str()) >> 8, 2);
}

/// A recording of both targets of which by hand only the humerus is known to a centimetre.
class CalibrateTarget : public ::testing::Test {
 protected:
  void SetUp() override {
    const StereoRig rig = make_rig();
    folder_.folder("calibration"), folder_.folder("left"), folder_.folder("right");
    folder_.write("calibration/left.yaml", rig.camera(kLeft).to_yaml());
    folder_.write("calibration/right.yaml", rig.camera(kRight).to_yaml());
    TargetSet by_hand = make_targets();
    by_hand.joints.clear();
    by_hand.targets[0].markers = {{0.0, 0.0, 0.0}, {0.05, 0.0, 0.0}, {0.0255, 0.0433, 0.0}};
    by_hand.targets[1].markers[0].x() += 0.003;
    folder_.write("by_hand.yaml", by_hand.to_yaml());
    Renderer renderer(rig, RenderOptions());
    const test::Motion motion = test::swing(0.6, 1.0);
    for (int i = 0; i < 24; ++i) {
      const Scene scene = test::scene_of(make_targets(), motion(i / 5.0));
      for (const Side side : {kLeft, kRight}) {
        Image image;
        renderer.render(side, {scene}, static_cast<std::uint64_t>(i), image);
        write_grey_image(folder_.path(name(side)) + "/" + std::to_string(100 + i) + ".png", image);
      }
    }
  }
  int run(const std::string& more = "", const std::string& left = "left",
          const std::string& right = "right") {
    const std::string command = std::string(ANTHROB_MOCAP_CALIBRATE_TARGET) + " --left " +
                                folder_.path(left) + " --right " + folder_.path(right) +
                                " --calibration " + folder_.path("calibration") + " --targets " +
                                folder_.path("by_hand.yaml") + " --name humerus --out " +
                                folder_.path("targets.yaml") + " " + more + " > " +
                                folder_.path("out") + " 2> " + folder_.path("err");
    return WEXITSTATUS(std::system(command.c_str()));
  }

  test::TemporaryFolder folder_;
};

TEST_F(CalibrateTarget, KeepsItsResultBesideTargetsThatAreGuessesYet) {
  ASSERT_EQ(run(), 0) << folder_.read("err");
  const std::string note = folder_.read("err");
  EXPECT_NE(note.find("target scapula: ambiguous: "), std::string::npos) << note;
  EXPECT_EQ(note.find("target humerus"), std::string::npos) << note;
  EXPECT_EQ(note.find("warning"), std::string::npos) << note;  // guesses need not fit
  const TargetSet result = TargetSet::load(folder_.path("targets.yaml"), TargetSet::kUnchecked);
  const auto edge = [](const TargetSet& set) {
    return (set.targets[1].markers[0] - set.targets[1].markers[1]).norm();
  };
  EXPECT_NEAR(edge(result), edge(make_targets()), 2e-4);
}

TEST_F(CalibrateTarget, TakesGuessesOfOthersWithEqualEdges) {
  TargetSet by_hand = TargetSet::load(folder_.path("by_hand.yaml"), TargetSet::kUnchecked);
  by_hand.targets[0].markers = {{0.0, 0.0, 0.0}, {0.05, 0.0, 0.0}, {0.025, 0.06, 0.0}};
  folder_.write("by_hand.yaml", by_hand.to_yaml());
  EXPECT_EQ(run(), 0) << folder_.read("err");
}

TEST_F(CalibrateTarget, RefusesWhatDoesNotBelongTogether) {
  const auto refuse = [&](int status, const std::string& part) {
    const std::string error = folder_.read("err");
    EXPECT_EQ(status, 2);
    EXPECT_NE(error.find(part), std::string::npos) << error << "expected: " << part;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
  };
  refuse(run("", "right", "left"), "left and right images are swapped");
  std::string times = "index,t\n";
  for (int i = 0; i < 24; ++i) {
    times += std::to_string(100 + i) + "," + std::to_string(100 + i) + ".000\n";
  }
  folder_.write("left/times.csv", times);
  folder_.write("right/times.csv", test::replaced(times, "107.000", "107.005"));
  EXPECT_EQ(run(), 0) << folder_.read("err");
  EXPECT_NE(folder_.read("err").find("2 of 48 pictures have no partner"), std::string::npos);
  EXPECT_EQ(run("--sync-tolerance 0.006"), 0) << folder_.read("err");
  cv::imwrite(folder_.path("left/103.png"), cv::Mat(487, 647, CV_8U, cv::Scalar(0)));
  const auto warned = [&](const std::string& part) {
    const std::string error = folder_.read("err");
    EXPECT_NE(error.find(part), std::string::npos) << error << "expected: " << part;
  };
  EXPECT_EQ(run("--sync-tolerance 0.006"), 0);
  warned("warning: 1 of 24 pairs cannot be used and were left out; the first: ");
  warned("left/103.png: 647x487 pixels: expected 648x488, as in ");
  for (const char* picture : {"left/104.png", "right/105.png"}) folder_.write(picture, "");
  refuse(run("--sync-tolerance 0.006"), "left/103.png: 647x487 pixels: expected 648x488, as in ");
}

TEST_F(CalibrateTarget, RefusesAResultThatIsAmbiguousItself) {
  folder_.write("wide.yaml", "labelling: {edge_tolerance: 0.1}\n");
  EXPECT_EQ(run("--settings " + folder_.path("wide.yaml")), 2);
  const std::string error = folder_.read("err");
  EXPECT_NE(error.find("target humerus: ambiguous: "), std::string::npos) << error;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("targets.yaml")));
}

TEST(Calibrate, PairsPicturesByTheirLastNumber) {
  const test::TemporaryFolder folder;
  for (const std::string file : {"left/rig2_07_l.png", "right/rig2_07_r.png", "right/08.png"}) {
    folder.folder(file.substr(0, file.find('/')));
    cv::imwrite(folder.path(file), cv::Mat(488, 648, CV_8U, cv::Scalar(0)));
  }
  const std::string command = std::string(ANTHROB_MOCAP_CALIBRATE) + " --left " +
                              folder.path("left") + " --right " + folder.path("right") + " > " +
                              folder.path("out") + " 2> " + folder.path("err");
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  const std::string out = folder.read("out");
  EXPECT_EQ(out.find("no partner"), out.rfind("no partner")) << out;
  EXPECT_NE(out.find("right/08.png: no partner in "), std::string::npos) << out;
  for (const char* file : {"rig2_07_l.png: no board of", "rig2_07_r.png: no board of"}) {
    EXPECT_NE(out.find(file), std::string::npos) << out;
  }
}

}  // namespace
}  // namespace mocap
}  // namespace anthrob
