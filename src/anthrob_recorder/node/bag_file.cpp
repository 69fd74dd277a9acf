#include "bag_file.h"

#include <stdexcept>

namespace anthrob {

BagFile::BagFile(const std::string& file, const std::string& prefix)
    : file_(file), bag_(std::make_unique<rosbag::Bag>()), prefix_(prefix) {
  try {
    bag_->open(file, rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    abandon();
    fail(error);
  }
  bag_->setCompression(rosbag::compression::LZ4);
}

BagFile::~BagFile() {
  abandon();
}

void BagFile::close() {
  try {
    bag_->close();
  } catch (const rosbag::BagException& error) {
    // Its destructor would try again, and throw, which ends the program without a word. What is
    // left open is left to the system.
    (void)bag_.release();
    fail(error);
  }
}

void BagFile::fail(const rosbag::BagException& error) const {
  throw std::runtime_error(file_ + ": cannot be written: " + error.what());
}

void BagFile::abandon() {
  try {
    if (bag_) close();
  } catch (const std::runtime_error&) {
    // It was not complete.
  }
}

}  // namespace anthrob
