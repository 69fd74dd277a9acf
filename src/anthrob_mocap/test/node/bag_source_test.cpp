// Bags: pairs, and images that cannot be used.
#include "bag_source.h"

#include <gtest/gtest.h>
#include <sensor_msgs/Image.h>

#include <fstream>

#include "expect_bad_input.h"
#include "temporary_folder.h"

namespace anthrob {
namespace mocap {
namespace {

class Bag : public ::testing::Test {
 protected:
  /// One image; the bag knows when it was recorded, whatever its stamp.
  void record(rosbag::Bag& bag, const std::string& topic, double stamp,
              const std::string& encoding = "mono8") {
    sensor_msgs::Image image;
    image.width = image.step = 4, image.height = 2;
    image.encoding = encoding;
    image.data.resize(8);
    image.header.stamp = ros::Time(stamp);
    bag.write(topic, ros::Time(++recorded_), image);
  }
  /// Times of the pairs.
  std::vector<double> read(double tolerance = 0.0) {
    BagSource source(file_, "/l", "/r", tolerance,
                     [this](const std::string& why) { refused_.push_back(why); });
    std::vector<double> times;
    StereoFrame frame;
    while (source.next(frame, 0.0) == FrameSource::Grab::kFrame) times.push_back(frame.t);
    return times;
  }

  test::TemporaryFolder folder_;
  const std::string file_ = folder_.path("run.bag");
  std::vector<std::string> refused_;
  double recorded_ = 0.0;
};

TEST_F(Bag, GoesOnAfterImagesThatCannotBeUsed) {
  rosbag::Bag bag(file_, rosbag::bagmode::Write);
  for (const double t : {1.0, 1.1, 1.2, 1.3}) {
    record(bag, "/l", t, t == 1.1 ? "mono16" : "mono8");
    record(bag, "/r", t == 1.2 ? 0.0 : t);
  }
  record(bag, "/l", 1.3);
  bag.close();
  EXPECT_EQ(read(), (std::vector<double>{1.0, 1.3}));
  EXPECT_EQ(
      refused_,
      (std::vector<std::string>{
          file_ + ": /l: image stamped 1.100000000 s: encoding mono16: expected mono8",
          file_ + ": /r: image stamped 0.000000000 s: stamp 0: expected the time of the exposure",
          file_ + ": /l: image stamped 1.300000000 s: stamp 1.300000 s: expected one "
                  "later than the previous, 1.300000 s",
          file_ + ": 2 of 7 images have no partner, or came too late"}));
}

TEST_F(Bag, SaysHowManyImagesHaveNoPartner) {
  rosbag::Bag bag(file_, rosbag::bagmode::Write);
  for (int i = 0; i < 100; ++i) {
    record(bag, "/l", 1.0 + 0.1 * i);
    if (i % 10 == 0) record(bag, "/r", 1.0 + 0.1 * i);
  }
  bag.close();
  EXPECT_EQ(read().size(), 10u);
  EXPECT_EQ(
      refused_,
      (std::vector<std::string>{file_ + ": 90 of 110 images have no partner, or came too late"}));
}

TEST_F(Bag, IsNamedWhereItIsDamaged) {
  rosbag::Bag bag(file_, rosbag::bagmode::Write);
  bag.setCompression(rosbag::compression::BZ2);
  for (int i = 0; i < 1000; ++i) record(bag, "/l", 1.0 + 0.1 * i), record(bag, "/r", 1.0 + 0.1 * i);
  bag.close();
  std::fstream bytes(file_, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(6000);  // behind the header of 4096 bytes
  bytes << std::string(500, 'x');
  bytes.close();
  test::expect_bad_input([&] { read(); }, "run.bag: cannot be read as a bag (");
}

TEST_F(Bag, WithoutAPairIsRefused) {
  rosbag::Bag bag(file_, rosbag::bagmode::Write);
  record(bag, "/l", 1.0), record(bag, "/r", 1.5);
  bag.close();
  test::expect_bad_input([&] { read(); }, "run.bag: unsynchronised pair: 1 left and 1 right");
  bag.open(file_, rosbag::bagmode::Append);
  record(bag, "/l", 0.0);
  bag.close();
  test::expect_bad_input([&] { read(); }, "run.bag: /l: image stamped 0.000000000 s: stamp 0");
  test::expect_bad_input([&] { BagSource source(file_, "/l", "/x", 0.0, {}); },
                         "run.bag: no images on topic /x");
}

}  // namespace
}  // namespace mocap
}  // namespace anthrob
