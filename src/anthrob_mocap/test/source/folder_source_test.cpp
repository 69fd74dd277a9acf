// Sources: folders, pairing by stamps, and cameras through aravis, one of which dies and comes
// back.
#include "source/folder_source.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <thread>

#include "expect_bad_input.h"
#include "source/aravis_source.h"
#include "source/image_file.h"
#include "source/live_pair.h"
#include "source/pairing.h"
#include "temporary_folder.h"
#ifdef ANTHROB_HAVE_DC1394
#include "source/dc1394_source.h"
#endif

namespace anthrob {
namespace mocap {
namespace {

TimedImage at(double t) {
  TimedImage image;
  image.t = t;
  return image;
}

/// Two folders of pictures, each all of the grey level that is its number.
class Folders : public ::testing::Test {
 protected:
  void write(const std::string& name, int grey) {
    Image image;
    image.resize(4, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::uint8_t>(grey));
    for (const char* side : {"left", "right"}) {
      folder_.folder(side);
      write_grey_image(folder_.path(side) + "/" + name, image);
    }
  }
  FolderSource open() const {
    return FolderSource(folder_.path("left"), folder_.path("right"), FolderSource::Options());
  }
  /// Grey levels in the order of the source, with their times.
  std::vector<std::pair<int, double>> read() const {
    FolderSource source = open();
    std::vector<std::pair<int, double>> result;
    StereoFrame frame;
    while (source.next(frame, 0.0) == FrameSource::Grab::kFrame) {
      EXPECT_EQ(frame.image[kLeft].row(0)[0], frame.image[kRight].row(0)[0]);
      result.emplace_back(frame.image[kLeft].row(0)[0], frame.t);
    }
    return result;
  }

