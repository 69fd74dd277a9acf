#include "bag_file.h"

#include <stdexcept>

namespace anthrob {

BagFile::BagFile(const std::string& file, const std::string& prefix) : prefix_(prefix) {
  try {
    bag_.open(file, rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(file + ": cannot be written: " + error.what());
  }
  bag_.setCompression(rosbag::compression::LZ4);
}

}  // namespace anthrob
