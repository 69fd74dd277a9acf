#pragma once

#include <string>

namespace anthrob {

/// Checks that all lengths and counts in the records of a bag can be true before rosbag makes room
/// for them: a corrupt bag of 100 kB may ask for gigabytes.
/// @throws BadInput naming the byte of the file where the first wrong record begins
void check_bag_records(const std::string& file);

}  // namespace anthrob