  test::TemporaryFolder folder_;
};

TEST_F(Folders, AreReadInTheOrderOfTheirNumbers) {
  for (int i = 0; i < 12; ++i) write("img" + std::to_string(i) + ".png", i);
  const auto frames = read();
  ASSERT_EQ(frames.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(frames[static_cast<std::size_t>(i)].first, i);
    EXPECT_DOUBLE_EQ(frames[static_cast<std::size_t>(i)].second, i / 60.0);
  }
}

TEST_F(Folders, TakeTheTimesOfTheirNumbers) {
  for (const int i : {0, 1, 2, 3, 7, 8}) {
    write("rig2_frame_00000" + std::to_string(i) + ".png", i);
  }
  std::string times = "index,t\n";
  for (int i = 0; i < 9; ++i) times += std::to_string(i) + "," + std::to_string(100 + i) + "\n";
  folder_.write("times.csv", times);
  const auto frames = read();
  ASSERT_EQ(frames.size(), 6u);
  for (const auto& [grey, t] : frames) EXPECT_EQ(t, 100.0 + grey);
}

TEST_F(Folders, OfNamesWithoutNumbersAreInTheirOrder) {
  write("b.png", 1), write("a.png", 0);
  const std::vector<std::pair<int, double>> expected = {{0, 0.0}, {1, 1.0 / 60.0}};
  EXPECT_EQ(read(), expected);
  write("2.png", 2);
  test::expect_bad_input([&] { open(); }, "expected a number in the name");
}

TEST_F(Folders, OfStampsWithDecimalsAreInTheirOrder) {
  const char* const stamps[] = {"1700000000.900000", "1700000001.100000", "1700000002.500000",
                                "1700000003.900000"};
  for (int i = 0; i < 4; ++i) write(std::string(stamps[i]) + ".png", i);
  const auto frames = read();
  ASSERT_EQ(frames.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(frames[static_cast<std::size_t>(i)].first, i);
    EXPECT_DOUBLE_EQ(frames[static_cast<std::size_t>(i)].second, i / 60.0);
  }
}

TEST_F(Folders, HaveFaultsWhereAPictureIsMissingOrDamaged) {
  for (int i = 0; i < 20; ++i) write(std::to_string(i) + ".png", i);
  std::filesystem::remove(folder_.path("left/4.png"));
  folder_.write("right/7.png", "");
  std::filesystem::remove(folder_.path("right/19.png"));
  FolderSource source = open();
  EXPECT_EQ(source.pairs(), 20u);
  for (int i = 0; i < 20; ++i) {
    StereoFrame frame;
    ASSERT_EQ(source.next(frame, 0.0), FrameSource::Grab::kFrame);
    EXPECT_DOUBLE_EQ(frame.t, i / 60.0);
    const bool sound = i != 4 && i != 7 && i != 19;
    EXPECT_EQ(frame.fault.has_value(), !sound) << i;
    for (const Side side : {kLeft, kRight}) EXPECT_EQ(frame.image[side].width, sound ? 4 : 0);
    const std::string fault = frame.fault.value_or("");
    const std::map<int, std::string> said = {{4, "left: no 4.png, which"},
                                             {7, "right/7.png: the file is empty"},
                                             {19, "right: no 19.png, which"}};
    if (!sound) {
      EXPECT_NE(fault.find(said.at(i)), std::string::npos) << fault;
    }
  }
  std::filesystem::remove(folder_.path("left/5.png"));
  test::expect_bad_input([&] { open(); },
                         "right: no 19.png, which the other folder has: expected the same names in "
                         "both, but for a tenth; 3 of 20 are in one only");
}

TEST_F(Folders, WithOneNumberTwiceAreRefused) {
  write("cam1_7.png", 1), write("cam2_07.png", 2);
  test::expect_bad_input([&] { open(); },
                         "right: cam1_7.png and cam2_07.png have the same number in their names");
}

TEST(Pairing, FindsPartnersInAnyOrder) {
  Pairing pairing(0.002);
  TimedImage pair[2];
  EXPECT_FALSE(pairing.add(kLeft, at(0.000), pair));
  EXPECT_FALSE(pairing.add(kLeft, at(0.016), pair));
  EXPECT_TRUE(pairing.add(kRight, at(0.001), pair));
  EXPECT_EQ(pair[kLeft].t, 0.0);
  EXPECT_FALSE(pairing.add(kRight, at(0.032), pair));
  EXPECT_TRUE(pairing.add(kLeft, at(0.033), pair));
  EXPECT_EQ(pair[kRight].t, 0.032);
  EXPECT_EQ(Pairing::complaint(pairing.take_counts(), 0.002), std::nullopt);
}

TEST(Pairing, WantsEqualStampsIfToldSo) {
  Pairing pairing(0.0);
  TimedImage pair[2];
  EXPECT_FALSE(pairing.add(kLeft, at(1.0), pair));
  EXPECT_FALSE(pairing.add(kRight, at(1.0 + 1e-9), pair));
  EXPECT_TRUE(pairing.add(kLeft, at(1.0 + 1e-9), pair));
}

TEST(Pairing, SaysWhatIsWrong) {
  Pairing pairing(0.002);
  TimedImage pair[2];
  EXPECT_EQ(Pairing::complaint(pairing.take_counts(), 0.002), "no images");
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(pairing.add(kLeft, at(i / 60.0), pair));
  EXPECT_EQ(Pairing::complaint(pairing.take_counts(), 0.002), "no images from the right camera");
  for (int i = 30; i < 60; ++i) {
    EXPECT_FALSE(pairing.add(kLeft, at(i / 60.0), pair));
    EXPECT_FALSE(pairing.add(kRight, at(i / 60.0 + 0.008), pair));
  }
  const std::string why = Pairing::complaint(pairing.take_counts(), 0.002).value();
  EXPECT_NE(why.find("unsynchronised pair: 30 left and 30 right images"), std::string::npos) << why;
  EXPECT_NE(why.find("nearest 8.0 ms apart"), std::string::npos) << why;
}

TEST(Pairing, CountsWhatIsLost) {
  // Every third image of the right camera is missing.
  Pairing pairing(0.002);
  TimedImage pair[2];
  int pairs = 0;
  for (int i = 0; i < 60; ++i) {
    pairs += pairing.add(kLeft, at(i / 60.0), pair) ? 1 : 0;
    if (i % 3 > 0) pairs += pairing.add(kRight, at(i / 60.0), pair) ? 1 : 0;
  }
  pairing.end();
  const Pairing::Counts counts = pairing.take_counts();
  EXPECT_EQ(counts.lost, counts.images[kLeft] + counts.images[kRight] - 2 * pairs);
  EXPECT_EQ(Pairing::complaint(counts, 0.002), std::nullopt);
  EXPECT_EQ(Pairing::loss(counts), "20 of 100 images have no partner, or came too late");
  EXPECT_EQ(pairing.take_counts().lost, 0);
}

TEST(Pairing, SurvivesTimeThatStepsBack) {
  Pairing pairing(0.0);
  TimedImage pair[2];
  for (double t = 100.0; t < 101.0; t += 0.1) pairing.add(kLeft, at(t), pair);
  EXPECT_FALSE(pairing.add(kLeft, at(1.0), pair));
  EXPECT_TRUE(pairing.add(kRight, at(1.0), pair));
}

TEST(Pairing, RefusesStampsThatDoNotAdvance) {
  Pairing pairing(0.002);
  TimedImage pair[2];
  EXPECT_FALSE(pairing.add(kLeft, at(5.0), pair));
  const auto refuse = [&](Side side, double t, const std::string& part) {
    test::expect_bad_input([&] { pairing.add(side, at(t), pair); }, part);
  };
  refuse(kLeft, 5.0, "stamp 5.000000 s: expected one later than the previous, 5.000000 s");
  EXPECT_TRUE(pairing.add(kRight, at(5.0), pair));
  refuse(kRight, 5.0, "stamp 5.000000 s");  // paired already, but seen
  refuse(kLeft, 4.5, "stamp 4.500000 s: expected one later than the previous, 5.000000 s");
  EXPECT_FALSE(pairing.add(kLeft, at(5.1), pair));
  EXPECT_TRUE(pairing.add(kRight, at(5.1), pair));
}

TEST(Pairing, TakesAShortRecordingThatLoops) {
  Pairing pairing(0.002);
  TimedImage pair[2];
  int pairs = 0, refused = 0;
  for (int i = 0; i < 40; ++i) {
    for (const Side side : {kLeft, kRight}) {
      try {
        pairs += pairing.add(side, at(5.0 + 0.05 * (i % 10)), pair) ? 1 : 0;
      } catch (const BadInput&) {
        ++refused;
      }
    }
  }
  EXPECT_EQ(refused, 3 * 2 * 4);  // four at each of three ends, then it is another time
  EXPECT_EQ(pairs, 40 - 3 * 4);
}

TEST(Pairing, DoesNotLockOnePeriodApart) {
  // Left begins one period late, and the tolerance is longer than a period of 1/60 s.
  Pairing pairing(0.02);
  TimedImage pair[2];
  int pairs = 0, wrong = 0;
  for (int i = 0; i < 30; ++i) {
    for (const Side side : {kLeft, kRight}) {
      if (side == kLeft && (i == 0 || i == 20)) continue;
      if (!pairing.add(side, at(i / 60.0 + (side == kLeft ? 0.001 : 0.0)), pair)) continue;
      ++pairs;
      wrong += std::abs(pair[kLeft].t - pair[kRight].t) > 0.002 ? 1 : 0;
    }
  }
  EXPECT_GE(pairs, 27);
  EXPECT_LE(wrong, 1);  // the first, before a period has been seen
  EXPECT_NEAR(pairing.tolerance(), 1.0 / 120.0, 1e-9);
}

TEST(LivePair, NamesTheCameraThatHasBeenSilentForLonger) {
  LivePair live(0.002, 0.3);
  EXPECT_EQ(live.trouble(), "left camera: no image yet");
  live.add(kLeft, at(0.0));
  EXPECT_EQ(live.trouble(), "right camera: no image yet");
  live.add(kRight, at(0.0));
  EXPECT_EQ(live.trouble(), std::nullopt);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  live.add(kLeft, at(0.1));  // its last trigger before that of the right one blocks
  std::this_thread::sleep_for(std::chrono::milliseconds(350));
  EXPECT_EQ(live.trouble().value().find("right camera: no image for "), 0u)
      << live.trouble().value();
}

TEST(LivePair, CountsWhatNobodyTookInTime) {
  LivePair live(0.002);
  for (int i = 0; i < 7; ++i) {
    for (const Side side : {kLeft, kRight}) live.add(side, at(0.1 * i));
  }
  StereoFrame frame;
  int taken = 0;
  while (live.next(frame, 0.0)) ++taken;
  const Pairing::Counts counts = live.take_counts();
  EXPECT_EQ(counts.pairs, 7);
  EXPECT_EQ(counts.lost, 2 * (7 - taken));
  EXPECT_GT(counts.lost, 0);
}

TEST(CameraOptions, GiveSlowCamerasTheirTime) {
  CameraOptions options;
  EXPECT_EQ(options.silence(), 0.5);
  EXPECT_EQ(options.patience(), 1.0);
  options.rate = 1.0;
  EXPECT_EQ(options.silence(), 3.0);
  EXPECT_EQ(options.patience(), 3.0);
}

TEST(CameraOptions, FastCamerasHaveANarrowerToleranceWhereNoneIsSaid) {
  CameraOptions options;
  EXPECT_EQ(options.tolerance(), 0.004);
  options.rate = 200.0;
  EXPECT_EQ(options.tolerance(), 0.0025);
  EXPECT_NO_THROW(options.check("aravis"));
  options.sync_tolerance = 0.002;
  EXPECT_EQ(options.tolerance(), 0.002);
}

TEST(CameraOptions, AreChecked) {
  CameraOptions options;
  options.name[kLeft] = options.name[kRight] = "Fake_1";
  options.sync_tolerance = 0.0084;
  test::expect_bad_input(
      [&] { AravisSource source(options); },
      "aravis: sync_tolerance 0.0084 s: expected at most 0.00833333 s, half a period");
  options.exposure = 0.5;  // [ms]
  test::expect_bad_input([&] { AravisSource source(options); },
                         "aravis: exposure 0.5 s: expected less than 0.0166667 s, the period");
  options.exposure = 0.0005;
  options.rate = 0.0;
  test::expect_bad_input([&] { AravisSource source(options); },
                         "aravis: rate 0, exposure 0.0005: expected both > 0");
}

TEST(LivePair, SaysThatStampsDoNotAdvance) {
  LivePair live(0.002);
  live.add(kRight, at(5.0));
  live.add(kLeft, at(5.0));
  live.add(kRight, at(5.0));
  EXPECT_EQ(live.trouble(),
            "right camera: stamp 5.000000 s: expected one later than the previous, 5.000000 s");
  live.add(kRight, at(5.1));
  EXPECT_EQ(live.trouble(), std::nullopt);
}

/// The fake camera as a process of its own.
class FakeCamera {
 public:
  FakeCamera() {
    pid_ = fork();
    if (pid_ == 0) {
      execl(ANTHROB_FAKE_GV_CAMERA, ANTHROB_FAKE_GV_CAMERA, static_cast<char*>(nullptr));
      _exit(1);
    }
  }
  ~FakeCamera() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

 private:
  pid_t pid_;
};

class Cameras : public ::testing::Test {
 protected:
  /// Takes what comes until `done`, for `seconds` at most.
  template <typename Done>
  bool wait(AravisSource& source, double seconds, const Done& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
      StereoFrame frame;
      if (source.next(frame, 0.05) == FrameSource::Grab::kFrame)
        ++frames_, last_ = std::move(frame);
      if (done()) return true;
    }
    return false;
  }
  CameraOptions options(const std::string& right) const {
    CameraOptions options;
    options.name[kLeft] = "Fake_1", options.name[kRight] = right;
    options.width = 648, options.height = 488;
    options.rate = 20.0;
    options.sync_tolerance = 0.02;  // two processes on a busy machine
    return options;
  }

  int frames_ = 0;
  StereoFrame last_;
};

TEST_F(Cameras, StreamPairs) {
  AravisSource source(options("Fake_1"));
  ASSERT_TRUE(wait(source, 20.0, [&] { return frames_ >= 20; })) << source.trouble().value_or("");
  EXPECT_EQ(source.trouble(), std::nullopt);
  EXPECT_EQ(last_.image[kRight].width, 648);
  EXPECT_EQ(last_.image[kRight].height, 488);
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  EXPECT_NEAR(last_.t, now, 5.0);
  EXPECT_EQ(last_.t, 1e-9 * static_cast<double>(last_.ns));
}

TEST_F(Cameras, AreReportedWhenLostAndTakenBack) {
  auto camera = std::make_unique<FakeCamera>();
  AravisSource source(options("127.0.0.1"));
  ASSERT_TRUE(wait(source, 30.0, [&] { return frames_ >= 10; })) << source.trouble().value_or("");
  camera.reset();
  const auto killed = std::chrono::steady_clock::now();
  ASSERT_TRUE(wait(source, 5.0, [&] { return source.trouble().has_value(); }));
  const std::chrono::duration<double> noticed = std::chrono::steady_clock::now() - killed;
  // The node reports every half second, so that a second is enough, but for a busy machine.
  EXPECT_LE(CameraOptions().silence(), 0.5);
  std::printf("killed camera noticed after %.2f s\n", noticed.count());
  EXPECT_NE(source.trouble().value_or("").find("right camera"), std::string::npos)
      << source.trouble().value_or("");
  camera = std::make_unique<FakeCamera>();
  const int before = frames_;
  ASSERT_TRUE(wait(source, 60.0, [&] { return frames_ >= before + 10; }))
      << source.trouble().value_or("");
  EXPECT_EQ(source.trouble(), std::nullopt);
}

TEST_F(Cameras, ThatAreNotThereAreNamed) {
  AravisSource source(options("Nobody"));
  EXPECT_TRUE(wait(source, 20.0, [&] {
    return source.trouble().value_or("").find("Nobody") != std::string::npos;
  })) << source.trouble().value_or("");
  test::expect_bad_input([&] { AravisSource none(options("")); }, "names of a left and a right");
}

#ifdef ANTHROB_HAVE_DC1394
TEST(FireWire, TakesNoTriggerItDoesNotKnow) {
  CameraOptions options;
  options.name[kLeft] = options.name[kRight] = "1";
  for (const char* word : {"software", "Line0", "extern"}) {
    options.trigger = word;
    test::expect_bad_input(
        [&] { Dc1394Source source(options); },
        std::string("dc1394: trigger '") + word + "': expected external or free");
  }
}
#endif

}  // namespace
}  // namespace mocap
}  // namespace anthrob
